// What no_shadow, no_image and no_reflection mean on members of a union that is kept whole, a merge, an intersection.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 5, -7> look_at <0, 0.3, 0> right 4/3*x angle 50 }
light_source { <-6, 12, -8> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.6 } }
plane { z, 4 pigment { rgb 0.1 } finish { reflection 0.8 } }
#declare Flag = array[3] { 0, 1, 2 }
#macro Member(Where, Which)
    sphere { Where, 0.6 #switch (Which) #case (0) no_shadow #break #case (1) no_image #break #else no_reflection #end }
#end
#for (I, 0, 2)
    union { Member(<-0.3, 0.7, 0>, I) box { <0, 0.2, -0.3>, <0.8, 0.6, 0.3> } split_union off pigment { rgb <0.9, 0.3, 0.3> } translate <2.4*I - 2.6, 0, 2> }
    merge { Member(<-0.3, 0.7, 0>, I) box { <0, 0.2, -0.3>, <0.8, 0.6, 0.3> } pigment { rgb <0.3, 0.9, 0.3> } translate <2.4*I - 2.6, 0, 0> }
    intersection { Member(<0, 0.7, 0>, I) box { <-0.5, 0.2, -0.5>, <0.5, 1, 0.5> } pigment { rgb <0.3, 0.3, 0.9> } translate <2.4*I - 2.6, 0, -2> }
#end
