/* mesh.c - what mesh and mesh2 have in common once they are parsed: one prim with a hierarchy of its own over triangles.
 *
 * Copies of a mesh share all of it. A hit's part is the number of the triangle, u and v are barycentric. */
#include "shape/mesh.h"

#include <string.h>

#include "sdl/parse.h"
#include "shape/shape.h"
#include "shape/triangle.h"

typedef struct Tree {
    const AccelOps *ops;
    const void *accel;                         /* item i is faces run[i] to run[i + 1] - 1 */
    const uint32_t *run;
} Tree;

typedef struct Mesh {
    const MeshParams *m;
    const Tree *tree;                          /* NULL: all faces are tested */
    const uint32_t *texture;                   /* of build_texture, by index in the mesh */
    const Vec3 *inward;                        /* direction of inside tests; NULL: no inside */
} Mesh;

static Vec3 to_vec3(Float3 v)
{
    return vec3((double)v.x, (double)v.y, (double)v.z);
}

/* ---- parsing ---- */

Float3 mesh_vertex(Parser *p, MeshParams *m, Vec3 v)
{
    if (m->unit == 0 && max_abs(v) > 0)
        m->unit = build_unit(max_abs(v));
    double per = m->unit > 0 ? 1 / m->unit : 1;
    Float3 f = { (float)(v.x * per) + 0.0f, (float)(v.y * per) + 0.0f, (float)(v.z * per) + 0.0f };    /* -0 is 0 */
    if (!(isfinite(f.x) && isfinite(f.y) && isfinite(f.z)))
        parse_fail(p, "the vertex <%g, %g, %g> is too far away for this mesh", v.x, v.y, v.z);
    return f;
}

Float3 mesh_normal(Vec3 n, bool *was_zero)
{
    double most = max_abs(n);
    *was_zero = !(most > 0 && most < INFINITY);
    n = *was_zero ? vec3(1, 0, 0) : normalized(scaled(n, 1 / build_unit(most)));
    return (Float3){ (float)n.x, (float)n.y, (float)n.z };
}

bool mesh_item(Parser *p, void *params)
{
    if (!parse_accept(p, KW_INSIDE_VECTOR))
        return false;
    Vec3 v = parse_vec3(p);
    mesh_more(p, params)->inside_vector = normalized(scaled(v, 1 / build_unit(max_abs(v))));
    return true;
}

static const MeshMore NO_MORE = { 0 };

void mesh_begin(MeshParams *m)
{
    m->more = &NO_MORE;
}

MeshMore *mesh_more(Parser *p, MeshParams *m)
{
    if (m->more == &NO_MORE)
        m->more = arena_new(parse_arena(p), MeshMore);
    return (MeshMore *)(uintptr_t)m->more;     /* this mesh's own */
}

void mesh_ready(MeshParams *m)
{
    Float3 lo = { INFINITY, INFINITY, INFINITY }, hi = { -INFINITY, -INFINITY, -INFINITY };
    for (uint32_t i = 0; i < m->n_faces; i++)
        for (int k = 0; k < 3; k++) {
            Float3 v = m->vertex[m->face[i].v[k]];
            lo = (Float3){ v.x < lo.x ? v.x : lo.x, v.y < lo.y ? v.y : lo.y, v.z < lo.z ? v.z : lo.z };
            hi = (Float3){ v.x > hi.x ? v.x : hi.x, v.y > hi.y ? v.y : hi.y, v.z > hi.z ? v.z : hi.z };
        }
    m->lo = lo;
    m->hi = hi;
}

static Bounds box_of(const MeshParams *m)
{
    return (Bounds){ to_vec3(m->lo), to_vec3(m->hi) };
}

/* ---- compiling ---- */

static Bounds face_box(const MeshParams *m, uint32_t i)
{
    Vec3 p[3];
    for (int k = 0; k < 3; k++)
        p[k] = to_vec3(m->vertex[m->face[i].v[k]]);
    return bounds_of_points(p, 3);
}

/* Items of the hierarchy are runs of faces, as neighbours often follow each other in the lists: two triangles that fill one
 * box cost nothing more in one item, and half the memory. A run grows while testing all of it, by the surface area
 * heuristic, stays within this factor of testing its faces apart. */
