// Another texture inside.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
cylinder { 0, 1.6*y, 1 open texture { pigment { rgb <0.2, 0.5, 0.9> } } interior_texture { pigment { brick rgb 0.9, rgb <0.7, 0.3, 0.2> scale 0.1 } } rotate -30*x }
