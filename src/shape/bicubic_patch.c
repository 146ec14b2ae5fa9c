/* bicubic_patch.c - bicubic_patch { type T flatness F u_steps U v_steps V, 16 points }: a Bezier surface cut into flat quarters.
 *
 * POV: how finely it is cut is a matter of the picture, so it is done the same way: by a flatness that is a length in the
 * scene, after all transforms. Control points are therefore taken to the World first, and the triangles stay there.
 * Types 0 and 1 (less memory or more speed) give the same triangles. */
#include "base/array.h"
#include "sdl/parse.h"
#include "shape/shape.h"
#include "shape/triangle.h"

typedef struct {
    int type, u_steps, v_steps;
    double flatness;
    bool has_type;
    Vec2 st[4];
    Vec3 point[4][4];
} Params;

/* Corners in the order (u0,v0), (u0,v1), (u1,v1), (u1,v0); triangles 0 1 2 and 0 2 3. */
typedef struct { Vec3 at[4]; float normal[4][3]; double u0, v0, u1, v1; bool sliver[2]; } Leaf;

typedef struct { const AccelOps *ops; const void *accel; const Leaf *leaf; Vec2 st[4]; } Patch;

enum { MAX_LEAVES = 1 << 20 };

/* ---- parsing ---- */

static void parse_old_numbers(Parser *p, Params *b)
{
    parse_warn(p, "Should use keywords for bicubic parameters.");
    b->type = parse_int(p);
    b->has_type = true;
    b->flatness = b->type == 2 || b->type == 3 ? parse_next_float(p) : 0.1;
    parse_comma(p);
    b->u_steps = parse_int(p);
    parse_comma(p);
    b->v_steps = parse_int(p);
}

static bool parse_keyword(Parser *p, Params *b)
{
    if (parse_accept(p, KW_TYPE)) {
        b->type = parse_int(p);
        b->has_type = true;
    } else if (parse_accept(p, KW_FLATNESS))
        b->flatness = parse_float(p);
    else if (parse_accept(p, KW_U_STEPS))
        b->u_steps = parse_int(p);
    else if (parse_accept(p, KW_V_STEPS))
        b->v_steps = parse_int(p);
    else if (parse_accept(p, KW_ACCURACY))
        parse_float(p);                        /* POV: read and not used */
    else
        return false;
    return true;
}

static void parse(Parser *p, void *params)
{
    Params *b = params;
    b->st[1].u = b->st[2].u = b->st[2].v = b->st[3].v = 1;
    if (parse_peek(p) == TOK_NUMBER)
        parse_old_numbers(p, b);
    while (parse_keyword(p, b))
        parse_comma(p);
    if (parse_accept(p, KW_UV_VECTORS))
        for (int i = 0; i < 4; i++) {
            parse_comma(p);
            b->st[i] = parse_vec2(p);
        }
    if (!b->has_type || b->type < 0)
        parse_fail(p, "a bicubic_patch needs its type, 0 or 1");
    if (b->type > 1)
        parse_warn(p, "Patch type > 1 no longer supported. Using type 1.");
    parse_comma(p);
    for (int i = 0; i < 16; i++)
        b->point[i / 4][i % 4] = parse_next_vec3(p);
}

/* ---- cutting ---- */

typedef struct Cut {
    Arena arena;                               /* of leaves while they become more, and of their boxes */
    ShapeBuild *b;
    const Params *params;
    double flatness;
    Leaf *leaf;
    uint32_t n, capacity;
} Cut;

typedef struct Piece { Vec3 p[4][4]; double u0, u1, v0, v1; } Piece;

static double off_plane(const Vec3 p[4][4])
{
    Vec3 a = sub(p[0][3], p[0][0]), b = sub(p[3][0], p[0][0]);
    if (length2(a) <= 1e-20 * length2(b))      /* two corners are one: a triangle */
        a = sub(p[3][3], p[0][0]);
    Vec3 n = cross(a, b);
    if (!(length2(n) > 1e-20 * length2(a) * length2(b)))
        return INFINITY;
    n = normalized(n);
    double most = 0;
    for (int i = 0; i < 16; i++)
        most = fmax(most, fabs(dot(n, sub(p[i / 4][i % 4], p[0][0]))));
    return most;
}

static void halves(const Vec3 p[4], Vec3 left[4], Vec3 right[4])
{
    Vec3 a = lerp(p[0], p[1], 0.5), m = lerp(p[1], p[2], 0.5), c = lerp(p[2], p[3], 0.5);
    Vec3 am = lerp(a, m, 0.5), mc = lerp(m, c, 0.5), all = lerp(am, mc, 0.5);
    left[0] = p[0];
    left[1] = a;
    left[2] = am;
    left[3] = right[0] = all;
    right[1] = mc;
    right[2] = c;
    right[3] = p[3];
}

