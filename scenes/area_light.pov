// An area light without jitter.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
light_source { <-4, 6, -4> rgb 1 area_light 2*x, 2*z, 5, 5 }
sphere { <-0.5, 0.8, 0>, 0.8 pigment { rgb <0.9, 0.6, 0.4> } }
box { <0.8, 0, -0.4>, <1.6, 1.2, 0.4> pigment { rgb <0.4, 0.6, 0.9> } }
