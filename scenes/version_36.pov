// Filter attenuates as before 3.7.
#version 3.6;
global_settings { assumed_gamma 2.2 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 1 pigment { rgbf <0.9, 0.6, 0.2, 0.5> } finish { ambient 0.2 diffuse 0.8 } }
sphere { <2, 0.6, 0>, 0.6 pigment { rgbft <0.4, 0.6, 0.9, 0.3, 0.3> } }
