// Phong and specular, dull and metallic.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.9, 0.6, 0>, 0.6 pigment { rgb <0.8, 0.3, 0.2> } finish { phong 0.8 phong_size 20 } }
sphere { <-0.6, 0.6, 0>, 0.6 pigment { rgb <0.8, 0.6, 0.2> } finish { phong 0.9 phong_size 60 metallic } }
sphere { <0.7, 0.6, 0>, 0.6 pigment { rgb <0.3, 0.6, 0.3> } finish { specular 0.8 roughness 0.02 } }
sphere { <2, 0.6, 0>, 0.6 pigment { rgb <0.3, 0.4, 0.8> } finish { specular albedo 0.2 roughness 0.05 metallic 0.5 } }
