// A height field of a function, smooth and not.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
height_field { function 40, 40 { 0.5+0.3*sin(x*14)*cos(y*11)+0.2*x } smooth scale <2, 1, 2> translate <-2.2, 0, -0.6> pigment { rgb <0.5, 0.8, 0.4> } }
height_field { function 12, 12 { 0.5+0.4*sin(x*9+y*5) } water_level 0.3 scale <1.8, 1, 1.8> translate <0.3, 0, -0.6> pigment { rgb <0.8, 0.6, 0.4> } }
