// slope and aoi see the normal perturbed last, also by a layer above; iridescence is turbulent at the hit.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.8, 0.8, 0>, 0.8 texture { pigment { slope y } } texture { pigment { rgbt <1, 1, 1, 0.8> } normal { bumps 1 scale 0.3 } } }
sphere { <0, 0.8, 0>, 0.8 pigment { aoi color_map { [0.5 rgb <0, 0, 0.6>] [1 rgb <1, 0.9, 0.5>] } } normal { bumps 0.8 scale 0.3 no_bump_scale } finish { ambient 0.4 } }
sphere { <1.8, 0.8, 0>, 0.8 texture { checker texture { pigment { rgb 0.8 } finish { irid { 0.8 thickness 0.3 turbulence 0.6 } } } texture { pigment { rgb 0.6 } } scale 0.3 } }
