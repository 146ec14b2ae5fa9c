/* path.h - inside the room: what the files of trace share. */
#ifndef TRACE_PATH_H
#define TRACE_PATH_H

#include <string.h>

#include "texture/texture.h"
#include "trace/trace.h"
#include "world/shaft.h"

enum { FOGS_MAX = 64, RAINBOWS_MAX = 64, HUES = 74 };

/* What POV-Ray takes for zero where colours and cosines are concerned: no lengths are compared with it. */
static const double TINY = 1e-10;

/* How far a ray goes that hits nothing, in world units (the scene is about 1 large). */
static const double FAR_AWAY = 2e10;

/* What lies within a few roundings of a light does not hide it: how much of the way to it counts. */
static const double LIGHT_END = 1 - 0x1p-36;

/* A place in the air may lie on the wall of the body whose media are sampled: the light is not to pass that wall. */
static const double AIR_START = 0x1p-28;

/* Rays within rays, straight ones counted too. A limit of the stack, far beyond what can be seen. */
enum { NESTING_MAX = 1000 };

typedef struct Bow {                           /* a rainbow made ready */
    const RainbowDef *def;
    Vec3 antisolar, right, up;
    double angle, width, arc, falloff, distance, jitter;       /* radians; arc and falloff are halves */
} Bow;

typedef struct MediaLimit { const Media *media; const double *threshold; } MediaLimit;

enum {                                         /* what a light takes, at the quality of the picture */
    LAMP_PLAIN = 1,                            /* shines alike everywhere: its beam is its colour */
    LAMP_SHADED = 2,                           /* things stand in its way */
    LAMP_AREA = 4,                             /* from many places */
    LAMP_AREA_LIGHT = 8,                       /* and lights from them, too */
    LAMP_SHINES = 16,                          /* in highlights */
    LAMP_REMEMBERED = 32,                      /* its shadow, for all layers of a hit */
    LAMPS_ALL = 63,
    LAMPS_GATHERED = LAMPS_ALL & ~(LAMP_AREA | LAMP_AREA_LIGHT | LAMP_SHINES)  /* area lights as points, no highlights */
};

typedef struct Ticket {                        /* limits of a ray and of all that comes from it */
    double adc_bailout;
    int max_level;
    int bounces;                               /* of diffuse light: how many gathering rays stand behind it */
    unsigned lamps;                            /* LAMP_* that count for it */
} Ticket;

/* A finish at work: one layer of a leaf. */
typedef struct Layer {
    const Finish *finish;
    Rgb colour;
    double opacity;
} Layer;

/* What is seen of a layer before any light falls on it. */
typedef struct Look {
    Layer layer;
    Rgb glow;                                  /* sent without any light */
    Rgb pass;                                  /* light of what is below */
    bool found;                                /* an image with `once` may have nothing here */
    bool hides;                                /* all below, and mirrors nothing */
    bool shines_only;                          /* of lights, shows no more than highlights: they may be left open */
} Look;

/* A texture as far as it can be shaded before anything is hit: all of one that is the same everywhere. */
typedef struct Coat {
    TextureLeaf leaf;                          /* all there is of it; top NULL: it is not the same everywhere */
    bool once;                                 /* its layer is all, and asks for each light once */
    bool matte;                                /* what is seen of it is glow, and what lights give to its top layer ... */
    const Pigment *pattern;                    /* ... whose colour is this; NULL: the same everywhere */
    Look look;                                 /* with a pattern: as if it were white */
} Coat;

/* What passes through a surface of a material, if that is the same wherever and however it is met. */
typedef struct Pane { bool even; Rgb passes; } Pane;

typedef struct Backdrop { Rgb light, through; } Backdrop;      /* a background: what it sends, what passes through it */

typedef struct LightList { const uint32_t *light; uint32_t n; } LightList;     /* in World.light */

typedef struct Gather Gather;                  /* radiosity.c: what one tracer has gathered */

