/* mesh_camera.c - see mesh_camera.h. Pixels number the faces of one or several meshes, or (baking) their places in uv space. */
#include "render/mesh_camera.h"

#include <string.h>

#include "shape/mesh.h"

enum { BUCKETS = 64 };                         /* per side of the unit square of uv */

typedef struct Face { Vec3 p[3], n; } Face;    /* in the mesh's own space */

typedef struct View {                          /* one mesh */
    const MeshParams *mesh;
    const Affine *place;                       /* NULL: identity */
} View;

struct MeshCamera {
    const CameraDef *def;
    double width, height, reach;
    View *view;
    uint32_t n_views;
    /* Baking: the faces whose uv may touch a bucket are bucket_face[bucket_start[b]] ... up to bucket_start[b + 1]. */
    uint32_t *bucket_start, *bucket_face;
};

static Vec3 vertex_of(const MeshParams *m, uint32_t i)
{
    Float3 v = m->vertex[i];
    return scaled(vec3((double)v.x, (double)v.y, (double)v.z), m->unit);
}

static Face face_of(const MeshParams *m, uint32_t i)
{
    Face f;
    for (int k = 0; k < 3; k++)
        f.p[k] = vertex_of(m, m->face[i].v[k]);
    f.n = normalized(cross(sub(f.p[0], f.p[1]), sub(f.p[2], f.p[1])));
    return f;
}

/* ---- baking ---- */

static bool uv_of(const MeshParams *m, uint32_t face, Vec2 uv[3])
{
    if (m->more->face_uv == NULL || m->more->face_uv[face].v[0] == MESH_NONE)
        return false;
    for (int k = 0; k < 3; k++)
        uv[k] = m->more->uv[m->more->face_uv[face].v[k]];
    return true;
}

static int bucket_of(double x)
{
    return (int)fmin(BUCKETS - 1, fmax(0, floor(x * BUCKETS)));
}

/* Counts, or (with `list`) writes down, the faces of every bucket; at[b] moves on. */
static void fill_buckets(const MeshParams *m, uint32_t *at, uint32_t *list)
{
    for (uint32_t i = 0; i < m->n_faces; i++) {
        Vec2 uv[3];
        if (!uv_of(m, i, uv))
            continue;
        int u1 = bucket_of(fmin(uv[0].u, fmin(uv[1].u, uv[2].u))), u2 = bucket_of(fmax(uv[0].u, fmax(uv[1].u, uv[2].u)));
        int v1 = bucket_of(fmin(uv[0].v, fmin(uv[1].v, uv[2].v))), v2 = bucket_of(fmax(uv[0].v, fmax(uv[1].v, uv[2].v)));
        for (int v = v1; v <= v2; v++)
            for (int u = u1; u <= u2; u++) {
                uint32_t *next = &at[v * BUCKETS + u];
                if (list != NULL)
                    list[*next] = i;
                (*next)++;
            }
    }
}

static void prepare_baking(Arena *arena, MeshCamera *c)
{
    const MeshParams *m = c->view[0].mesh;
    uint32_t n = BUCKETS * BUCKETS;
    uint32_t *count = arena_array(arena, uint32_t, n);
    c->bucket_start = arena_array(arena, uint32_t, n + 1);
    fill_buckets(m, count, NULL);
    for (uint32_t b = 0; b < n; b++) {
        c->bucket_start[b + 1] = c->bucket_start[b] + count[b];
        count[b] = c->bucket_start[b];
    }
    c->bucket_face = arena_array(arena, uint32_t, (size_t)c->bucket_start[n] + 1);
    fill_buckets(m, count, c->bucket_face);
}

static bool weights_in(const Vec2 t[3], double u, double v, double w[3])
{
    double d = (t[1].v - t[2].v) * (t[0].u - t[2].u) + (t[2].u - t[1].u) * (t[0].v - t[2].v);
    if (d == 0)
        return false;
    w[0] = ((t[1].v - t[2].v) * (u - t[2].u) + (t[2].u - t[1].u) * (v - t[2].v)) / d;
    w[1] = ((t[2].v - t[0].v) * (u - t[2].u) + (t[0].u - t[2].u) * (v - t[2].v)) / d;
    w[2] = 1 - w[0] - w[1];
    return w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
}

static Vec3 mixed(const Vec3 p[3], const double w[3])
{
    return add(add(scaled(p[0], w[0]), scaled(p[1], w[1])), scaled(p[2], w[2]));
}

