// A sphere with three holes, cut in its own colours.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
difference { sphere { 0, 1 pigment { rgb <0.9, 0.8, 0.3> } } cylinder { -2*x, 2*x, 0.4 pigment { rgb <0.9, 0.2, 0.2> } } cylinder { -2*y, 2*y, 0.4 pigment { rgb <0.2, 0.8, 0.2> } } cylinder { -2*z, 2*z, 0.4 pigment { rgb <0.2, 0.3, 0.9> } } rotate <-25, 35, 0> translate 1.1*y }
