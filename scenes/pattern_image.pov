// A function image, interpolated.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location -5*z look_at 0 right 4*x up 3*y }
light_source { <-8, 12, -20> rgb 1 }
box { <-1.9, -1.4, 0>, <-0.05, 1.4, 0.1> pigment { image_map { function 16, 16 { 0.5+0.5*sin(x*12)*cos(y*9) } interpolate 2 } scale 1.5 } }
sphere { <0.95, 0, 0>, 0.95 pigment { image_map { function 16, 16 { 0.5+0.5*sin(x*12)*cos(y*9) } interpolate 2 } scale 1.5 } }
