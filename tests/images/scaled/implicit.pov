// An isosurface and a parametric surface, with every length in units of U.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare U = pow(2, K);
#declare Bumps = function { pattern { bozo } }
camera { location <0, 2.5, -6>*U look_at <0, 0.6, 0>*U right 4/3*x angle 45 }
light_source { <-8, 12, -10>*U rgb 1 }
plane { y, -0.5*U pigment { checker rgb 0.9 rgb 0.35 scale U } }
isosurface {
  function { (x/U)*(x/U) + (y/U)*(y/U) + (z/U)*(z/U) - 0.6 + 0.2*sin(x*9/U)*sin(y*9/U)*sin(z*9/U) - Bumps(x*3/U, y*3/U, z*3/U)*0.1 }
  contained_by { box { -U, U } } max_gradient 5/U accuracy 0.001*U
  translate <-1.2, 1, 0>*U pigment { rgb <0.5, 0.7, 0.9> }
}
parametric {
  function { U*cos(u)*(0.6+0.3*cos(v)) } function { U*0.3*sin(v) } function { U*sin(u)*(0.6+0.3*cos(v)) } <0, 0>, <2*pi, 2*pi>
  contained_by { box { <-1, -0.5, -1>*U, <1, 0.5, 1>*U } } accuracy 0.001*U
  rotate -40*x translate <1.2, 0.8, 0>*U pigment { rgb <0.7, 0.4, 0.8> } finish { phong 0.5 }
}
