// A background, and alpha above nothing.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
background { rgb <0.3, 0.5, 0.8> }
sphere { y, 1 pigment { rgbt <0.9, 0.3, 0.2, 0.4> } }
