#version 1.0
// Textures as they were written before version 3.0: no blocks for their parts.
camera { location <0 2 -7> direction <0 0 1.2> up <0 1 0> right <1.33 0 0> look_at <0 0.3 0> }
object { light_source { <10 20 -30> color red 1 green 1 blue 1 } }

composite {
   object {
      sphere { <-2.2 0.6 0> 1 }
      texture {
         granite
         color_map { [0.0 0.5 color red 1 color blue 1] [0.5 1.0 color blue 1 color green 1] }
         scale <0.5 0.5 0.5>
         ambient 0.3 diffuse 0.6 phong 1.0 phong_size 20
         bumps 0.4
      }
      color red 1
   }
   object {
      sphere { <0 0.6 0> 1 }
      texture { wood color_map { [0 1 color red 1 green 0.7 color red 0.4 green 0.2] } turbulence 0.1 rotate <20 30 0> scale <0.3 0.3 0.3> }
   }
   object {
      sphere { <2.2 0.6 0> 1 }
      texture { color red 0.2 green 0.5 blue 1 waves 0.6 frequency 6 phase 0.2 reflection 0.2 specular 0.6 roughness 0.02 }
   }
   translate <0 0.1 0>
}
object {
   plane { <0 1 0> -0.4 }
   texture { checker color red 0.9 green 0.9 blue 0.8 color green 0.3 ambient 0.2 }
}
