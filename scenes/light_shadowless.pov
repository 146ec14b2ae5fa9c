// A shadowless fill beside a light that fades.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 1 pigment { rgb <0.7, 0.7, 0.9> } finish { phong 0.9 } }
light_source { <5, 3, -6> rgb 0.3 shadowless }
light_source { <-4, 5, -3> rgb 1 fade_distance 5 fade_power 2 }
