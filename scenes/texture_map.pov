// A map of textures, and an average.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.2, 1, 0>, 1 texture { gradient y texture_map { [0.3 pigment { rgb <0.9, 0.2, 0.2> } finish { phong 1 }] [0.7 pigment { rgb 0.2 } finish { reflection 0.6 }] } scale 2 } }
sphere { <1.2, 1, 0>, 1 texture { average texture_map { [1 pigment { checker rgb 1, rgb 0 scale 0.4 }] [2 pigment { rgb <0.2, 0.5, 0.9> }] } } }
