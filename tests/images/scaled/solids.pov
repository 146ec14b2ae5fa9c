// Shapes, CSG and shadows, every length times S.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare S = pow(2, K);
camera { location <0, 2.5, -6>*S look_at <0, 0.6, 0>*S right 4/3*x angle 45 }
light_source { <-8, 12, -10>*S rgb 1 fade_distance 10*S fade_power 2 }
light_source { <3, 4, -6>*S rgb 0.4 spotlight point_at 0 radius 15 falloff 25 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 scale S } finish { reflection 0.2 } }
sphere { <-1.6, 0.7, 0>*S, 0.7*S pigment { rgb <0.9, 0.15, 0.1> } finish { phong 0.6 reflection 0.2 } }
box { <0.2, 0, -0.5>*S, <1, 0.8, 0.4>*S rotate 20*y pigment { gradient x color_map { [0 rgb <0.3, 0.5, 0.9>] [1 rgb 1] } scale 0.3*S } }
cone { <1.7, 0, 0>*S, 0.6*S, <1.7, 1.4, 0>*S, 0.2*S pigment { rgb <0.3, 0.8, 0.3> } }
cylinder { <-0.4, 0, -1.5>*S, <-0.2, 0.6, -1.5>*S, 0.3*S open pigment { rgb <0.8, 0.7, 0.2> } }
disc { <0.5, 1.7, 0.5>*S, <0.2, 0.5, -1>, 0.6*S, 0.3*S pigment { rgb <0.8, 0.3, 0.8> } }
triangle { <-1, 1.5, 1>*S, <0, 2.2, 1>*S, <-0.3, 1.2, 0.8>*S pigment { rgb <0.3, 0.8, 0.8> } }
difference {
  sphere { <0.6, 0.35, -1.8>*S, 0.35*S }
  box { <0.6, 0.3, -3>*S, <2, 2, 0>*S }
  pigment { rgb <0.9, 0.5, 0.2> }
}
