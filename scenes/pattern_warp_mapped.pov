// Cylindrical, spherical and toroidal warps.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location -5*z look_at 0 right 4*x up 3*y }
light_source { <-8, 12, -20> rgb 1 }
box { <-1.9, -1.4, 0>, <-0.05, 1.4, 0.1> pigment { checker rgb <0.9,0.2,0.2>, rgb <1,0.9,0.6> scale 0.1 warp { toroidal orientation z major_radius 0.6 } } }
sphere { <0.95, 0, 0>, 0.95 pigment { checker rgb <0.9,0.2,0.2>, rgb <1,0.9,0.6> scale 0.1 warp { toroidal orientation z major_radius 0.6 } } }
