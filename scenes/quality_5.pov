// Quality 5: quick colours, no transparency.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.1, 1, 0>, 1 pigment { rgbf <0.9, 0.5, 0.5, 0.8> quick_color rgb <0.2, 0.7, 0.9> } }
sphere { <1.1, 1, 0>, 1 pigment { rgb 0.2 } finish { reflection 0.6 } normal { bumps 0.5 scale 0.1 } }
