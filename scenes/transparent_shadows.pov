// Filter and transmit colour the shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { <-2, 0.3, -0.05>, <-0.7, 1.7, 0.05> pigment { rgbf <1, 0.2, 0.2, 0.8> } }
box { <-0.6, 0.3, -0.05>, <0.6, 1.7, 0.05> pigment { rgbt <0.2, 1, 0.2, 0.6> } }
box { <0.7, 0.3, -0.05>, <2, 1.7, 0.05> pigment { rgbft <0.2, 0.2, 1, 0.5, 0.3> } }
light_source { <2, 6, 6> rgb 0.7 }