static const double RUN_COST = 1.25;
enum { RUN_MAX = 4 };

/* run[i] is where run i begins, run[n] the number of faces; returns n. */
static uint32_t find_runs(const MeshParams *m, uint32_t *run)
{
    uint32_t n = 0, length_ = 0;
    Bounds box = bounds_empty();
    double apart = 0;
    for (uint32_t i = 0; i < m->n_faces; i++) {
        Bounds next = face_box(m, i), both = bounds_union(box, next);
        double area = bounds_area(next);
        bool joins = length_ > 0 && length_ < RUN_MAX && bounds_area(both) * (length_ + 1) <= RUN_COST * (apart + area);
        if (!joins)
            run[n++] = i;
        length_ = joins ? length_ + 1 : 1;
        box = joins ? both : next;
        apart = joins ? apart + area : area;
    }
    run[n] = m->n_faces;
    return n;
}

/* Boxes serve the building only: they have an arena of their own. */
static void build_hierarchy(ShapeBuild *b, Mesh *mesh)
{
    Arena own;
    arena_init(&own);
    own.out_of_memory = b->arena->out_of_memory;
    own.user = b->arena->user;
    uint32_t *run = arena_array(&own, uint32_t, (size_t)mesh->m->n_faces + 1), n = find_runs(mesh->m, run);
    Bounds *box = arena_array(&own, Bounds, n);
    for (uint32_t i = 0; i < n; i++) {
        box[i] = bounds_empty();
        for (uint32_t face = run[i]; face < run[i + 1]; face++)
            box[i] = bounds_union(box[i], face_box(mesh->m, face));
    }
    Tree *tree = build_data(b, sizeof *tree);
    tree->ops = b->accel;
    tree->run = arena_copy(b->arena, run, ((size_t)n + 1) * sizeof *run);
    tree->accel = b->accel->build(b->arena, box, n);
    mesh->tree = tree;
    arena_free(&own);
}

/* Does every edge have another face that runs through it the other way? Sums of hashes answer: each edge adds for one
 * direction what it takes away for the other. */
static bool is_closed(const MeshParams *m)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < m->n_faces; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t a = m->face[i].v[k], z = m->face[i].v[(k + 1) % 3];
            uint64_t lo = a < z ? a : z, hi = a < z ? z : a, h = lo << 32 | hi;
            h = (h ^ h >> 31) * 0x9e3779b97f4a7c15u;
            h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9u;
            h ^= h >> 32;
            sum = a < z ? sum + h : sum - h;
        }
    return sum == 0;
}

/* An earlier one in the list that looks the same is taken again, if it is among the last ones of its hash. */
enum { RECENT_TEXTURES = 1024 };

static bool same_texture(const ListedTexture *a, const ListedTexture *b)
{
    return a->texture == b->texture && a->coloured == b->coloured && memcmp(&a->colour, &b->colour, sizeof a->colour) == 0;
}

static uint32_t colour_hash(const Colour *c)
{
    uint32_t bits[5], h = 0;
    memcpy(bits, c, sizeof bits);
    for (int i = 0; i < 5; i++)
        h = (h ^ bits[i]) * 0x9e3779b1u;
    return h >> 16;
}

static uint32_t listed_texture(ShapeBuild *b, const ListedTexture *t)
{
    if (!t->coloured)
        return build_texture(b, t->texture, NULL);
    Texture *own = build_data(b, sizeof *own);
    Pigment *pigment = build_data(b, sizeof *pigment);
    *pigment = (Pigment){ .kind = PIGMENT_PLAIN, .colour = t->colour };
    *own = *t->texture;
    own->pigment = pigment;
    return build_texture(b, own, NULL);
}

/* Only what some face has: a list may be longer. 0 is no texture yet. */
static const uint32_t *used_textures(ShapeBuild *b, const MeshParams *m)
{
    const MeshMore *more = m->more;
    uint32_t *texture = build_data(b, more->n_textures * sizeof *texture);
    uint32_t recent[RECENT_TEXTURES] = { 0 };  /* number in the list */
    for (uint32_t i = 0; more->face_texture != NULL && i < m->n_faces; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t t = more->face_texture[i].v[k];
            if (t == MESH_NONE || texture[t] != 0)
                continue;
            uint32_t *like = &recent[colour_hash(&more->texture[t].colour) % RECENT_TEXTURES];
            if (texture[*like] == 0 || !same_texture(&more->texture[*like], &more->texture[t])) {
                texture[t] = listed_texture(b, &more->texture[t]);
                *like = t;
            } else
                texture[t] = texture[*like];
        }
    return texture;
}

