// uv_mapping on a sphere, a box and a torus.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { <-1.6, 0.8, 0>, 0.8 pigment { uv_mapping checker rgb 1, rgb <0.9, 0.2, 0.2> scale <1/16, 1/8, 1> } }
box { -0.6, 0.6 rotate <20, 40, 0> translate <0.2, 0.9, 0> pigment { uv_mapping gradient x color_map { [0 rgb <0, 0.3, 0.6>] [1 rgb <1, 0.9, 0.5>] } } }
torus { 0.6, 0.25 rotate -50*x translate <1.8, 0.8, 0> texture { uv_mapping pigment { checker rgb <0.2, 0.7, 0.3>, rgb 1 scale <1/12, 1/6, 1> } } }
