// clipped_by cuts; bounded_by changes nothing here.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
sphere { y, 1 clipped_by { plane { <1, 1, -0.3>, 0.6 } } bounded_by { box { <-1, 0, -1>, <1, 2, 1> } } pigment { rgb <0.9, 0.7, 0.3> } }
