// A union turned as one.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
union { box { <-1, 0, -0.3>, <1, 0.4, 0.3> } sphere { <0, 0.9, 0>, 0.5 } cylinder { <-0.8, 0.4, 0>, <-0.8, 1.6, 0>, 0.2 }
  rotate 25*y pigment { rgb <0.6, 0.8, 0.3> } }
