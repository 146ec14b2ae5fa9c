// Layers: dirt over paint over metal.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare T = texture { pigment { rgb <0.7, 0.6, 0.3> } finish { metallic specular 0.6 } } texture { pigment { bozo color_map { [0.4 rgbt <0.2, 0.4, 0.8, 0>] [0.6 rgbt 1] } scale 0.3 } finish { phong 0.6 } } texture { pigment { granite color_map { [0.3 rgbt 1] [0.6 rgbt <0.1, 0.1, 0.1, 0.3>] } } }
sphere { y, 1 texture { T } }
