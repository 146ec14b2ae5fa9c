// An octahedron as a mesh.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare A = <1,0,0>; #declare B = <0,0,1>; #declare T = y*1.3;
mesh {
  #for (I, 0, 3)
    #local P = vrotate(A, y*90*I); #local Q = vrotate(A, y*90*(I+1));
    triangle { P, Q, T } triangle { P, Q, -T }
  #end
  translate 1.3*y pigment { rgb <0.7, 0.4, 0.9> }
}
