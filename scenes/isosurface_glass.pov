// Isosurfaces tell only their first hits: what shines through them goes on behind each, in shadows too.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1.6, -6> look_at <0, -0.2, 0> right 4/3*x angle 42 }
background { rgb <0.3, 0.4, 0.6> }
light_source { <-2, 8, -3> rgb 1 }
plane { y, -1.2 pigment { checker rgb 1, rgb 0.6 } finish { diffuse 0.8 ambient 0 } }
#declare Glass = material { texture { pigment { rgbf <0.8, 0.9, 0.7, 0.8> } finish { ambient 0.1 diffuse 0.3 reflection 0.1 } } interior { ior 1.2 } }
isosurface {                                   // a shell: four surfaces to a ray, one asked for
  function { abs(x*x + y*y + z*z - 0.4) - 0.1 } contained_by { box { -0.8, 0.8 } } max_gradient 3
  material { Glass } translate <-1.5, 0, 0>
}
isosurface {
  function { y - 0.1*sin(9*x) } contained_by { box { -0.5, 0.5 } } max_gradient 2 max_trace 2
  material { Glass } rotate <10, 20, 30> translate <0, 0.4, 0.6>
}
difference {
  sphere { 0, 0.6 }
  isosurface { function { x*x + y*y + z*z - 0.15 } contained_by { sphere { 0, 0.9 } } max_gradient 4 translate 0.3*x }
  material { Glass } rotate 30*y translate <1.4, 0, 0>
}
