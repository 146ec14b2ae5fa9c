// Superellipsoids between box and star.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
superellipsoid { <0.25, 0.25> scale 0.7 rotate 30*y translate <-1.8, 0.8, 0> pigment { rgb <0.9, 0.3, 0.3> } }
superellipsoid { <1, 0.3> scale 0.7 rotate <60, 30, 0> translate <0, 0.8, 0> pigment { rgb <0.3, 0.9, 0.3> } }
superellipsoid { <2, 1.5> scale 0.9 translate <1.8, 0.9, 0> pigment { rgb <0.3, 0.4, 0.9> } }
