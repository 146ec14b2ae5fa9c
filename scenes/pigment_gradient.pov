// Gradients with a colour map.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { <-2, 0, 0>, <-0.2, 2, 0.5> pigment { gradient y color_map { [0 rgb <0.1, 0.1, 0.5>] [0.5 rgb <0.9, 0.4, 0.2>] [0.5 rgb 1] [1 rgb <0.2, 0.8, 0.3>] } scale 2 } }
sphere { <1.2, 1, 0>, 1 pigment { gradient x+y triangle_wave frequency 3 color_map { [0.2 rgb 0] [0.8 rgb <1, 0.9, 0.2>] } } }
