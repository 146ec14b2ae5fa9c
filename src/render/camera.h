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

/* x, y: whole numbers are pixel centres. False: nothing is seen there. Not for mesh cameras. */
bool camera_ray(const Camera *c, double x, double y, CameraRay *out);

/* Do rays start in different places? */
bool camera_moves(const CameraDef *def);

#endif
