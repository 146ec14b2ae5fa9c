/* scene.h - all that a scene file says, after parsing and before compiling. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include "scene/object.h"

typedef enum CameraKind {
    CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC, CAMERA_FISHEYE, CAMERA_ULTRA_WIDE_ANGLE, CAMERA_OMNIMAX, CAMERA_PANORAMIC,
    CAMERA_SPHERICAL, CAMERA_CYLINDER_1, CAMERA_CYLINDER_2, CAMERA_CYLINDER_3, CAMERA_CYLINDER_4, CAMERA_MESH
} CameraKind;

typedef struct CameraDef {
    CameraKind kind;
    Vec3 location, direction, up, right, sky, look_at; /* final, after the order of effects of 03 section 2 */
    double angle, v_angle;                     /* degrees; 0 = not written */
    bool has_angle, has_v_angle;
    double aperture;                           /* focal blur; 0 = off */
    int blur_samples_min, blur_samples;
    double confidence, variance;
    double focal_distance;
    Vec3 focal_point;
    bool has_focal_point;
    const Pigment *bokeh;
    const Normal *normal;
    Affine place;                              /* transforms already applied to the vectors above, for the normal */
    const Object *const *mesh;                 /* mesh_camera */
    uint32_t n_mesh;
    int rays_per_pixel, distribution;
    double max_distance;
    bool smooth;
} CameraDef;

typedef struct FogDef {
    int type;                                  /* 1 constant, 2 ground */
    Colour colour;
    double distance, altitude, offset, turb_depth;
    bool has_turbulence;
    Turbulence turbulence;
    Vec3 up;
} FogDef;

typedef struct RainbowDef {
    double angle, width, distance, jitter, arc_angle, falloff_angle;
    Vec3 direction, up, antisolar;
    BlendMap map;
    const Pigment *pigment;
} RainbowDef;

typedef struct SkySphere {
    const Pigment *const *pigment;             /* in written order: later ones lie on top */
    uint32_t n;
    Rgb emission;
    Affine place;                              /* transforms of the sky_sphere itself */
} SkySphere;

typedef struct RadiosityDef {
    bool on, normal, media, always_sample, subsurface;
    float adc_bailout, brightness, error_bound, gray_threshold, low_error_factor, maximum_reuse, minimum_reuse,
        max_sample, pretrace_start, pretrace_end;
    int count, count_bank, nearest_count, nearest_count_adaptive, recursion_limit;
} RadiosityDef;

typedef struct PhotonsDef {
    bool on, media;
    float spacing, adc_bailout, autostop, expand_increase, jitter, media_factor, radius;
    int count, expand_min, gather_min, gather_max, max_trace_level, media_max_steps;
} PhotonsDef;

typedef enum GammaMode { GAMMA_NONE, GAMMA_POWER, GAMMA_SRGB } GammaMode;      /* NONE: legacy, no correction at all */

typedef struct Globals {
    double adc_bailout;                        /* default 1/255 */
    int max_trace_level;                       /* default 5 */
    int noise_generator;                       /* 1..3 */
    Rgb ambient_light, irid_wavelength;
    GammaMode assumed_gamma;
    bool has_assumed_gamma;
    double assumed_gamma_value;
    double mm_per_unit;
    int number_of_waves;
    int version;                               /* effective language version * 100 at the end: 370 */
    bool hf_gray_16;
    Colour background;
    bool has_background;
    RadiosityDef radiosity;
    PhotonsDef photons;
    bool subsurface, subsurface_radiosity;     /* default samples 50, 50 */
    int subsurface_samples_diffuse, subsurface_samples_single;
} Globals;

typedef struct Scene {
    const Object *const *object;               /* top level, lights among them, in scene order */
    uint32_t n_objects;
    CameraDef camera;
    bool has_camera;
    Globals globals;
    const FogDef *const *fog;                  uint32_t n_fog;
    const RainbowDef *const *rainbow;          uint32_t n_rainbow;
    const Media *const *media;                 uint32_t n_media;        /* atmospheric */
    const SkySphere *sky_sphere;
    const Texture *default_texture;
    unsigned unmodelled;                       /* SCENE_HAS_*: parsed, reported, not drawn */
} Scene;

enum { SCENE_HAS_PHOTONS = 2, SCENE_HAS_SUBSURFACE = 8 };

#endif
