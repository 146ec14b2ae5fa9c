// Cells, and crackle in their places.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location -5*z look_at 0 right 4*x up 3*y }
light_source { <-8, 12, -20> rgb 1 }
box { <-1.9, -1.4, 0>, <-0.05, 1.4, 0.1> pigment { cells pigment_map { [0.5 crackle color_map { [0 rgb <0.1, 0.1, 0.4>] [0.5 rgb <0.9, 0.5, 0.2>] [1 rgb <1, 1, 0.8>] }] [0.5 rgb <0.3, 0.6, 0.4>] } scale 0.4 } }
sphere { <0.95, 0, 0>, 0.95 pigment { cells pigment_map { [0.5 crackle color_map { [0 rgb <0.1, 0.1, 0.4>] [0.5 rgb <0.9, 0.5, 0.2>] [1 rgb <1, 1, 0.8>] }] [0.5 rgb <0.3, 0.6, 0.4>] } scale 0.4 } }