struct Tracing {
    const World *world;
    int quality;
    bool alpha, legacy;                        /* legacy: the scene speaks a language before 3.7 */
    const Coat *coat;                          /* per texture of the World */
    const Pane *pane;                          /* per material of the World */
    Rgb ambient_light;                         /* none under radiosity, but in old scenes */
    bool plain_sky;                            /* the same all round: */
    Colour sky[2];                             /* not seen through, and seen through */
    Colour background;                         /* as the sky shows it */
    Backdrop backdrop[2];                      /* the same for skies from 3.7 on: not seen through, and seen through */
    bool wants_uv;                             /* some texture or object maps by uv */
    double to_scene;                           /* 1 / world->unit */
    Ticket ticket;                             /* of camera rays */
    bool radiosity;
    int max_level;
    bool has_media;                            /* in some body */
    bool has_air;                              /* fog, rainbows or media lie in front of what is seen */
    bool air_dims;                             /* fog or media weaken light where it meets no surface */
    bool shadows_dim;                          /* none brightens a light by more than roundings, nor takes chances */
    MediaLimit *media_limit;    uint32_t n_media_limits;       /* of media that sample adaptively */
    const FogDef *const *fog;   uint32_t n_fog;        /* those that are on */
    Bow *bow;                   uint32_t n_bows;
    double *stream;                            /* stream A, if anything draws from it */
    uint8_t *lamp;                             /* per light: LAMP_* */
    LightList *lit_by;                         /* per material of the World */
    uint32_t n_area_samples;                   /* of the largest area light */
    uint32_t *area_least;                      /* per light: how many of its samples are asked at the least */
    float hue[3][HUES];                        /* cumulative, red, green, blue */
};

/* Buffers of media.c: one stretch of the ray that a light reaches, or a part of one. */
typedef struct LightSpan { double from, to; uint32_t light; } LightSpan;
typedef struct MediaSpan { double from, to; bool lit; } MediaSpan;

/* Remembered for shadow rays: nook.c. */
enum { NOOK_PRIMS = 4 };
typedef struct Nook {
    Vec3 at;
    uint32_t light;
    uint8_t visits, n;
    bool known;
    uint8_t can_be_left;                       /* bit per prim */
    uint32_t prim[NOOK_PRIMS];                 /* the only ones that may lie between */
} Nook;

typedef struct AreaSample { Rgb colour; uint32_t stamp; } AreaSample;

typedef struct Path {
    Ray ray;                                   /* d of unit length (refracted: to rounding) */
    const Interiors *in;
    double weight;
    double wavelength;                         /* of one band of a dispersed ray, nm; 0: white */
    const Ticket *ticket;
    uint32_t skip;                             /* flags of prims not seen */
    int level;                                 /* bends behind it */
    bool straight;                             /* continues its parent without a bend: not counted */
    bool alpha;                                /* the background may be seen through */
} Path;

struct Tracer {
    const Tracing *tracing;
    const World *world;
    Streams chance;
    uint32_t *last_blocker;                    /* per light: prim + 1 that hid it last; 0 none */
    Nook *nook;
    int32_t *nook_credit;                      /* per light: negative if it is left alone */
    AreaSample *area;                          /* samples of the area light in work; valid if stamp is area_stamp */
    uint32_t area_stamp;
    uint32_t *lit, lit_stamp;                  /* the same where samples are lit or dark: penumbra.c */
    LightSpan *light_span;                     /* n_lights */
    MediaSpan *media_span;                     /* 2 n_lights + 1 */
    int nesting;
    Path eye;                                  /* of the camera */
    double depth;                              /* how far the path went that was traced last */
    Gather *gather;                            /* NULL: no radiosity */
    bool vain;                                 /* what lights give to camera rays does not matter: only gathering does */
};

/* A place that light reaches: on a surface, or in the air (surface NULL). */
typedef struct Spot {
    Tracer *t;
    Vec3 p;
    const Surface *surface;
    const Interiors *in;                       /* bodies around the ray that came here */
    uint32_t prim;                             /* of the surface */
} Spot;

