// Things on a plane, lit by the sky alone.
#version 3.7;
global_settings { assumed_gamma 1.0 radiosity { count 300 error_bound 0.25 nearest_count 8 pretrace_end 0.01 recursion_limit 1 } }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.7, 0.5>] [1 rgb <0.2, 0.4, 0.9>] } } }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.4 } finish { diffuse 0.7 } }
sphere { <-1.1, 0.9, 0>, 0.9 pigment { rgb <0.9, 0.4, 0.3> } finish { diffuse 0.7 } }
box { <0.4, 0, -0.5>, <1.8, 1.2, 0.6> rotate 10*y pigment { rgb <0.4, 0.6, 0.9> } finish { diffuse 0.7 } }
