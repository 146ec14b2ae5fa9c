// Set operations within set operations, turned inside out once and twice, clipped, and with planes as members.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
camera { location <0, 4, -9> look_at <0, 0, 0> right 4/3*x angle 50 }
light_source { <5, 10, -8> rgb 1 }
plane { y, -1.5 pigment { checker rgb 0.9 rgb 0.5 } }
difference {
    sphere { 0, 1 }
    difference { box { <-1, 0, -1>, 1 } sphere { y, 0.6 } }
    pigment { rgb <1, 0.8, 0.2> }
    translate <3, 0, 2>
}
intersection {
    box { -1, 1 }
    union { sphere { 0, 1.2 } sphere { <1, 1, -1>, 0.6 } inverse }
    pigment { rgb <0.3, 0.8, 1> }
    rotate 20*y
    translate <-3, 0, -1>
}
merge {
    box { -0.7, 0.7 }
    intersection { sphere { 0, 1 } box { -0.9, 0.9 rotate 45*y } }
    pigment { rgbt <0.3, 0.8, 1, 0.6> }
    clipped_by { box { -1.2, <1.2, 0.6, 1.2> } }
    rotate 20*y
    translate <0, 0, -1.5>
}
difference {
    cylinder { -y, y, 1 open }
    box { <0, -2, -2>, 2 pigment { rgb 1 } }
    texture { pigment { rgb <0.9, 0.2, 0.2> } finish { reflection 0.2 } }
    interior_texture { pigment { rgb <0.2, 0.2, 0.9> } }
    rotate -30*y
    translate <2.5, 0, -1>
}
intersection {
    plane { y, 0.2 }
    plane { -y, 0.9 }
    #for (I, 0, 4) plane { z, 0.7 rotate (72*I + 11)*y } #end
    sphere { <0, 0.2, -0.7>, 0.5 inverse pigment { rgb <0.9, 0.9, 0.4> } }
    pigment { rgb <0.4, 0.9, 0.5> }
    translate <-0.2, 0, 2.2>
}
