// A parametric surface.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
parametric { function { cos(u)*(0.8+0.3*cos(v)) } function { 0.3*sin(v)+0.1*sin(u*3) } function { sin(u)*(0.8+0.3*cos(v)) } <0, 0>, <2*pi, 2*pi> contained_by { box { <-1.2, -0.5, -1.2>, <1.2, 0.5, 1.2> } } max_gradient 5 accuracy 0.001 precompute 10, x, y, z rotate -30*x translate 0.9*y pigment { rgb <0.7, 0.4, 0.8> } finish { phong 0.5 } }
