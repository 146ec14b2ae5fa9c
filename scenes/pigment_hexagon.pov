// Hexagons.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { hexagon rgb <0.9, 0.3, 0.2>, rgb <0.3, 0.7, 0.3>, rgb <0.2, 0.4, 0.9> scale 0.7 } }
sphere { y, 0.9 pigment { hexagon rgb 1, rgb 0.6, rgb 0.2 scale 0.25 rotate 90*x } }
