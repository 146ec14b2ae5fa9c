// Bricks with mortar.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { <-1.8, 0, -0.3>, <1.8, 2, 0.3> rotate 15*y pigment { brick rgb 0.8, rgb <0.6, 0.2, 0.15> brick_size <0.8, 0.3, 0.45> mortar 0.06 } }
