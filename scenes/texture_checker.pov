// Textures in a checker, tiles of old.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { -0.9, 0.9 rotate 30*y translate 0.9*y texture { checker texture { pigment { rgb <0.9, 0.7, 0.2> } finish { phong 1 } }, texture { pigment { rgb 0.1 } finish { reflection 0.5 } } scale 0.45 } }
