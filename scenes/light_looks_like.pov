// Lamps one can see.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
light_source { <-1.2, 1.2, -0.5> rgb <1, 0.8, 0.5> fade_distance 2 fade_power 2 looks_like { sphere { 0, 0.25 pigment { rgb 1 } finish { ambient 1 diffuse 0 } } } }
box { <0.2, 0, -0.4>, <1, 1.4, 0.4> pigment { rgb <0.5, 0.8, 0.8> } }
