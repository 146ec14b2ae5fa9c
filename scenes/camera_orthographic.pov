// An orthographic view.
#version 3.7;
global_settings { assumed_gamma 1.0 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { <-1, 0, -1>, <1, 1, 1> rotate 30*y pigment { rgb <0.9, 0.8, 0.4> } }
sphere { <1.6, 0.5, -1>, 0.5 pigment { rgb <0.4, 0.2, 0.9> } }
camera { orthographic location <3, 4, -5> look_at 0.5*y right 6*4/3*x up 6*y }