static Vec3 smooth_normal(const MeshParams *m, uint32_t face, Vec3 flat, const double w[3])
{
    if (m->more->face_normal == NULL || m->more->face_normal[face].v[0] == MESH_NONE)
        return flat;
    Vec3 n[3];
    for (int k = 0; k < 3; k++) {
        Float3 v = m->more->normal[m->more->face_normal[face].v[k]];
        n[k] = vec3((double)v.x, (double)v.y, (double)v.z);
    }
    return normalized(mixed(n, w));
}

static bool bake(const MeshCamera *c, double u, double v, Vec3 *o, Vec3 *n)
{
    if (u < 0 || u > 1 || v < 0 || v > 1)
        return false;
    const MeshParams *m = c->view[0].mesh;
    uint32_t b = (uint32_t)(bucket_of(v) * BUCKETS + bucket_of(u));
    for (uint32_t i = c->bucket_start[b]; i < c->bucket_start[b + 1]; i++) {
        uint32_t face = c->bucket_face[i];
        Vec2 uv[3];
        double w[3];
        if (!uv_of(m, face, uv) || !weights_in(uv, u, v, w))
            continue;
        Face f = face_of(m, face);
        *o = mixed(f.p, w);
        *n = c->def->smooth ? smooth_normal(m, face, f.n, w) : f.n;
        return true;
    }
    return false;
}

/* ---- faces by number ---- */

static double least(double a, double b)
{
    return a < b ? a : b;
}

/* Which mesh, and which of its faces. POV: half a pixel off, so the first two rows are the same. */
static const View *find_face(const MeshCamera *c, double x, double y, int k, double *face)
{
    double column = trunc(fmax(0, least(c->width - 1, x + 0.5)));
    double row = trunc(fmax(0, least(c->height - 1, y - 0.5)));
    *face = row * c->width + column;
    if (c->def->distribution == 0)
        return (uint32_t)k < c->n_views ? &c->view[k] : NULL;
    if (c->def->distribution == 2) {
        uint32_t mesh = (uint32_t)(column / (c->width / c->n_views));
        *face = row * trunc(c->width / c->n_views) + column;
        return mesh < c->n_views ? &c->view[mesh] : NULL;
    }
    for (uint32_t i = 0; i < c->n_views && k == 0; i++) {
        if (*face < c->view[i].mesh->n_faces)
            return &c->view[i];
        *face -= c->view[i].mesh->n_faces;
    }
    return NULL;
}

/* ---- the camera ---- */

const MeshCamera *mesh_camera_new(Arena *arena, const World *w, int width, int height)
{
    const CameraDef *def = &w->camera;
    if (def->kind != CAMERA_MESH)
        return NULL;
    MeshCamera *c = arena_new(arena, MeshCamera);
    c->def = def;
    c->width = width;
    c->height = height;
    c->reach = def->max_distance > 0 ? def->max_distance * w->unit : INFINITY;
    c->view = arena_array(arena, View, def->n_mesh);
    for (uint32_t i = 0; i < def->n_mesh; i++) {
        const Object *o = def->mesh[i];
        if (o->kind == OBJECT_SHAPE && (strcmp(o->ops->keyword, "mesh") == 0 || strcmp(o->ops->keyword, "mesh2") == 0))
            c->view[c->n_views++] = (View){ o->params, o->place };
    }
    if (def->distribution == 3 && c->n_views > 0)
        prepare_baking(arena, c);
    return c;
}

int mesh_camera_rays(const MeshCamera *m)
{
    return m->def->rays_per_pixel;
}

bool mesh_camera_ray(const MeshCamera *c, double x, double y, int k, CameraRay *out, double *reach)
{
    const View *view;
    Vec3 o, n;
    if (c->n_views == 0)
        return false;
    if (c->def->distribution == 3) {
        view = &c->view[0];
        if (!bake(c, (fmax(0, least(c->width - 1, x + 0.5)) - 0.5) / c->width,
                  1 - (fmax(0, least(c->height - 1, y - 0.5)) + 0.5) / c->height, &o, &n))
            return false;
    } else {
        double face;
        view = find_face(c, x, y, k, &face);
        if (view == NULL || face >= view->mesh->n_faces)
            return false;
        Face f = face_of(view->mesh, (uint32_t)face);
        o = scaled(add(add(f.p[0], f.p[1]), f.p[2]), 1.0 / 3);
        n = f.n;
    }
    o = add(o, scaled(n, c->def->location.z));
    if (c->def->direction.z < 0)
        n = negated(n);
    Affine place = affine_of(view->place);
    *out = (CameraRay){ .o = affine_point(&place, o), .d = affine_vector(&place, n) };
    *reach = c->reach;
    return true;
}
