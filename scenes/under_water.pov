// Waves seen from below, far to the horizon: normals that point away from the eye, total reflection, caustics.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 6, -15> look_at <0, 6.5, 0> right 4/3*x angle 65 }
light_source { <0, 50, 0> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.7>] [1 rgb <0.2, 0.4, 0.9>] } } }
plane { y, 0 pigment { rgb 0.6 } }
plane { y, 10 hollow pigment { rgbf <0.7, 0.8, 1, 0.9> } normal { bumps 0.5 } finish { reflection 0.4 } interior { ior 1.2 caustics 1 } }
