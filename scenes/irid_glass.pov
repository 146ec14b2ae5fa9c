// A thin film on glass: what is totally reflected inside is coloured too.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2, -6> look_at <0, 0.6, 0> right 4/3*x angle 40 }
light_source { <0, 20, 20> rgb <3, 4, 4> }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.2] [1 rgb <0.6, 0.8, 1>] } scale 2 translate -1 } }
plane { y, -0.4 pigment { checker rgb 0.5 rgb 0.8 } }
box { <-1, -0.39, -1>, <1, 1, 1> rotate 20*y pigment { rgbf 1 }
  finish { diffuse 0 ambient 0 specular 1 roughness 0.001 reflection 0.05 irid { 0.65 thickness 0.8 turbulence 0.1 } } interior { ior 1.45 } }
