// A rainbow.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
rainbow { angle 30 width 8 distance 1e7 direction <0.1, -0.35, 1> arc_angle 150 falloff_angle 60 jitter 0 color_map { [0 rgbt <1, 0.3, 0.9, 0.9>] [0.3 rgbt <0.2, 0.3, 1, 0.5>] [0.6 rgbt <0.3, 1, 0.3, 0.5>] [1 rgbt <1, 0.2, 0.2, 0.9>] } }
sphere { <0, 1, 2>, 1 pigment { rgb 0.7 } }
sky_sphere { pigment { rgb <0.35, 0.45, 0.6> } }
