// uv_mapping of textures and normals whose object turns afterwards.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
torus { 0.6, 0.3 texture { uv_mapping pigment { rgb <0.9, 0.6, 0.3> } normal { bumps 1 scale 0.1 } } rotate <-40, 0, 20> translate <-1.8, 0.8, 0> }
sphere { 0, 0.8 texture { gradient x texture_map { [0 uv_mapping pigment { rgb <0.4, 0.8, 0.5> } normal { bumps 1 scale 0.1 }] [1 pigment { rgb 1 } normal { bumps 1 scale 0.2 }] } translate -0.5 scale 1.6 } rotate -34 translate 0.8*y }
box { -0.7, 0.7 pigment { slope y } normal { uv_mapping agate 0.6 rotate 30*y scale 0.3 } rotate 25*y translate <1.8, 0.7, 0> }