static void split_v(const Piece *whole, Piece *low, Piece *high)
{
    *low = *high = *whole;
    for (int i = 0; i < 4; i++)
        halves(whole->p[i], low->p[i], high->p[i]);
    low->v1 = high->v0 = 0.5 * (whole->v0 + whole->v1);
}

static void split_u(const Piece *whole, Piece *low, Piece *high)
{
    *low = *high = *whole;
    for (int j = 0; j < 4; j++) {
        Vec3 column[4], left[4], right[4];
        for (int i = 0; i < 4; i++)
            column[i] = whole->p[i][j];
        halves(column, left, right);
        for (int i = 0; i < 4; i++) {
            low->p[i][j] = left[i];
            high->p[i][j] = right[i];
        }
    }
    low->u1 = high->u0 = 0.5 * (whole->u0 + whole->u1);
}

static void bernstein(double t, double b[4], double slope[4])
{
    double s = 1 - t;
    b[0] = s * s * s;
    b[1] = 3 * s * s * t;
    b[2] = 3 * s * t * t;
    b[3] = t * t * t;
    slope[0] = -3 * s * s;
    slope[1] = 3 * s * s - 6 * s * t;
    slope[2] = 6 * s * t - 3 * t * t;
    slope[3] = 3 * t * t;
}

/* The exact normal of the curved surface. POV: x where it has none. */
static Vec3 normal_at(const Vec3 p[4][4], double u, double v)
{
    double bu[4], du[4], bv[4], dv[4];
    bernstein(u, bu, du);
    bernstein(v, bv, dv);
    Vec3 pu = vec3(0, 0, 0), pv = pu;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            pu = add(pu, scaled(p[i][j], du[i] * bv[j]));
            pv = add(pv, scaled(p[i][j], bu[i] * dv[j]));
        }
    Vec3 n = cross(pu, pv);
    return length2(n) > 1e-10 * length2(pu) * length2(pv) ? normalized(n) : vec3(1, 0, 0);
}

static bool is_sliver(Vec3 a, Vec3 b, Vec3 c)
{
    Vec3 e = sub(b, a), f = sub(c, a);
    return length2(cross(e, f)) <= 1e-10 * length2(e) * length2(f);
}

static _Noreturn void too_fine(Cut *cut)
{
    arena_free(&cut->arena);
    fail(cut->b->diag, cut->b->object->loc, "this bicubic_patch is cut into more than %d pieces: use fewer steps or more flatness",
         MAX_LEAVES);
}

static void add_leaf(Cut *cut, const Vec3 whole[4][4], const Piece *piece)
{
    if (cut->n == MAX_LEAVES)
        too_fine(cut);
    if (cut->n == cut->capacity)
        cut->leaf = array_grow(&cut->arena, cut->leaf, cut->n, &cut->capacity, sizeof *cut->leaf);
    Leaf *leaf = &cut->leaf[cut->n++];
    const double u[4] = { piece->u0, piece->u0, piece->u1, piece->u1 }, v[4] = { piece->v0, piece->v1, piece->v1, piece->v0 };
    *leaf = (Leaf){ .at = { piece->p[0][0], piece->p[0][3], piece->p[3][3], piece->p[3][0] },
                    .u0 = piece->u0, .v0 = piece->v0, .u1 = piece->u1, .v1 = piece->v1 };
    for (int k = 0; k < 4; k++) {
        Vec3 n = normal_at(whole, u[k], v[k]);
        leaf->normal[k][0] = (float)n.x;
        leaf->normal[k][1] = (float)n.y;
        leaf->normal[k][2] = (float)n.z;
    }
    leaf->sliver[0] = is_sliver(leaf->at[0], leaf->at[1], leaf->at[2]);
    leaf->sliver[1] = is_sliver(leaf->at[0], leaf->at[2], leaf->at[3]);
}

