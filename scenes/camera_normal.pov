// A camera with ripples in its lens.
#version 3.7;
global_settings { assumed_gamma 1.0 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <0, 1, 3>, 1 pigment { rgb <0.9, 0.3, 0.3> } }
box { <2, 0, 2>, <3, 2, 3> pigment { rgb <0.3, 0.8, 0.3> } }
cylinder { <-3, 0, 1>, <-3, 3, 1>, 0.5 pigment { rgb <0.3, 0.4, 0.9> } }
sphere { <0, 1, -4>, 1 pigment { rgb <0.9, 0.8, 0.3> } }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.9] [1 rgb <0.2, 0.4, 0.9>] } } }
camera { location <0, 1.2, -3> right 4/3*x look_at <0, 1, 3> normal { bumps 0.15 scale 0.2 } }
