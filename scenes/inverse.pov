// The inside of an inverse sphere, and its half.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { 0, 8 inverse pigment { gradient y color_map { [0 rgb <0.8, 0.8, 0.6>] [1 rgb <0.2, 0.3, 0.6>] } scale 8 } hollow }
sphere { y, 0.8 pigment { rgb <0.8, 0.2, 0.4> } }
