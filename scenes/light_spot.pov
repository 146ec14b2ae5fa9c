// Spotlights: soft edge, tightness, hard edge.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { 0.7*y, 0.7 pigment { rgb <0.9, 0.8, 0.7> } }
light_source { <-4, 6, -3> rgb 1 spotlight point_at <-1, 0, 0> radius 8 falloff 18 }
light_source { <0, 7, 2> rgb <1, 0.8, 0.3> spotlight point_at <0.5, 0, 0> radius 10 falloff 14 tightness 20 }
light_source { <5, 6, -3> rgb <0.3, 0.5, 1> spotlight point_at <1.8, 0, -0.5> radius 10 falloff 10 }
