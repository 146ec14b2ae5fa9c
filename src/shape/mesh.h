/* mesh.h - triangles that share vertices: what mesh and mesh2 parse into, and what both do with it afterwards. */
#ifndef SHAPE_MESH_H
#define SHAPE_MESH_H

#include "base/array.h"
#include "scene/ops.h"

typedef struct { float x, y, z; } Float3;
typedef struct { uint32_t v[3]; } Index3;

#define MESH_NONE UINT32_MAX

/* What a mesh of a few flat triangles goes without. */
typedef struct MeshMore {
    Float3 *normal;
    Vec2 *uv;
    const ListedTexture *texture;
    Index3 *face_normal;                       /* into normal; NULL: all flat; v[0] == MESH_NONE: this one is */
    Index3 *face_uv;                           /* into uv; NULL or MESH_NONE: <0,0> */
    Index3 *face_texture;                      /* into texture; NULL or MESH_NONE: the mesh's own */
    uint32_t n_normals, n_uvs, n_textures;
    Vec3 inside_vector;
} MeshMore;

/* POV: vertices and normals are single precision. Here they are in units of a power of two near their size, so that a scale
 * of the scene by a power of two changes no bits. One line of the cache: some scenes have a mesh for every triangle. */
typedef struct MeshParams {
    double unit;
    Float3 *vertex;
    Index3 *face;                              /* into vertex */
    const MeshMore *more;                      /* never NULL */
    uint32_t n_vertices, n_faces;
    Float3 lo, hi;                             /* in units: bounds of all faces */
} MeshParams;

/* The vertex in units of the mesh; the first one that is not 0 chooses them. */
Float3 mesh_vertex(Parser *p, MeshParams *m, Vec3 v);
Float3 mesh_normal(Vec3 n, bool *was_zero);    /* of length 1; POV: x for 0 */

void mesh_begin(MeshParams *m);
MeshMore *mesh_more(Parser *p, MeshParams *m); /* to be written to */
void mesh_ready(MeshParams *m);                /* all lists are there */
bool mesh_item(Parser *p, void *params);       /* inside_vector V */
void mesh_compile(ShapeBuild *b, const void *params);
void mesh_hits(const void *shape, const Ray *ray, HitSink *sink);
bool mesh_inside(const void *shape, Vec3 p);
void mesh_surface(const void *shape, const Hit *hit, Surface *out);
Bounds mesh_extent(const void *params, const Affine *place);

#endif