/* POV: the vector stays as written when the mesh is turned. It makes a difference only when there are holes. */
static const Vec3 *inward_of(ShapeBuild *b, const MeshParams *m)
{
    if (max_abs(m->more->inside_vector) == 0)
        return NULL;
    if (is_closed(m))
        return &m->more->inside_vector;
    Affine place = build_own_place(b);
    Vec3 *local = build_data(b, sizeof *local);
    *local = affine_vector_back(&place, m->more->inside_vector);
    *local = normalized(scaled(*local, 1 / build_unit(max_abs(*local))));
    return max_abs(*local) == 0 ? NULL : local;
}

void mesh_compile(ShapeBuild *b, const void *params)
{
    const MeshParams *m = params;
    if (m->n_faces == 0)
        return;
    Mesh *out = build_data(b, sizeof *out);
    *out = (Mesh){ .m = m, .inward = inward_of(b, m) };
    if (m->n_faces > RUN_MAX)
        build_hierarchy(b, out);
    if (m->more->n_textures > 0)
        out->texture = used_textures(b, m);
    b->no_inside = out->inward == NULL;
    double unit = m->unit > 0 ? m->unit : 1;
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(box_of(m)));
}

Bounds mesh_extent(const void *params, const Affine *place)
{
    const MeshParams *m = params;
    double unit = m->unit > 0 ? m->unit : 1;
    Bounds box = box_of(m);
    return bounds_transformed((Bounds){ scaled(box.lo, unit), scaled(box.hi, unit) }, place);
}

/* ---- tracing ---- */

typedef struct Walk {
    const Mesh *mesh;
    TriRay ray;
    HitSink *sink;
} Walk;

/* Says whether there was a hit. */
static bool test_faces(Walk *w, uint32_t first, uint32_t end)
{
    const Float3 *vertex = w->mesh->m->vertex;
    bool any = false;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *f = w->mesh->m->face[i].v;
        TriHit hit;
        if (tri_hit(&w->ray, to_vec3(vertex[f[0]]), to_vec3(vertex[f[1]]), to_vec3(vertex[f[2]]), &hit)) {
            hit_add_uv(w->sink, hit.t, i, hit.u, hit.v);
            any = true;
        }
    }
    return any;
}

static bool visit(void *user, uint32_t item, double *t_max)
{
    Walk *w = user;
    const uint32_t *run = w->mesh->tree->run + item;
    if (test_faces(w, run[0], run[1]))
        *t_max = hit_limit(w->sink);
    return false;
}

void mesh_hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Mesh *mesh = shape;
    Walk w = { mesh, tri_ray(ray), sink };
    double t_max = hit_limit(sink);
    if (mesh->tree != NULL)
        mesh->tree->ops->walk(mesh->tree->accel, ray, &t_max, visit, &w);
    else
        test_faces(&w, 0, mesh->m->n_faces);
}

typedef struct Parity {
    const Mesh *mesh;
    TriRay ray;
    bool odd;
} Parity;

/* Is the ray to the left of the edge from a to b? On it, it is moved aside a little, and a little less the other way: every
 * edge of a vertex answers for the same move, so nothing is counted twice (Edelsbrunner and Muecke, Simulation of
 * Simplicity, 1990). */
static bool left_of(double ax, double ay, double bx, double by)
{
    double edge = ax * by - ay * bx;
    return edge != 0 ? edge > 0 : ay != by ? ay > by : bx > ax;
}

