// A blob with a negative part and a cylinder.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
blob { threshold 0.6 sphere { <-0.7, 0.9, 0>, 1, 1.5 pigment { rgb <0.9, 0.2, 0.2> } } sphere { <0.7, 0.9, 0>, 1, 1.5 pigment { rgb <0.2, 0.4, 0.9> } } cylinder { <0, 0.3, 0>, <0, 2, 0>, 0.6, 1 pigment { rgb <0.3, 0.9, 0.3> } } sphere { <0, 1, -0.9>, 0.6, -1.4 } finish { phong 0.5 } }
