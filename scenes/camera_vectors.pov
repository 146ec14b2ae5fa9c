// direction, up and right written out, without look_at.
#version 3.7;
global_settings { assumed_gamma 1.0 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <0, 1, 3>, 1 pigment { rgb <0.3, 0.4, 0.9> } }
camera { location <0, 1.2, -2> direction 1.5*z up 1.2*y right 1.6*x }
