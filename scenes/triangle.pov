// A flat and a smooth triangle.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
triangle { <-2, 0, 0>, <-0.2, 0, 0>, <-1, 1.8, 0.5> pigment { rgb <0.9, 0.3, 0.5> } }
smooth_triangle { <0.2, 0, 0>, <-1, 0.2, -1>, <2, 0, 0>, <1, 0.2, -1>, <1, 1.8, 0.5>, <0, 1, -1> pigment { rgb <0.3, 0.9, 0.5> } finish { phong 0.8 } }
