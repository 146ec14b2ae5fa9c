/* camera.h - from a place on the picture to a ray (03-camera-and-sampling, sections 1 and 2). */
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "world/world.h"

typedef struct Camera {
    const CameraDef *def;
    double width, height;                      /* of the picture */
    Vec3 right, up, direction;                 /* unit */
    double right_length, up_length;
    double angle, v_angle;                     /* radians, defaults filled in */
} Camera;

typedef struct CameraRay {                     /* scene space; d of any length */
    Vec3 o, d;
    Vec2 work;                                 /* where a camera normal is asked */
} CameraRay;

Camera camera_new(const CameraDef *def, int width, int height);

/* a x + b y + c z */
static inline Vec3 camera_blend(Vec3 a, double x, Vec3 b, double y, Vec3 c, double z)
{
    return add(add(scaled(a, x), scaled(b, y)), scaled(c, z));
}

/* For all kinds but perspective; u, v: from the middle of the picture, in its sizes, in out->work already. */
bool camera_bent_ray(const Camera *c, double u, double v, CameraRay *out);

static inline Vec2 camera_place(const Camera *c, double x, double y)
{
    return (Vec2){ (x + 0.5) / c->width - 0.5, 0.5 - (y + 0.5) / c->height };
}

/* Of an orthographic camera. */
static inline Vec3 camera_parallel_origin(const Camera *c, double u, double v)
{
    return camera_blend(c->def->location, 1, c->def->right, u, c->def->up, v);
}

/* Of a perspective camera. */
static inline Vec3 camera_direction(const Camera *c, double u, double v)
{
    return camera_blend(c->def->direction, 1, c->def->right, u, c->def->up, v);
}

/* x, y: whole numbers are pixel centres. False: nothing is seen there. Not for mesh cameras. */
static inline bool camera_ray(const Camera *c, double x, double y, CameraRay *out)
{
    const CameraDef *def = c->def;
    out->o = def->location;
    out->work = camera_place(c, x, y);
    double u = out->work.u, v = out->work.v;
    if (def->kind != CAMERA_PERSPECTIVE)
        return camera_bent_ray(c, u, v, out);
    out->d = camera_direction(c, u, v);
    return true;
}

/* Do rays start in different places? */
bool camera_moves(const CameraDef *def);

#endif
