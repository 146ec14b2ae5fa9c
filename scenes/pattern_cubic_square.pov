// Square, triangular, cubic lists.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location -5*z look_at 0 right 4*x up 3*y }
light_source { <-8, 12, -20> rgb 1 }
box { <-1.9, -1.4, 0>, <-0.05, 1.4, 0.1> pigment { cubic rgb x, rgb y, rgb z, rgb <1,1,0>, rgb <0,1,1>, rgb <1,0,1> scale 0.6 rotate <20, 30, 10> } }
sphere { <0.95, 0, 0>, 0.95 pigment { cubic rgb x, rgb y, rgb z, rgb <1,1,0>, rgb <0,1,1>, rgb <1,0,1> scale 0.6 rotate <20, 30, 10> } }
