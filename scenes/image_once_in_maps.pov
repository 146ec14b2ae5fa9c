// Images with once: missing alone and in layers, clear inside maps. A material_map and tiles.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare Picture = pigment { image_map { function 8, 8 { pattern { checker scale 0.2 } } once } }
sphere { <-1.8, 0.8, 0>, 0.8 texture { pigment { rgb <0.2, 0.5, 0.9> } } texture { pigment { Picture } scale 0.8 translate <-2.2, 0.4, 0> } }
sphere { <0, 0.8, 0>, 0.8 pigment { gradient y pigment_map { [0.3 Picture translate -0.5*x] [0.7 rgb <0.9, 0.4, 0.3>] } scale 2 } }
box { <1.1, 0, -0.7>, <2.5, 1.4, 0.7> texture { tiles { texture { pigment { rgb <0.9, 0.8, 0.5> } finish { reflection 0.2 } } tile2 texture { pigment { rgbt <0.3, 0.4, 0.8, 0.4> } normal { dents 1 scale 0.1 } } } scale 0.35 } }
