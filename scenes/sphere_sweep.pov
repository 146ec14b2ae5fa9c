// Sphere sweeps of three splines.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere_sweep { linear_spline 4, <-2.4, 0.3, 0>, 0.3 <-1.2, 1.4, 0>, 0.15 <-0.8, 0.4, -0.4>, 0.25 <-0.2, 1.6, 0>, 0.1 pigment { rgb <0.9, 0.4, 0.3> } }
sphere_sweep { b_spline 6, <0, 0, 0>, 0.3 <0.3, 0.5, 0>, 0.3 <0.8, 1.6, 0>, 0.2 <1.4, 0.4, -0.3>, 0.25 <2, 1.5, 0>, 0.2 <2.4, 2, 0>, 0.2 pigment { rgb <0.3, 0.7, 0.5> } }
