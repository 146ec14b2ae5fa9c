// A hyperboloid and a paraboloid, cut.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
quadric { <1, -0.5, 1>, 0, 0, -0.3 clipped_by { box { <-2, -1, -2>, <2, 1, 2> } } translate <-1.3, 1, 0> pigment { rgb <0.8, 0.7, 0.3> } }
intersection { quadric { <1, 0, 1>, 0, <0, -0.7, 0>, 0 } plane { y, 1.4 } translate <1.3, 0.1, 0> pigment { rgb <0.4, 0.7, 0.7> } }
