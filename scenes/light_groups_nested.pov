// Groups in groups neither lend nor borrow lights; a light in a union of a group shines everywhere.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 6, -7> look_at <0, 0.4, 0> right 4/3*x angle 50 }
light_source { <-8, 12, -10> rgb 0.4 }
plane { y, 0 pigment { checker rgb 0.9 rgb 0.35 } }
#default { pigment { rgb 1 } }
light_group {
    light_source { <0, 5, -2> rgb <1, 0.2, 0.2> }
    sphere { <-3, 0.8, 0>, 0.8 }
    light_group {
        light_source { <0, 5, -2> rgb <0.2, 1, 0.2> }
        sphere { <-1, 0.8, 0>, 0.8 }
        union { light_source { <3, 5, 0> rgb <0.4, 0.4, 0> } sphere { <-1, 0.4, -2>, 0.4 } }
    }
    light_group { light_source { <0, 5, -2> rgb <0.2, 0.2, 1> } sphere { <1, 0.8, 0>, 0.8 } global_lights on }
}
sphere { <3, 0.8, 0>, 0.8 }
light_group { light_source { <0, 5, -2> rgb <1, 0.2, 1> } sphere { <1, 0.4, -2>, 0.4 } global_lights on }
