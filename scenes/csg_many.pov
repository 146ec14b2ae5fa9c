// A block with four hundred holes, a merge of as many balls, lenses, and a chain of differences.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 5, -7> look_at <0, 0.5, 0> right 4/3*x angle 50 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#declare R = seed(3);
#macro Point() <2*rand(R) - 1, 2*rand(R) - 1, 2*rand(R) - 1> #end
difference {
    box { -1, 1 pigment { rgb <0.9, 0.7, 0.4> } }
    #for (I, 1, 400) sphere { Point(), 0.15 } #end
    pigment { rgb <0.6, 0.3, 0.2> }
    rotate 30*y
    translate <-2.4, 1.05, 0>
}
merge {
    #for (I, 1, 400) sphere { Point(), 0.2 } #end
    pigment { rgbt <0.7, 0.8, 1, 0.7> }
    translate <0.2, 1.3, 0.3>
}
#for (I, 1, 100)
    #declare P = Point();
    intersection { sphere { P, 0.2 } sphere { P + <0.1, 0.1, 0.15>, 0.2 } pigment { rgb <rand(R), 0.5, 0.6> } translate <2.6, 1.3, 0> }
#end
#declare Chain = sphere { 0, 0.7 pigment { rgb <0.4, 0.9, 0.5> } }
#for (I, 1, 60) #declare Chain = difference { object { Chain } sphere { 0.7*vnormalize(Point()), 0.12 } } #end
object { Chain translate <0, 0.7, -2.5> }
