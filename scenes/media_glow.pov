// A ball that glows and a ball of dust, both denser inside.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 1.5, -6> look_at <0, 0.7, 0> right 4/3*x angle 45 }
light_source { <-5, 8, -5> rgb 1 }
plane { y, 0 pigment { checker rgb 0.8 rgb 0.3 } }
sphere { <-1.1, 1.1, 0>, 1 hollow pigment { rgbt 1 } interior { media { emission <1.2, 0.9, 0.3> density { spherical translate <-1.1, 1.1, 0> color_map { [0 rgb 0] [1 rgb 1] } } } } }
sphere { <1.1, 1.1, 0>, 1 hollow pigment { rgbt 1 } interior { media { absorption <1, 1.4, 2> density { rgb <1, 0.8, 0.6> } density { spherical translate <1.1, 1.1, 0> turbulence 0.3 } method 2 samples 8 } } }
