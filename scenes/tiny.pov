// A scene a thousandth of the usual size.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare S = 1e-3;
camera { location <0, 2.5, -6>*S look_at <0, 0.6, 0>*S right 4/3*x angle 45 }
light_source { <-8, 12, -10>*S rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 scale S } }
sphere { y*S, S pigment { rgb <0.9, 0.15, 0.1> } finish { phong 0.6 reflection 0.2 } }
box { <1.3, 0, 0>*S, <2.1, 1, 1>*S pigment { rgb <0.3, 0.5, 0.9> } }
