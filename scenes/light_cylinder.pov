// A cylinder light and a parallel light.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-0.8, 0.7, 0>, 0.7 pigment { rgb 0.9 } }
box { <0.8, 0, -0.5>, <1.8, 1.2, 0.5> pigment { rgb <0.9, 0.6, 0.5> } }
light_source { <-3, 6, -4> rgb 0.9 cylinder point_at <-0.8, 0, 0> radius 1 falloff 1.6 tightness 1 }
light_source { <4, 8, -6> rgb <0.5, 0.6, 0.9> parallel point_at 0 }
