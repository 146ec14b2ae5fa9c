// Text of a TrueType font.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
text { ttf "timrom.ttf" "Whit" 0.25, <0.05, 0, 0> scale 1.6 translate <-1.9, 0.2, 0> rotate 10*y pigment { rgb <0.9, 0.7, 0.2> } finish { phong 0.4 } }
