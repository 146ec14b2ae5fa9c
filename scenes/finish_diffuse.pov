// Ambient, diffuse, brilliance, emission.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#for (I, 0, 3)
  sphere { <I*1.3-1.95, 0.6, 0>, 0.6 pigment { rgb <0.9, 0.5, 0.3> } finish { ambient 0.1*I diffuse 0.9-0.2*I brilliance 0.5+I emission <0, 0, I*0.08> } }
#end
