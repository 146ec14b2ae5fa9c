// Before 3.7 the missing background is opaque black, which antialiasing compares too.
#version 3.6;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { bozo color_map { [0.3 rgb 0.5] [0.7 rgbf <0.3, 0.95, 0.56, 0.56>] } scale 0.3 } }
sphere { <0, 0.8, 0>, 0.8 pigment { rgbt <0.9, 0.4, 0.3, 0.5> } }
