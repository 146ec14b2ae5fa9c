// Beside an image that is shown once there is no colour: what is metallic there mirrors and shines untinted.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.4, -5> look_at 0 right 4/3*x angle 50 }
background { rgb <0.5, 0.3, 0.2> }
light_source { <-5, 7, -6> rgb 1 }
plane { y, -1.1 pigment { checker rgb <0.9, 0.8, 0.3>, rgb <0.2, 0.4, 0.7> } }
#declare Once = pigment { image_map { function 4, 4 { pigment { gradient x color_map { [0 rgb <0.9, 0.1, 0.1>] [1 rgb <0.1, 0.8, 0.2>] } } } once } translate -0.5 }
sphere { -1.2*x, 1 texture { Once finish { reflection { 0.3 metallic } phong 0.6 metallic } } }
sphere { 1.2*x, 1 texture { pigment { rgb <0.3, 0.5, 0.8> } } texture { Once finish { reflection { 0.1, 0.5 falloff 2 metallic } specular 0.7 roughness 0.05 metallic } } rotate 20*y }
