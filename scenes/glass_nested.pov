// An air bubble in glass, water in a glass.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.1, 1, 0>, 1 pigment { rgbf 0.95 } interior { ior 1.5 } }
sphere { <-1.1, 1, 0>, 0.6 pigment { rgbf 0.95 } interior { ior 1.0 } }
cylinder { <1.2, 0.01, 0>, <1.2, 1.6, 0>, 0.8 pigment { rgbf <0.9, 1, 0.9, 0.9> } interior { ior 1.5 } }
cylinder { <1.2, 0.1, 0>, <1.2, 1.5, 0>, 0.6 pigment { rgbf <0.7, 0.8, 1, 0.9> } interior { ior 1.33 } }
