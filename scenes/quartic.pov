// A quartic, a cubic and a polynomial.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
quartic { <1,0,0,0,2,0,0,2,0,-1.6, 0,0,0,0,0,0,0,0,0,0, 1,0,0,2,0,1.28,0,0,0,0, 1,0,-1.6,0,0.3> translate <-1.2, 0.9, 0> pigment { rgb <0.8, 0.4, 0.6> } }
polynomial { 3, xyz(3,0,0):1, xyz(0,2,0):1.5, xyz(0,0,2):1, xyz(0,0,0):-0.4 clipped_by { box { -1.2, 1.2 } } translate <1.2, 0.9, 0> pigment { rgb <0.4, 0.8, 0.4> } }
