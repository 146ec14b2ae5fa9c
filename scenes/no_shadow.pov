// no_shadow, no_image, no_reflection.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.4, 0.7, -0.4>, 0.6 no_shadow pigment { rgb <0.9, 0.3, 0.3> } }
sphere { <0, 0.7, -0.4>, 0.6 no_image pigment { rgb <0.3, 0.9, 0.3> } }
sphere { <1.4, 0.7, -0.4>, 0.6 no_reflection pigment { rgb <0.3, 0.3, 0.9> } }
plane { -z, -1.5 pigment { rgb 0.1 } finish { reflection 0.7 } }
