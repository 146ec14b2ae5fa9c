// A mesh, its copies and smooth triangles, every length times S.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare S = pow(2, K);
camera { location <0, 2.5, -6>*S look_at <0, 0.6, 0>*S right 4/3*x angle 45 }
light_source { <-8, 12, -10>*S rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 scale S } }
#declare N = 8;
#declare Bump = mesh2 {
  vertex_vectors { (N+1)*(N+1) #for (I, 0, N) #for (J, 0, N) , <I/N-0.5, 0.3*cos(I/N*6)*sin(J/N*6), J/N-0.5>*S #end #end }
  normal_vectors { (N+1)*(N+1) #for (I, 0, N) #for (J, 0, N) , vnormalize(<1.8*sin(I/N*6)*sin(J/N*6), 1, -1.8*cos(I/N*6)*cos(J/N*6)>) #end #end }
  face_indices { 2*N*N #for (I, 0, N-1) #for (J, 0, N-1)
    , <I*(N+1)+J, (I+1)*(N+1)+J, I*(N+1)+J+1>, <(I+1)*(N+1)+J+1, (I+1)*(N+1)+J, I*(N+1)+J+1> #end #end }
}
object { Bump scale 2.4 translate <-1.3, 0.9, 0>*S pigment { rgb <0.9, 0.7, 0.2> } finish { phong 0.5 } }
object { Bump scale 2 rotate <-50, 30, 0> translate <1.3, 1.1, 0>*S pigment { rgb <0.3, 0.7, 0.8> } }
smooth_triangle { <-0.5, 0, -2>*S, <-1, 0.2, -1>, <0.5, 0, -2>*S, <1, 0.2, -1>, <0, 1, -1.7>*S, <0, 1, -1> pigment { rgb <0.3, 0.9, 0.5> } finish { phong 0.8 } }
