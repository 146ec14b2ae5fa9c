// Boxes of haze: light from behind and from the side; their shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 1.5, -6> look_at <0, 0.7, 0> right 4/3*x angle 45 }
light_source { <-5, 8, -5> rgb 1 }
light_source { <2, 5, 8> rgb <0.9, 0.7, 0.4> }
plane { y, 0 pigment { rgb 0.7 } }
box { <-2, 0.2, -0.6>, <-0.3, 1.6, 0.6> hollow pigment { rgbt 1 } interior { media { scattering { 1, <0.3, 0.4, 0.5> } } } }
box { <0.3, 0.2, -0.6>, <2, 1.6, 0.6> hollow pigment { rgbft <1, 0.9, 0.8, 0.3, 0.6> } interior { media { scattering { 5, 0.6 eccentricity 0.4 extinction 0.5 } absorption <0.1, 0.2, 0> intervals 2 } } }
