// A wide angle and a tilted sky.
#version 3.7;
global_settings { assumed_gamma 1.0 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 1 pigment { rgb <0.3, 0.9, 0.4> } }
box { <2, 0, 2>, <3, 2, 3> pigment { rgb <0.9, 0.3, 0.4> } }
camera { location <0, 1.5, -3> sky <0.3, 1, 0> right 4/3*x look_at 0.8*y angle 95 }
