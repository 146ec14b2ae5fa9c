/* shaft.c - gathers the prims that rays from one point into a box may hit (after Haines and Wallace, Shaft culling for
 * efficient ray-traced radiosity, 1991). */
#include "world/shaft.h"

/* How far, relative to all distances, a box must stay on one side of a plane for rounding not to matter. */
static const double ASIDE = 0x1p-20;

typedef struct Gather {
    const World *world;
    uint32_t skip;
    Shaft *shaft;
} Gather;

static void shaft_add(Shaft *s, const World *w, uint32_t prim)
{
    uint32_t at = s->n++;
    if (w->prim[prim].flags & PRIM_OPAQUE) {
        s->prim[at] = s->prim[s->n_opaque];
        at = s->n_opaque++;
    }
    s->prim[at] = prim;
}

static bool keep(const Gather *g, uint32_t prim)
{
    Shaft *s = g->shaft;
    if (g->world->prim[prim].flags & g->skip)
        return false;
    for (uint32_t i = 0; i < s->n; i++)
        if (s->prim[i] == prim)
            return false;
    s->crowded = s->n == SHAFT_MAX;
    if (!s->crowded)
        shaft_add(s, g->world, prim);
    return s->crowded;
}

static bool keep_item(void *user, uint32_t i, double *t_max)
{
    (void)t_max;
    const Gather *g = user;
    return keep(g, g->world->accel_prim[i]);
}

/* A plane with o and the whole box on its outer side (side 1; -1: inner) is hit by no ray between them. o may lie close to it: the
 * plane's own formula then finds every root behind the origin, as the ray leads clearly away from it. */
static bool stays_on(double side, const Prim *prim, Vec3 o, Bounds to)
{
    if (prim->ops->half_space == NULL)
        return false;
    const Affine *place = prim->place;
    Vec3 n;
    double distance;
    prim->ops->half_space(prim->data, &n, &distance);
    n = scaled(n, side);
    distance *= side;
    if (!(dot(n, affine_point_back(place, o)) > distance))
        return false;
    /* n' x = n (x back), for points of the world. */
    Vec3 m = affine_normal(place, n), middle = scaled(add(to.lo, to.hi), 0.5), half = sub(to.hi, middle);
    double offset = place->identity ? 0 : dot(n, vec3(place->inv[3][0], place->inv[3][1], place->inv[3][2]));
    double least = dot(m, middle) + offset - distance - (fabs(m.x) * half.x + fabs(m.y) * half.y + fabs(m.z) * half.z);
    double size = length(m) * (max_abs(middle) + max_abs(half) + max_abs(o)) + fabs(offset) + fabs(distance);
    return least > ASIDE * size;
}

void world_shaft(const World *w, Vec3 o, Bounds to, uint32_t skip, Shaft *out)
{
    Gather g = { w, skip, out };
    out->n = out->n_opaque = 0;
    out->crowded = false;
    for (uint32_t i = 0; i < w->n_unbounded; i++)
        if (!stays_on(1, &w->prim[w->unbounded[i]], o, to) && keep(&g, w->unbounded[i]))
            return;
    if (w->n_accel_prims > 0)
        w->accel_ops->between(w->accel, o, to, keep_item, &g);
}

/* ---- narrowed to a window ---- */

/* How far a prim must stay behind the plane through a surface: beyond all rounding, within the error of surfaces. */
static const double BEHIND = 0x1p-44;

/* The rays lie on its inner side: n . x <= at. */
typedef struct Side {
    Vec3 n;
    double at, size;                           /* n . o; not less than the length of n */
    double clear;                              /* relative to all distances */
} Side;

static Side side_through(Vec3 o, Vec3 n, double clear)
{
    return (Side){ n, dot(n, o), fabs(n.x) + fabs(n.y) + fabs(n.z), clear };
}

