// A light projected through a hole.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
light_source { <0, 6, -1> rgb 1 projected_through { disc { <0, 3, -0.5>, y, 0.7 } } }
sphere { <0, 0.6, 0>, 0.6 pigment { rgb <0.9, 0.6, 0.4> } }
light_source { <-8, 12, -10> rgb 0.3 }
