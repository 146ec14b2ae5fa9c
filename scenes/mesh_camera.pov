// A camera that looks out of the places of a mesh in uv space.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare M = mesh2 { vertex_vectors { 4, <-1, 0, -3>, <1, 0, -3>, <1, 2, -3>, <-1, 2, -2.7> } normal_vectors { 4, <-0.3, -0.2, 1>, <0.4, -0.2, 1>, <0.3, 0.3, 1>, <-0.3, 0.3, 1> }
  uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } }
camera { mesh_camera { 1 3 mesh2 { M } smooth } location 0.01*z }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <0, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.1> } finish { phong 0.5 } }