static void count_face(Parity *c, uint32_t i)
{
    const MeshParams *m = c->mesh->m;
    const uint32_t *f = m->face[i].v;
    double x[3], y[3], z[3], sum = 0, depth = 0;
    for (int k = 0; k < 3; k++) {
        Vec3 p = sub(to_vec3(m->vertex[f[k]]), c->ray.o);
        z[k] = vec3_at(p, c->ray.kz);
        x[k] = vec3_at(p, c->ray.kx) - c->ray.sx * z[k];
        y[k] = vec3_at(p, c->ray.ky) - c->ray.sy * z[k];
    }
    int left = 0;
    for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3, over = (k + 2) % 3;
        double edge = x[k] * y[n] - y[k] * x[n];
        left += left_of(x[k], y[k], x[n], y[n]);
        sum += edge;
        depth += edge * z[over];
    }
    if ((left == 0 || left == 3) && sum != 0 && c->ray.sz * depth / sum > 0)
        c->odd = !c->odd;
}

static bool count(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    Parity *c = user;
    const uint32_t *run = c->mesh->tree->run + item;
    for (uint32_t i = run[0]; i < run[1]; i++)
        count_face(c, i);
    return false;
}

bool mesh_inside(const void *shape, Vec3 p)
{
    const Mesh *mesh = shape;
    if (mesh->inward == NULL)
        return false;
    Ray ray = { p, *mesh->inward, 0, INFINITY };
    Parity c = { mesh, tri_ray(&ray), false };
    double t_max = INFINITY;
    if (mesh->tree != NULL)
        mesh->tree->ops->walk(mesh->tree->accel, &ray, &t_max, count, &c);
    else
        for (uint32_t i = 0; i < mesh->m->n_faces; i++)
            count_face(&c, i);
    return c.odd;
}

/* ---- the surface ---- */

static void set_textures(const Mesh *mesh, const Index3 *face, double u, double v, Surface *out)
{
    const double weight[3] = { 1 - u - v, u, v };
    out->n_textures = 0;
    if (face->v[0] == face->v[1] && face->v[0] == face->v[2]) {
        if (face->v[0] != MESH_NONE) {
            out->texture[0].texture = mesh->texture[face->v[0]];
            out->texture[0].weight = 1;
            out->n_textures = 1;
        }
        return;
    }
    for (int k = 0; k < 3; k++) {
        out->texture[k].texture = face->v[k] == MESH_NONE ? 0 : mesh->texture[face->v[k]];
        out->texture[k].weight = (float)fmax(0, fmin(1, weight[k]));
    }
    out->n_textures = 3;
}

void mesh_surface(const void *shape, const Hit *hit, Surface *out)
{
    const Mesh *mesh = shape;
    const MeshParams *m = mesh->m;
    const MeshMore *more = m->more;
    const Index3 *face = &m->face[hit->part];
    double u = hit->u, v = hit->v, w = 1 - u - v;
    Vec3 p[3];
    for (int k = 0; k < 3; k++)
        p[k] = to_vec3(m->vertex[face->v[k]]);
    out->p = add(p[0], add(scaled(sub(p[1], p[0]), u), scaled(sub(p[2], p[0]), v)));
    out->normal = normalized(cross(sub(p[0], p[1]), sub(p[2], p[1])));
    if (more->face_normal != NULL && more->face_normal[hit->part].v[0] != MESH_NONE) {
        const Index3 *index = &more->face_normal[hit->part];
        Vec3 n[3];
        for (int k = 0; k < 3; k++)
            n[k] = to_vec3(more->normal[index->v[k]]);
        /* POV: normals that are all the same leave the face flat. */
        if (length2(sub(n[0], n[1])) > 1e-10 || length2(sub(n[0], n[2])) > 1e-10) {
            out->geometric = out->normal;
            out->normal = add(scaled(n[0], w), add(scaled(n[1], u), scaled(n[2], v)));
        }
    }
    if (out->want_uv) {
        out->uv = (Vec2){ 0, 0 };
        if (more->face_uv != NULL && more->face_uv[hit->part].v[0] != MESH_NONE) {
            const uint32_t *index = more->face_uv[hit->part].v;
            Vec2 a = more->uv[index[0]], b = more->uv[index[1]], c = more->uv[index[2]];
            out->uv = (Vec2){ w * a.u + u * b.u + v * c.u, w * a.v + u * b.v + v * c.v };
        }
    }
    if (more->face_texture != NULL)
        set_textures(mesh, &more->face_texture[hit->part], u, v, out);
}