/* One hit being shaded. */
enum { LIGHTS_REMEMBERED = 24 };
typedef struct Shade {
    Tracer *t;
    const Path *path;
    const Surface *surface;
    const Material *material;
    const LightList *lit_by;
    unsigned lamps;                            /* LAMP_* that count here */
    uint32_t interior;
    double depth;
    int level;                                 /* that secondary rays start with */
    TextureContext at;
    /* Light after shadows, the same for all layers of this hit. */
    Spot spot;
    uint32_t known;                            /* bit per light */
    Rgb light[LIGHTS_REMEMBERED];
    Colour sum;
} Shade;

/* What textures may ask of a hit. */
static inline TextureContext texture_context(const Tracing *tracing, const Surface *surface, Vec3 d)
{
    const Globals *globals = &tracing->world->globals;
    return (TextureContext){ .point = scaled(surface->p, tracing->to_scene), .ray = d, .normal = surface->normal, .uv = surface->uv,
                             .hit = true, .quality = tracing->quality, .number_of_waves = globals->number_of_waves,
                             .noise_generator = globals->noise_generator };
}

typedef struct Polish {                        /* of a layer, for what it mirrors */
    const Finish *finish;
    Vec3 n;                                    /* perturbed */
} Polish;

typedef struct Beam {                          /* light as it arrives: unshadowed */
    Vec3 l;                                    /* unit, towards the light */
    double d;                                  /* how far, as shadows and fading count it */
    Rgb colour;
} Beam;

/* trace.c */
Colour trace_path(Tracer *t, const Path *path);

/* shade.c */
void coat_prepare(Coat *coat, const Tracing *tracing, const Texture *texture);
Colour shade_hit(Tracer *t, const Path *path, const Hit *hit);

/* secondary.c: rays that leave a surface. */
/* Would a ray of this weight be black at once? */
static inline bool shade_gives_up(const Shade *s, double weight)
{
    return s->level >= s->path->ticket->max_level || weight < s->path->ticket->adc_bailout;
}

Colour shade_reflect(const Shade *s, const Polish *polish, double weight);     /* iridescent, not weighed */
typedef struct Passed { Rgb light; float t; } Passed;          /* t: how much of the background, as alpha has it */
/* What passes through the surface; returns whether all of it is reflected: t then stays. top: of the top layer. */
bool shade_transmit(const Shade *s, const Polish *top, Rgb filter, bool filtered, double through, Passed *passed);

/* light.c */
bool light_is_plain(const Light *light);
/* from: the light's place, or a sample of its area. */
void light_towards(const Light *light, const Vec3 *from, const Vec3 *p, Beam *out);      /* all but the colour */
bool light_beam(const Light *light, const Vec3 *from, const Vec3 *p, Rgb colour, Beam *out);      /* false: no light */
Rgb shade_lights(Shade *s, const Layer *layer, const Vec3 *n);         /* n: perturbed */
/* Leaves faint lights away, without asking for their shadows; with all that those may let through it would be *most. For scenes
 * with shadows_dim, and finishes without grain and film. */
Rgb shade_lights_loosely(Shade *s, const Layer *layer, const Vec3 *n, Rgb *most);

static inline bool is_dark(Rgb c)
{
    return fabsf(c[0]) < (float)TINY && fabsf(c[1]) < (float)TINY && fabsf(c[2]) < (float)TINY;
}

/* Leaves of beam->colour, which is not dark, what gets through to the spot, from all of the light's area if it has one. False: it
 * is dark. */
bool light_shadowed(const Spot *spot, uint32_t light, Beam *beam);

/* shadow.c: the same, from the light at distance beam->d alone. */
bool shadow_walk(const Spot *spot, uint32_t light, Beam *beam, const Shaft *among);    /* NULL: all prims */

static inline Ray shadow_ray(const Spot *spot, Vec3 l, double d)
{
    if (spot->surface != NULL)
        return (Ray){ surface_offset(spot->surface, l), l, 0, d * LIGHT_END };
    return (Ray){ spot->p, l, max_abs(spot->p) * AIR_START, d * LIGHT_END };
}

