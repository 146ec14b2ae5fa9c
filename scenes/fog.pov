// Constant fog and ground fog.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
fog { distance 12 rgbft <0.7, 0.75, 0.8, 0.2, 0.1> }
fog { fog_type 2 distance 3 rgb <0.9, 0.6, 0.4> fog_offset 0.1 fog_alt 0.3 turbulence 0.4 turb_depth 0.3 }
sphere { <-1, 1, 0>, 1 pigment { rgb <0.9, 0.3, 0.2> } }
sphere { <2, 1, 6>, 1 pigment { rgb <0.2, 0.5, 0.9> } }
sky_sphere { pigment { rgb <0.3, 0.5, 0.9> } }
