// Cones closed, open and cut.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
cone { <-1.5, 0, 0>, 0.8, <-1.5, 1.8, 0>, 0 pigment { rgb <0.9, 0.4, 0.2> } }
cone { <1, 0.2, -0.6>, 0.9, <1.6, 1.4, 0.8>, 0.4 open pigment { rgb <0.4, 0.4, 0.9> } }
