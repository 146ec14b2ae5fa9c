// A merge of glass has no inner walls.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
merge { sphere { -0.5*x, 0.8 } sphere { 0.5*x, 0.8 } cylinder { -y*0.8, 0.9*y, 0.35 } translate 0.9*y pigment { rgbf <0.9, 0.95, 1, 0.9> } interior { ior 1.3 } finish { phong 0.7 } }
