// What no_image, no_reflection and no_shadow hide, and from whom.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -7> look_at <0, 0.8, 0> right 4/3*x angle 45 }
light_source { <-6, 9, -8> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.4 } }
box { <-3, 0, 1.4>, <3, 2.6, 1.5> pigment { rgb 0.1 } finish { reflection 0.8 } }
sphere { <-1.8, 0.7, 0>, 0.7 pigment { rgb <0.9, 0.3, 0.2> } no_image }
sphere { <0, 0.7, 0>, 0.7 pigment { rgb <0.3, 0.8, 0.3> } no_reflection }
sphere { <1.8, 0.7, 0>, 0.7 pigment { rgb <0.3, 0.4, 0.9> } no_shadow }
box { <-0.5, 0.1, -2>, <1.6, 1, -1.8> pigment { rgbf 0.9 } interior { ior 1.3 } }
