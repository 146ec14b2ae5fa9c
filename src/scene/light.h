/* light.h - light sources as written; points and lengths in the light's own space (see Object.place). */
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "scene/texture.h"

typedef enum LightKind { LIGHT_POINT, LIGHT_SPOT, LIGHT_CYLINDER } LightKind;

typedef struct LightSource {
    LightKind kind;
    Vec3 location, point_at;                   /* point_at default <0,0,1> */
    Rgb colour;
    const BlendMap *colour_map;                /* not NULL: replaces colour by the sum of key * colour */
    bool parallel, shadowless, media_interaction, media_attenuation;
    double radius, falloff, tightness;         /* as written: degrees for a spotlight, lengths for a cylinder */
    double fade_distance, fade_power;
    bool area, jitter, orient, circular, area_illumination;
    Vec3 axis1, axis2;
    int size1, size2, adaptive;
    const Object *looks_like, *projected_through;   /* in the light's space; looks_like already moved to location */
    Loc loc;
} LightSource;

#endif
