// A mesh2 with normals, and two copies of it.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare N = 16;
#declare Bump = mesh2 {
  vertex_vectors { (N+1)*(N+1) #for (I, 0, N) #for (J, 0, N) , <I/N-0.5, 0.3*cos(I/N*6)*sin(J/N*6), J/N-0.5> #end #end }
  normal_vectors { (N+1)*(N+1) #for (I, 0, N) #for (J, 0, N) , vnormalize(<1.8*sin(I/N*6)*sin(J/N*6), 1, -1.8*cos(I/N*6)*cos(J/N*6)>) #end #end }
  face_indices { 2*N*N #for (I, 0, N-1) #for (J, 0, N-1)
    , <I*(N+1)+J, (I+1)*(N+1)+J, I*(N+1)+J+1>, <(I+1)*(N+1)+J+1, (I+1)*(N+1)+J, I*(N+1)+J+1> #end #end }
}
object { Bump scale 2.4 translate <-1.3, 0.9, 0> pigment { rgb <0.9, 0.7, 0.2> } finish { phong 0.5 } }
object { Bump scale 2 rotate <-50, 30, 0> translate <1.3, 1.1, 0> pigment { rgb <0.3, 0.7, 0.8> } }
