// Cylinders closed and open.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
cylinder { <-1.5, 0, 0>, <-1.5, 1.5, 0.3>, 0.6 pigment { rgb <0.9, 0.8, 0.2> } }
cylinder { <0.6, 0.7, -1>, <2, 0.7, 1>, 0.6 open pigment { rgb <0.2, 0.8, 0.5> } }
