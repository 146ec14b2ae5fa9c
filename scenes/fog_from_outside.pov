// A camera behind a disc, outside an inverse sphere, beyond a clipped plane: in none of them, so it sees the fog.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
fog { fog_type 1 distance 9 rgb <0.5, 0.6, 0.7> }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
disc { <-2, 0.8, 0>, <0.2, 0.3, 1>, 0.8 pigment { rgb <0.8, 0.5, 0.3> } }
sphere { <0, 0.8, 0>, 0.8 inverse pigment { rgb <0.3, 0.7, 0.5> } }
plane { z, 0 clipped_by { sphere { <2, 0.8, 0>, 0.8 } } pigment { rgb <0.4, 0.5, 0.9> } }
