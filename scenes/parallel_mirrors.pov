// Mirrors facing each other end at max_trace_level.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 9 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
plane { -z, -3 pigment { rgb 0 } finish { reflection 0.85 } }
plane { z, -8 pigment { rgb 0 } finish { reflection 0.85 } }
sphere { <0.5, 0.9, 0>, 0.9 pigment { rgb <0.9, 0.5, 0.2> } }
