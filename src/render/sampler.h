/* sampler.h - the colour at a place of the picture: camera, camera normal, focal blur, then the ray. */
#ifndef RENDER_SAMPLER_H
#define RENDER_SAMPLER_H

#include "render/blur.h"
#include "render/camera.h"
#include "render/mesh_camera.h"
#include "render/render.h"
#include "trace/radiosity.h"

/* Shared by all threads. */
typedef struct Sampling {
    const World *world;
    const Tracing *tracing;
    Camera camera;
    const Blur *blur;                          /* NULL: none */
    const Vec2 *blur_cell;                     /* [16 * row + column]: the place that a sample in this cell of a pixel has */
    const MeshCamera *mesh;                    /* NULL: another kind of camera */
    PositionHash hash;
    Vec3 across, down;                         /* of the aperture */
    double radius;                             /* half its diameter */
    double focus;                              /* distance of what is sharp, in lengths of the camera's direction */
    Bounds home;                               /* rays from here start in the same bodies; empty: nothing is known */
    bool moves;                                /* rays may start elsewhere */
    bool pinhole;                              /* rays all start at the camera's location, one for each sample */
    bool parallel;                             /* rays all lead along the camera's direction, one for each sample */
} Sampling;

enum { SAMPLER_ROW = 36 };                     /* places, a multiple of 4 */

typedef struct Sampler {
    const Sampling *sampling;
    Tracer *tracer;
    Ray *ray;                                  /* of the tracer's eye */
    Interiors at_home, elsewhere;              /* the bodies around the eye */
    double row_x, row_y;                       /* the first place of the row ... */
    double row[3][SAMPLER_ROW];                /* ... and what the rays of all differ in, as the plainest cameras have it: x, y, z */
} Sampler;

Sampling *sampling_new(Arena *arena, const World *w, const RenderOptions *options);
void sampler_init(Sampler *s, Arena *arena, const Sampling *sampling, Radiosity *radiosity);
void sampler_free(Sampler *s);

/* Has the tile used chance that other tiles have not? */
bool sampler_took_chances(const Sampler *s);

/* Whole numbers are pixel centres. */
Colour sampler_colour(Sampler *s, double x, double y);

/* The same of n <= SAMPLER_ROW places side by side, whose rays are worked out four at a time; then asked one by one, other places
 * in between at will. */
void sampler_row(Sampler *s, double x, double y, int n);
Colour sampler_in_other_row(Sampler *s, int i);         /* of all but pinhole cameras */
static inline Colour sampler_in_row(Sampler *s, int i)
{
    if (!s->sampling->pinhole)
        return sampler_in_other_row(s, i);
    s->ray->d = vec3(s->row[0][i], s->row[1][i], s->row[2][i]);
    return tracer_look(s->tracer, &s->at_home);
}

#endif
