// A spotlight and a beam seen in dusty air, with the shadow of a ball in them.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 1.2, -6> look_at <0, 0.9, 0> right 4/3*x angle 45 }
light_source { <-2.2, 3.4, -0.5> rgb 3 spotlight point_at <0.2, 0, 0.2> radius 12 falloff 18 media_attenuation on }
light_source { <3.2, 6, 0.5> rgb <0.3, 2, 0.6> cylinder point_at <1.2, 0, 0> radius 0.25 falloff 0.4 }
light_source { <0, 9, -9> rgb 0.3 media_interaction off }
plane { y, 0 pigment { rgb 0.6 } }
sphere { <-0.7, 1.2, 0>, 0.35 pigment { rgb <0.9, 0.3, 0.2> } }
media { scattering { 1, 0.12 } intervals 5 ratio 0.8 }
