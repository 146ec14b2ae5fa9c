// Prisms: linear, conic, cubic.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
prism { linear_sweep linear_spline 0, 1, 6, <-0.7, -0.6>, <0.7, -0.6>, <0.9, 0.3>, <0, 0.8>, <-0.9, 0.3>, <-0.7, -0.6> translate -1.6*x pigment { rgb <0.9, 0.5, 0.4> } }
prism { conic_sweep linear_spline 0, 1, 5, <0.7, 0.7>, <-0.7, 0.7>, <-0.7, -0.7>, <0.7, -0.7>, <0.7, 0.7> rotate 180*x translate <0.3, 1.2, 0> pigment { rgb <0.5, 0.8, 0.4> } }
prism { cubic_spline 0, 0.8, 8, <0.5, -0.8>, <-0.6, -0.5>, <-0.5, 0.5>, <0.6, 0.6>, <0.5, -0.8>, <-0.6, -0.5>, <-0.5, 0.5>, <0.6, 0.6> translate 2*x pigment { rgb <0.4, 0.5, 0.9> } }
