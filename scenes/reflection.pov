// Mirrors: plain, coloured, metallic.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.5, 0.8, 0>, 0.8 pigment { rgb 0.1 } finish { reflection 0.8 } }
sphere { <0.3, 0.7, -0.8>, 0.5 pigment { rgb 0 } finish { reflection rgb <0.9, 0.6, 0.2> } }
sphere { <1.7, 0.8, 0>, 0.8 pigment { rgb <0.7, 0.2, 0.2> } finish { diffuse 0.3 reflection { 0.2, 0.9 metallic } metallic } }
