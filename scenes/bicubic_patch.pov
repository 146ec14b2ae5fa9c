// A bicubic patch.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.5, -6> look_at <0, 0.6, 0> right 4/3*x angle 45 }
light_source { <-8, 12, -10> rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
bicubic_patch { type 1 flatness 0.001 u_steps 4 v_steps 4 <-1.5,0.2,-1>, <-0.5,1.2,-1>, <0.5,0.2,-1>, <1.5,1.5,-1>, <-1.5,0.6,-0.3>, <-0.5,2.4,-0.3>, <0.5,0.5,-0.3>, <1.5,1,-0.3>, <-1.5,0.2,0.4>, <-0.5,1.4,0.4>, <0.5,2.8,0.4>, <1.5,0.8,0.4>, <-1.5,0.3,1>, <-0.5,0.9,1>, <0.5,1,1>, <1.5,0.4,1> pigment { rgb <0.8, 0.5, 0.7> } finish { phong 0.5 } }
