// Ripples.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.2, 1, 0>, 1 pigment { rgb <0.8, 0.6, 0.4> } normal { ripples 0.5 scale 0.3 } finish { phong 0.5 } }
box { <0.3, 0, -0.3>, <2.2, 1.8, 0.3> rotate -15*y pigment { rgb <0.4, 0.6, 0.8> } normal { ripples 0.5 scale 0.3 } finish { phong 0.5 } }
