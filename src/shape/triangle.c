/* triangle.c - triangle { P1, P2, P3 } and smooth_triangle { P1, N1, P2, N2, P3, N3 }. */
#include "shape/triangle.h"

#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { Vec3 p[3]; } Params;
typedef struct { Vec3 p[3], n[3]; bool degenerate; } SmoothParams;

/* Scenes of very many triangles: the points stay where the parser put them. */
typedef struct { const Vec3 *p; double per_unit, turn; } Triangle;     /* turn: -1 where the normal is the other one */
typedef struct { Triangle t; Vec3 n[3]; } Smooth;

/* (P1 - P2) x (P3 - P2), in units of the triangle's size: zero for a degenerate one. */
static Vec3 face_normal(const Vec3 p[3])
{
    Vec3 a = sub(p[0], p[1]), b = sub(p[2], p[1]);
    double unit = build_unit(fmax(max_abs(a), max_abs(b)));
    return normalized(cross(scaled(a, 1 / unit), scaled(b, 1 / unit)));
}

/* POV: the first transform orders the points, by the sign of the normal along its largest axis. */
static bool reordered(Vec3 n)
{
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (x > y)
        return x > z ? n.x > 0 : n.z > 0;
    return y > z ? n.y < 0 : n.z > 0;
}

static double determinant(const Affine *a)
{
    return dot(vec3(a->m[0][0], a->m[0][1], a->m[0][2]), cross(vec3(a->m[1][0], a->m[1][1], a->m[1][2]),
                                                              vec3(a->m[2][0], a->m[2][1], a->m[2][2])));
}

static bool only_unit(const ShapeBuild *b)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            if (b->place.m[i][j] != (i == j ? b->unit : 0))
                return false;
    return true;
}

/* False for a degenerate one. */
static bool build(ShapeBuild *b, const Vec3 p[3], Triangle *t)
{
    Bounds box = bounds_of_points(p, 3);
    double unit = shape_unit(b, fmax(max_abs(box.lo), max_abs(box.hi)));
    Vec3 n = face_normal(p);
    if (max_abs(n) == 0)
        return false;
    *t = (Triangle){ p, 1 / unit, 1 };
    if (!only_unit(b))
        t->turn = (reordered(n) ? -1 : 1) * (determinant(&b->place) < 0 ? -1 : 1);
    Affine place = build_place(b, unit);
    build_prim(b, t, &place, shape_padded((Bounds){ scaled(box.lo, 1 / unit), scaled(box.hi, 1 / unit) }));
    return true;
}

static Vec3 point(const Triangle *t, int i)
{
    return scaled(t->p[i], t->per_unit);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Triangle *t = shape;
    TriRay r = tri_ray(ray);
    TriHit hit;
    if (tri_hit(&r, point(t, 0), point(t, 1), point(t, 2), &hit))
        hit_add_uv(sink, hit.t, 0, hit.u, hit.v);
}

static Vec3 mixed(const Vec3 v[3], const Hit *hit)
{
    return add(scaled(v[0], 1 - hit->u - hit->v), add(scaled(v[1], hit->u), scaled(v[2], hit->v)));
}

static void set_plane(const Triangle *t, const Hit *hit, Surface *out)
{
    const Vec3 p[3] = { point(t, 0), point(t, 1), point(t, 2) };
    out->normal = scaled(face_normal(p), t->turn);
    out->p = mixed(p, hit);
}

/* triangle */

static void parse(Parser *p, void *params)
{
    Params *t = params;
    t->p[0] = parse_vec3(p);
    t->p[1] = parse_next_vec3(p);
    t->p[2] = parse_next_vec3(p);
    if (max_abs(face_normal(t->p)) == 0)
        parse_warn(p, "Degenerate triangle. Please remove.");
}

static void compile(ShapeBuild *b, const void *params)
{
    build(b, ((const Params *)params)->p, build_data(b, sizeof(Triangle)));
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    set_plane(shape, hit, out);
}

static Bounds extent_of(const Vec3 p[3], const Affine *place)
{
    Vec3 q[3];
    for (int i = 0; i < 3; i++)
        q[i] = affine_point(place, p[i]);
    return bounds_of_points(q, 3);
}

static Bounds extent(const void *params, const Affine *place)
{
    return extent_of(((const Params *)params)->p, place);
}

const ShapeOps shape_triangle = {
    .keyword = "triangle", .params_size = sizeof(Params), .flags = SHAPE_PATCH, .parse = parse, .compile = compile,
    .hits = hits, .surface = surface, .extent = extent,
};

/* smooth_triangle */

static void parse_smooth(Parser *p, void *params)
{
    SmoothParams *t = params;
    int front = 0, behind = 0;
    for (int i = 0; i < 3; i++) {
        t->p[i] = i ? parse_next_vec3(p) : parse_vec3(p);
        Vec3 n = parse_next_vec3(p);
        t->n[i] = normalized(scaled(n, 1 / build_unit(max_abs(n))));
    }
    Vec3 face = face_normal(t->p);
    for (int i = 0; i < 3; i++) {
        front += dot(face, t->n[i]) > 0;
        behind += dot(face, t->n[i]) < 0;
    }
    t->degenerate = front < 3 && behind < 3;   /* POV: normals on both sides of the face hide it */
    if (t->degenerate)
        parse_warn(p, "Degenerate triangle. Please remove.");
}

static void compile_smooth(ShapeBuild *b, const void *params)
{
    const SmoothParams *s = params;
    Smooth *out = build_data(b, sizeof *out);
    if (s->degenerate || !build(b, s->p, &out->t))
        return;
    /* POV: transforms normalise the normals before they are mixed. */
    for (int i = 0; i < 3; i++)
        out->n[i] = scaled(s->n[i], 1 / (length(affine_normal(&b->place, s->n[i])) * b->unit));
}

static void surface_smooth(const void *shape, const Hit *hit, Surface *out)
{
    const Smooth *s = shape;
    set_plane(&s->t, hit, out);
    Vec3 flat = out->normal;
    out->normal = mixed(s->n, hit);
    out->geometric = dot(flat, out->normal) < 0 ? negated(flat) : flat;
}

static Bounds extent_smooth(const void *params, const Affine *place)
{
    return extent_of(((const SmoothParams *)params)->p, place);
}

const ShapeOps shape_smooth_triangle = {
    .keyword = "smooth_triangle", .params_size = sizeof(SmoothParams), .flags = SHAPE_PATCH | SHAPE_SMOOTH,
    .parse = parse_smooth, .compile = compile_smooth, .hits = hits, .surface = surface_smooth, .extent = extent_smooth,
};
