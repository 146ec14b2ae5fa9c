// Before 3.7 a background has no filter and no transmit.
#version 3.6;
background { rgbft <0.3, 0.4, 0.6, 0.2, 0.3> }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
sphere { y, 1 pigment { rgbt <0.9, 0.3, 0.2, 0.4> } }
