// An isosurface in a box and one in a sphere.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
isosurface { function { x*x + y*y + z*z - 0.6 + 0.2*sin(x*9)*sin(y*9)*sin(z*9) } contained_by { box { -1, 1 } } max_gradient 5 accuracy 0.0005 translate <-1.2, 1, 0> pigment { rgb <0.5, 0.7, 0.9> } }
isosurface { function { abs(x*y*z) - 0.05 } contained_by { sphere { 0, 0.9 } } max_gradient 2 accuracy 0.0005 open translate <1.2, 1, 0> pigment { rgb <0.9, 0.7, 0.4> } }
