// A linear and a cubic lathe.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
lathe { linear_spline 5, <0, 0>, <0.8, 0>, <0.3, 0.8>, <0.6, 1.6>, <0, 1.8> translate <-1.3, 0, 0> pigment { rgb <0.8, 0.5, 0.3> } finish { phong 0.4 } }
lathe { cubic_spline 6, <0.2, -0.4>, <0.7, 0>, <0.9, 0.6>, <0.3, 1.2>, <0.6, 1.8>, <0.5, 2.2> translate <1.3, 0, 0> pigment { rgb <0.3, 0.6, 0.8> } finish { phong 0.4 } }
