// Three coloured lights, three coloured shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 0.8 pigment { rgb 1 } }
light_source { <-6, 6, -4> rgb <0.9, 0.1, 0.1> }
light_source { <0, 7, -5> rgb <0.1, 0.9, 0.1> }
light_source { <6, 6, -4> rgb <0.1, 0.1, 0.9> }
