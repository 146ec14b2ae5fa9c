// A prism with dispersion.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
prism { -1, 1, 4, <-0.8, -0.6>, <0.8, -0.6>, <0, 0.8>, <-0.8, -0.6> rotate <0, 20, 0> rotate 90*x translate <0, 1, 0> pigment { rgbf 0.98 } interior { ior 1.5 dispersion 1.08 dispersion_samples 7 } }