static void window_corners(const Window *to, Vec3 o, Vec3 corner[4])
{
    Vec3 m = sub(to->middle, o), sum = add(to->half1, to->half2), difference = sub(to->half1, to->half2);
    corner[0] = sub(m, sum);
    corner[1] = add(m, difference);
    corner[2] = add(m, sum);
    corner[3] = sub(m, difference);
}

static void window_sides(const Window *to, Vec3 o, Side side[4])
{
    Vec3 c[4];
    window_corners(to, o, c);
    for (int i = 0; i < 4; i++) {
        Vec3 n = cross(c[i], c[(i + 1) % 4]);
        side[i] = side_through(o, dot(n, c[(i + 2) % 4]) > 0 ? negated(n) : n, ASIDE);
    }
}

/* The prim's box, or all of it by the reach of its shape, is on the outer side. Boxes may be unbounded, their least NaN. */
static bool stays_beside(const Prim *prim, const Bounds *box, double distance, const Side *side)
{
    Vec3 n = side->n;
    double least = n.x * (n.x > 0 ? box->lo.x : box->hi.x) + n.y * (n.y > 0 ? box->lo.y : box->hi.y) +
                   n.z * (n.z > 0 ? box->lo.z : box->hi.z);
    double size = side->size * distance;
    if (least - side->at > side->clear * size)
        return true;
    if (prim->ops->reach == NULL)
        return false;
    const Affine *place = prim->place;
    double offset = place->identity ? 0 : dot(n, vec3(place->m[3][0], place->m[3][1], place->m[3][2]));
    least = offset - prim->ops->reach(prim->data, negated(affine_normal_back(place, n)));
    return least - side->at > side->clear * (size + fabs(offset));
}

static bool stays_outside_of(const World *w, uint32_t index, Vec3 o, const Side *side, uint32_t n)
{
    const Prim *prim = &w->prim[index];
    const Bounds *box = &w->box[index];
    double distance = max_abs(box->lo) + max_abs(box->hi) + max_abs(o);
    for (uint32_t k = 0; k < n; k++)
        if (stays_beside(prim, box, distance, &side[k]))
            return true;
    return false;
}

static void drop_beside(const World *w, Vec3 o, const Side *side, uint32_t n_sides, Shaft *shaft)
{
    uint32_t n = shaft->n;
    shaft->n = shaft->n_opaque = 0;
    for (uint32_t i = 0; i < n; i++)
        if (!stays_outside_of(w, shaft->prim[i], o, side, n_sides))
            shaft_add(shaft, w, shaft->prim[i]);
}

void shaft_narrow(const World *w, Vec3 o, const Window *to, Vec3 up, Shaft *shaft)
{
    if (shaft->n == 0)
        return;
    Side side[4], below = side_through(o, negated(up), BEHIND);
    drop_beside(w, o, &below, 1, shaft);       /* the surface that the rays leave is most often what is in question */
    if (shaft->n == 0)
        return;
    window_sides(to, o, side);
    drop_beside(w, o, side, 4, shaft);
}

/* ---- fans ---- */

/* What hides all of them moves to the front: neighbouring fans ask it first. */
uint32_t shaft_hides(const World *w, Shaft *shaft, const Fan *fan, uint32_t rays, uint32_t *veiled)
{
    uint32_t hidden = 0;
    *veiled = 0;
    for (uint32_t i = 0; i < shaft->n_opaque; i++) {
        uint32_t prim = shaft->prim[i];
        hidden |= fan_meets(w, prim, fan, rays & ~hidden);
        if (hidden == rays) {
            shaft->prim[i] = shaft->prim[0];
            shaft->prim[0] = prim;
            return hidden;
        }
    }
    for (uint32_t i = shaft->n_opaque; i < shaft->n; i++)
        *veiled |= fan_meets(w, shaft->prim[i], fan, rays & ~hidden);
    return hidden;
}

/* ---- closed by one prim ---- */

/* By how much a window is widened, as a share of its distance, so that rays to the window itself are clear of all edges; and
 * by how much a hit must keep away from both ends. */
static const double WIDER = 0x1p-12, AWAY = 0x1p-10;

