// One declared object, used four times.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare Pawn = union { cone { 0, 0.5, y, 0.2 } sphere { 1.2*y, 0.35 } }
#for (I, 0, 3)
  object { Pawn translate <I*1.1-1.65, 0, I*0.4> pigment { rgb <1-I/4, 0.4, I/4+0.2> } }
#end
