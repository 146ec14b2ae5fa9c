// Neither #version nor assumed_gamma: the way most programs write.
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 1 pigment { color red 0.9 green 0.6 blue 0.2 } finish { phong 1 } }
box { <1.2, 0, 0>, <2, 1, 1> pigment { color rgb <0.3, 0.4, 0.8> filter 0.5 } }