/* The least sine under which a window may be seen, and between its sides. */
static const double OBLIQUE = 0x1p-6;

/* False if it is too thin for widening to help. */
static bool window_widened(const Window *to, Vec3 o, Window *out)
{
    Vec3 m = sub(to->middle, o), across = cross(to->half1, to->half2);
    double d = length(m), size1 = length(to->half1), size2 = length(to->half2), area = length(across);
    if (!(area > OBLIQUE * size1 * size2) || !(fabs(dot(across, m)) > OBLIQUE * area * d) || max_abs(o) > 0x1p10 * d)
        return false;
    *out = (Window){ to->middle, scaled(to->half1, 1 + WIDER * d / size1), scaled(to->half2, 1 + WIDER * d / size2) };
    return true;
}

/* A ray from o into the box comes to its surface, unless both its ends may be within. */
static bool may_hold(Bounds box, Vec3 p, double margin)
{
    return bounds_contain(bounds_grown(box, margin), p);
}

static bool may_overlap(Bounds a, Bounds b, double margin)
{
    return a.lo.x <= b.hi.x + margin && b.lo.x <= a.hi.x + margin && a.lo.y <= b.hi.y + margin && b.lo.y <= a.hi.y + margin &&
           a.lo.z <= b.hi.z + margin && b.lo.z <= a.hi.z + margin;
}

static Fan fan_of_corners(Vec3 o, const Vec3 corner[4])
{
    double x[4], y[4], z[4];
    for (int i = 0; i < 4; i++) {
        x[i] = corner[i].x;
        y[i] = corner[i].y;
        z[i] = corner[i].z;
    }
    return (Fan){ o, AWAY, { d4_load(x), d4_load(y), d4_load(z) }, d4_set(1 - AWAY) };
}

/* What a convex body hides from o is convex, too: if it hides the corners of a window, it hides all of it. */
static bool closes(const World *w, uint32_t index, Vec3 o, const Vec3 corner[4], const Fan *to_corners)
{
    const Prim *prim = &w->prim[index];
    if (fan_meets(w, index, to_corners, FAN_ALL) != FAN_ALL)
        return false;
    Vec3 end[4] = { add(o, corner[0]), add(o, corner[1]), add(o, corner[2]), add(o, corner[3]) };
    double margin = WIDER * max_abs(corner[0]);
    return prim->ops->half_space != NULL || !may_hold(w->box[index], o, margin) ||
           !may_overlap(w->box[index], bounds_of_points(end, 4), margin);
}

uint32_t window_closed_by(const World *w, Vec3 o, const Window *to, const uint32_t *index, uint32_t n)
{
    static const uint32_t needed = PRIM_OPAQUE | PRIM_CONVEX;
    Vec3 corner[4];
    Fan to_corners;
    bool ready = false;
    for (uint32_t i = 0; i < n; i++) {
        const Prim *prim = &w->prim[index[i]];
        if ((prim->flags & needed) != needed || prim->csg != 0)
            continue;
        if (!ready) {
            Window wider;
            if (!window_widened(to, o, &wider))
                return 0;
            window_corners(&wider, o, corner);
            to_corners = fan_of_corners(o, corner);
            ready = true;
        }
        if (closes(w, index[i], o, corner, &to_corners))
            return index[i] + 1;
    }
    return 0;
}

/* ---- bodies ---- */

/* Nothing changes on the way if no surface lies in between. Bodies that are set operations of their own may be clipped: inside
 * beyond their surface. */
bool world_same_bodies(const World *w, Vec3 o, Bounds box)
{
    for (uint32_t i = 0; i < w->n_bodies; i++)
        if (w->body[i] >= w->n_prims)
            return false;
    Shaft shaft;
    world_shaft(w, o, box, 0, &shaft);
    for (uint32_t i = 0; i < shaft.n; i++)
        if (!stays_on(-1, &w->prim[shaft.prim[i]], o, box))
            return false;
    return !shaft.crowded;
}
