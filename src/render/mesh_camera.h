/* mesh_camera.h - cameras that look out of the faces of a mesh (03-camera-and-sampling, section 2.1). */
#ifndef RENDER_MESH_CAMERA_H
#define RENDER_MESH_CAMERA_H

#include "render/camera.h"

typedef struct MeshCamera MeshCamera;

const MeshCamera *mesh_camera_new(Arena *arena, const World *w, int width, int height);    /* NULL: another kind of camera */
int mesh_camera_rays(const MeshCamera *m);     /* per sample */

/* Ray k of a sample; false: there is no face for it. reach: world units, INFINITY if unlimited. */
bool mesh_camera_ray(const MeshCamera *m, double x, double y, int k, CameraRay *out, double *reach);

#endif
