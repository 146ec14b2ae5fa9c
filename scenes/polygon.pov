// A star with a hole.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
polygon { 16, <0, 1.9>, <0.3, 1.2>, <1, 1.2>, <0.45, 0.8>, <0.7, 0.1>, <0, 0.5>, <-0.7, 0.1>, <-0.45, 0.8>, <-1, 1.2>, <-0.3, 1.2>, <0, 1.9>, <-0.2, 0.7>, <0.2, 0.7>, <0.2, 1.1>, <-0.2, 1.1>, <-0.2, 0.7> pigment { rgb <0.9, 0.8, 0.2> } rotate 15*y }
