// What whit is for: mirrors, glass, coloured shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 }
camera { location <0.6, 2.3, -6.6> look_at <0, 0.75, 0> right 4/3*x angle 46 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.98, 0.93, 0.85>] [0.45 rgb <0.45, 0.65, 0.92>] [1 rgb <0.08, 0.18, 0.45>] } } }
plane { y, 0 pigment { checker rgb <0.93, 0.92, 0.88> rgb <0.16, 0.2, 0.28> } finish { reflection { 0.04, 0.35 falloff 3 } } }
light_source { <-14, 20, -14> rgb <1, 0.96, 0.88> }
light_source { <18, 8, -10> rgb <0.25, 0.3, 0.42> shadowless }
#declare Glass = interior { ior 1.5 fade_distance 3 fade_power 2 fade_color <0.7, 0.95, 0.9> }
sphere { <-1.55, 1, 0.2>, 1 pigment { rgbf <0.96, 1, 0.98, 0.92> } finish { diffuse 0.1 specular 0.9 roughness 0.003 reflection { 0.05, 0.9 fresnel } conserve_energy } interior { Glass } }
sphere { <1.1, 1.1, 1>, 1.1 pigment { rgb <0.85, 0.55, 0.2> } finish { ambient 0.03 diffuse 0.25 brilliance 3 metallic specular 0.8 roughness 0.02 reflection { 0.5, 0.9 metallic } } }
difference {
  box { -0.6, 0.6 } sphere { 0, 0.78 }
  rotate 35*y translate <0.1, 0.6, -1.3> pigment { rgb <0.75, 0.12, 0.14> } finish { specular 0.6 roughness 0.02 reflection 0.06 }
}
#for (I, 0, 10)
  sphere { vrotate(<3.1, 0.28, 0>, -y*(I*19-5)) + 0.4*z, 0.28
    pigment { rgbf <0.5+0.5*sin(I*0.57), 0.5+0.5*sin(I*0.57+2.1), 0.5+0.5*sin(I*0.57+4.2), 0.65> }
    finish { specular 0.8 roughness 0.005 reflection 0.12 } interior { ior 1.4 } }
#end