bool shadow_dims(const Tracer *t, const Light *light);     /* may it grow weaker where it meets no surface? */

/* nook.c */
typedef enum Seen { SEEN_NOT, SEEN_PERHAPS, SEEN_FULLY } Seen;
void nooks_start(Arena *arena, Tracer *t);
Seen nook_sees(const Spot *spot, uint32_t light, const Beam *beam);    /* if there is credit */

/* area.c */
Rgb area_visible(const Spot *spot, uint32_t light, Rgb colour);          /* mean over the samples */

typedef struct AreaAxes { Vec3 axis1, axis2; } AreaAxes;
AreaAxes area_axes(const Light *light, Vec3 l);        /* l: from the surface to the light's centre, which oriented lights face */
/* Displacement from the light's place. */
Vec3 area_sample_place(Tracer *t, const Light *light, const AreaAxes *axes, int u, int v);
uint32_t area_least_samples(const LightSource *def);

/* interior.c */
static inline void interiors_copy(Interiors *to, const Interiors *from)        /* not the unused part */
{
    to->n = from->n;
    for (uint32_t i = 0; i < from->n; i += 4)  /* four at once: mostly enough, and no call */
        memcpy(&to->at[i], &from->at[i], 4 * sizeof from->at[0]);
}

static inline void interiors_add(Interiors *list, uint32_t interior)
{
    if (list->n < INTERIORS_MAX)
        list->at[list->n++] = interior;
}

static inline void interiors_remove(Interiors *list, uint32_t place)
{
    list->n--;
    if (place < list->n)                       /* mostly it is the last */
        memmove(&list->at[place], &list->at[place + 1], (list->n - place) * sizeof list->at[0]);
}

static inline int interiors_find(const Interiors *list, uint32_t interior)     /* place, or -1 */
{
    for (uint32_t i = 0; i < list->n; i++)
        if (list->at[i] == interior)
            return (int)i;
    return -1;
}

bool interiors_hollow(const World *w, const Interiors *list);
double interior_ratio(const World *w, const Interiors *list, uint32_t interior);      /* ior here / ior around, for Fresnel */
Rgb interior_fade(const Interior *i, double depth);                    /* depth in scene units */

/* radiosity.c */
Gather *gather_new(Arena *arena, Radiosity *r);
void gather_free(Gather *g);
bool gather_here(const Shade *s);              /* does diffuse light of other surfaces count at this hit? */
/* n: perturbed, raw: not; weight: what is seen of it. */
Rgb gathered_light(const Shade *s, Vec3 n, Vec3 raw, double weight);

/* setup.c: by the number of samples; NULL: no more than the least are taken. */
const double *tracing_media_threshold(const Tracing *tracing, const Media *media);

/* media.c: lengths in world units. A stretch of a ray through media; `lit_for`: the material whose lights shine there, NULL for
 * all global ones. */
Colour media_air(Tracer *t, const Path *path, double depth, Colour c);
Colour media_bodies(Tracer *t, const Path *path, const Material *lit_for, double depth, Colour c);
Rgb media_dims_air(Tracer *t, Vec3 o, Vec3 d, double depth);           /* what extinction leaves of light */
Rgb media_dims_bodies(Tracer *t, const Interiors *in, Vec3 o, Vec3 d, double depth);

/* sky.c */
Backdrop backdrop_of(Colour background, bool alpha);
Colour sky_colour(const Tracing *tracing, Vec3 d, bool alpha);

/* fog.c: distances and points in world units. */
typedef struct FogPass { Rgb factor, added; } FogPass;
FogPass fog_pass(const Tracing *tracing, Vec3 o, Vec3 d, double depth);
Colour fog_apply(const Tracing *tracing, Vec3 o, Vec3 d, double depth, Colour c);

/* rainbow.c */
void bow_prepare(Bow *bow, const RainbowDef *def);
Colour rainbow_apply(Tracer *t, Vec3 d, double depth, Colour c);

/* dispersion.c */
void hue_fill(float hue[3][HUES]);
Rgb hue_of_band(const Tracing *tracing, double wavelength, double width);

#endif
