// Inside a prism of glass light turns back.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
box { -1, 1 rotate 45*z translate <0, 1.45, 0.3> pigment { rgbf 0.98 } interior { ior 1.6 } }
sphere { <2, 0.5, 1>, 0.5 pigment { rgb <1, 0.3, 0.1> } }
sphere { <-2, 0.5, 1>, 0.5 pigment { rgb <0.1, 0.3, 1> } }
