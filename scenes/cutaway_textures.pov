// cutaway_textures.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
difference { union { sphere { -0.4*x, 0.8 pigment { rgb <0.9, 0.3, 0.2> } } sphere { 0.5*x, 0.8 pigment { rgb <0.2, 0.4, 0.9> } } } box { <-2, -0.2, -2>, <2, 2, -0.1> } cutaway_textures rotate 20*y translate 0.9*y }
