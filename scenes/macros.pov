// A spiral stair by a recursive macro.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#macro Stair(N, H)
  #if (N > 0)
    box { <0.3, H, -0.25>, <1.4, H+0.1, 0.25> rotate -22*N*y pigment { rgb <0.9, 0.5+N*0.02, 0.2> } }
    Stair(N-1, H+0.12)
  #end
#end
union { Stair(16, 0) cylinder { 0, 2.2*y, 0.2 pigment { rgb 0.6 } } }
