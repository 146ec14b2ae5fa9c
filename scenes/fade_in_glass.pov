// Glass that darkens with depth.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1, 1, 0>, 1 pigment { rgbf 1 } interior { ior 1.2 fade_distance 0.6 fade_power 2 fade_color <0.2, 0.6, 0.3> } }
box { <0.4, 0, 0>, <1.9, 1.2, 0.9> pigment { rgbf 1 } interior { ior 1.1 fade_distance 0.5 fade_power 1001 fade_color <0.8, 0.2, 0.1> } }
