// A high bail-out cuts weak reflections.
#version 3.7;
global_settings { assumed_gamma 1.0 adc_bailout 0.2 max_trace_level 20 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#for (I, 0, 4)
  sphere { <I-2, 0.5, -I*0.3>, 0.5 pigment { rgb <0.2, 0.2+I*0.15, 0.6> } finish { reflection 0.5 } }
#end
