// Variable reflection, its exponent, and Fresnel.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.5, 0.8, 0>, 0.8 pigment { rgb <0.2, 0.3, 0.7> } finish { reflection { 0.05, 0.9 falloff 3 } } }
sphere { <0.2, 0.6, -0.8>, 0.5 pigment { rgb 0.3 } finish { reflection { 0.9 exponent 0.6 } } }
sphere { <1.7, 0.8, 0>, 0.8 pigment { rgb <0.1, 0.4, 0.2> } finish { reflection { 0, 1 fresnel } conserve_energy } interior { ior 1.5 } }
