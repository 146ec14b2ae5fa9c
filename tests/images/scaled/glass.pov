// Refraction, attenuation in glass and coloured shadows, every length times S.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#declare S = pow(2, K);
camera { location <0, 2.5, -6>*S look_at <0, 0.6, 0>*S right 4/3*x angle 45 }
light_source { <-8, 12, -10>*S rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 scale S } }
sphere { <-1, 1, 0>*S, S pigment { rgbf <0.95, 0.98, 1, 0.9> } finish { phong 0.6 reflection { 0.05, 0.8 fresnel } conserve_energy } interior { ior 1.5 fade_distance S fade_power 2 fade_color <0.5, 0.9, 0.6> } }
sphere { <-1, 1, 0>*S, 0.5*S pigment { rgbf 0.95 } interior { ior 1 } }
box { <0.6, 0, -0.6>*S, <1.8, 1.5, 0.4>*S rotate -20*y pigment { rgbft <0.8, 1, 0.9, 0.5, 0.3> } interior { ior 1.33 fade_distance 0.5*S fade_power 1001 fade_color <0.8, 0.3, 0.2> } }
