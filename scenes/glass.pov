// A glass sphere and a glass box.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1, 1, 0>, 1 pigment { rgbf <0.95, 0.98, 1, 0.9> } finish { phong 0.6 reflection 0.1 } interior { ior 1.5 } }
box { <0.6, 0, -0.6>, <1.8, 1.5, 0.4> rotate -20*y pigment { rgbf <0.8, 1, 0.9, 0.85> } interior { ior 1.33 } }