static void cut_up(Cut *cut, const Vec3 whole[4][4], const Piece *piece, int depth)
{
    bool in_u = depth < cut->params->u_steps, in_v = depth < cut->params->v_steps;
    if ((!in_u && !in_v) || off_plane(piece->p) < cut->flatness) {
        add_leaf(cut, whole, piece);
        return;
    }
    Piece half[2], quarter[2];
    if (in_u)
        split_u(piece, &half[0], &half[1]);
    for (int i = 0; i < (in_u ? 2 : 1); i++) {
        const Piece *part = in_u ? &half[i] : piece;
        if (in_v) {
            split_v(part, &quarter[0], &quarter[1]);
            cut_up(cut, whole, &quarter[0], depth + 1);
            cut_up(cut, whole, &quarter[1], depth + 1);
        } else
            cut_up(cut, whole, part, depth + 1);
    }
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *q = params;
    Piece whole = { .u1 = 1, .v1 = 1 };
    for (int i = 0; i < 16; i++)
        whole.p[i / 4][i % 4] = affine_point(&b->place, q->point[i / 4][i % 4]);
    Cut cut = { .b = b, .params = q, .flatness = q->flatness * b->unit };
    arena_init(&cut.arena);
    cut.arena.out_of_memory = b->arena->out_of_memory;
    cut.arena.user = b->arena->user;
    if (!(cut.flatness > 0) && fmax(0, q->u_steps) + fmax(0, q->v_steps) > 20)
        too_fine(&cut);                        /* nothing will stop it */
    cut_up(&cut, whole.p, &whole, 0);
    Bounds *box = arena_array(&cut.arena, Bounds, cut.n), all = bounds_of_points(&whole.p[0][0], 16);
    for (uint32_t i = 0; i < cut.n; i++)
        box[i] = bounds_of_points(cut.leaf[i].at, 4);
    Patch *out = build_data(b, sizeof *out);
    *out = (Patch){ .ops = b->accel, .accel = b->accel->build(b->arena, box, cut.n),
                    .leaf = arena_copy(b->arena, cut.leaf, cut.n * sizeof *cut.leaf) };
    arena_free(&cut.arena);
    for (int i = 0; i < 4; i++)
        out->st[i] = q->st[i];
    Affine none = affine_identity();
    build_prim(b, out, &none, shape_padded(all));
}

/* ---- tracing ---- */

typedef struct { const Leaf *leaf; TriRay ray; HitSink *sink; } Walk;

static bool visit(void *user, uint32_t i, double *t_max)
{
    Walk *w = user;
    const Leaf *leaf = &w->leaf[i];
    for (uint32_t k = 0; k < 2; k++) {
        TriHit hit;
        if (!leaf->sliver[k] && tri_hit(&w->ray, leaf->at[0], leaf->at[k + 1], leaf->at[k + 2], &hit)) {
            hit_add_uv(w->sink, hit.t, 2 * i + k, hit.u, hit.v);
            *t_max = hit_limit(w->sink);
        }
    }
    return false;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Patch *patch = shape;
    Walk w = { patch->leaf, tri_ray(ray), sink };
    double t_max = hit_limit(sink);
    patch->ops->walk(patch->accel, ray, &t_max, visit, &w);
}

static Vec3 leaf_normal(const Leaf *leaf, uint32_t k)
{
    return vec3((double)leaf->normal[k][0], (double)leaf->normal[k][1], (double)leaf->normal[k][2]);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Patch *patch = shape;
    const Leaf *leaf = &patch->leaf[hit->part / 2];
    uint32_t k = hit->part % 2;
    double weight[3] = { 1 - hit->u - hit->v, hit->u, hit->v };
    const uint32_t corner[3] = { 0, k + 1, k + 2 };
    const double u[4] = { leaf->u0, leaf->u0, leaf->u1, leaf->u1 }, v[4] = { leaf->v0, leaf->v1, leaf->v1, leaf->v0 };
    double pu = 0, pv = 0;
    out->p = out->normal = vec3(0, 0, 0);
    for (int i = 0; i < 3; i++) {
        out->p = add(out->p, scaled(leaf->at[corner[i]], weight[i]));
        out->normal = add(out->normal, scaled(leaf_normal(leaf, corner[i]), weight[i]));
        pu += weight[i] * u[corner[i]];
        pv += weight[i] * v[corner[i]];
    }
    if (length2(out->normal) <= 1e-10)
        out->normal = vec3(1, 0, 0);
    out->geometric = cross(sub(leaf->at[k + 1], leaf->at[0]), sub(leaf->at[k + 2], leaf->at[0]));
    if (out->want_uv) {
        const Vec2 *st = patch->st;
        double a = st[0].u + pv * (st[1].u - st[0].u), b = st[3].u + pv * (st[2].u - st[3].u);
        double c = st[0].v + pv * (st[1].v - st[0].v), d = st[3].v + pv * (st[2].v - st[3].v);
        out->uv = (Vec2){ a + pu * (b - a), c + pu * (d - c) };
    }
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *b = params;
    Vec3 p[16];
    for (int i = 0; i < 16; i++)
        p[i] = affine_point(place, b->point[i / 4][i % 4]);
    return bounds_of_points(p, 16);
}

const ShapeOps shape_bicubic_patch = {
    .keyword = "bicubic_patch", .params_size = sizeof(Params), .flags = SHAPE_PATCH | SHAPE_HAS_UV | SHAPE_IGNORES_CLIP | SHAPE_SMOOTH,
    .parse = parse, .compile = compile, .hits = hits, .surface = surface, .extent = extent,
};
