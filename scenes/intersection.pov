// A lens and a rounded cube.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
intersection { sphere { -0.7*z, 1 } sphere { 0.7*z, 1 } rotate 60*y translate <-1.2, 1, 0> pigment { rgb <0.4, 0.7, 0.9> } finish { phong 0.6 } }
intersection { box { -0.6, 0.6 } sphere { 0, 0.8 } rotate <20, 30, 0> translate <1.2, 0.8, 0> pigment { rgb <0.9, 0.6, 0.3> } }
