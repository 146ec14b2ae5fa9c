// A torus flat and one upright.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
torus { 1, 0.3 translate <-1.2, 0.3, 0> pigment { rgb <0.9, 0.6, 0.2> } finish { phong 0.6 } }
torus { 0.8, 0.2 rotate <90, 30, 0> translate <1.4, 1, 0> pigment { rgb <0.3, 0.6, 0.9> } finish { phong 0.6 } }
