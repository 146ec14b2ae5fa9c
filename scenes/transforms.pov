// Order of scale, rotate, translate, and a matrix.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { 0, 0.6 scale <1.8, 0.7, 1> rotate 30*z translate <-1.2, 1, 0> pigment { rgb <1, 0.5, 0.2> } }
box { -0.5, 0.5 matrix <1, 0.3, 0, 0, 1, 0, 0.2, 0, 1, 1.2, 0.8, 0> pigment { rgb <0.3, 0.5, 1> } }
