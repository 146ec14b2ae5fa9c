// Normals inside blended textures: chains of earlier siblings stay in force, no_bump_scale is handed down.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare Ridges = texture { pigment { rgb <0.4, 0.3, 0.8> } normal { marble 0.6 } }
#declare Turned = texture { cells texture_map { [0.5 pigment { rgb 0.5 }] } rotate <10, -80, -80> }
sphere { <-1.8, 0.8, 0>, 0.8 texture { average texture_map { [1 Turned] [1 Ridges] } } }
sphere { <0, 0.8, 0>, 0.8 texture { gradient x texture_map { [0 Ridges] [1 Turned] } translate -1 scale 2 } }
box { <1.1, 0, -0.6>, <2.5, 1.4, 0.6>
  texture { gradient y texture_map { [0 pigment { rgb <1, 0.8, 0.4> } normal { bumps 0.6 scale 0.4 }] [1 checker texture { Ridges } texture { Ridges } scale <0.6, 1.1, 1.8>] } scale 1.4 no_bump_scale } rotate 10*y }
sphere { <-0.9, 0.4, -1.6>, 0.4 pigment { rgb 0.9 } normal { gradient x normal_map { [0.2 gradient z normal_map { [0.8 bumps 1] [0.9 dents 1] }] [0.8 wrinkles 1] } scale 0.5 no_bump_scale } }
