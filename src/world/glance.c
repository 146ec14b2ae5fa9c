/* glance.c - see glance.h. From where to where a ray is inside of each solid, and comparisons of such places; 0 is the start of
 * the ray, 1 its end.
 *
 * Steps of rays have an error of 2^-21 of their reach, which is what the parts of the sum come to without their signs; so does
 * the double arithmetic here and in the shapes, in less. Steps of less than SLOW of it are in doubt, so that places up to the end
 * of the ray are right to 2^-12. */
#include "world/glance.h"

static const double SLOW = 0x1p-8, GRAIN = 0x1p-18;
static const float APART = 0x1p-10f;           /* places closer than this may be in any order */

/* ---- what stands there ---- */

static Vec3 vec3_abs(Vec3 a)
{
    return vec3(fabs(a.x), fabs(a.y), fabs(a.z));
}

/* The sight from within a prim's space; and without signs: how far it leads, how large the numbers behind o are. */
typedef struct Local { Sight from; Vec3 reach, size; } Local;

static Vec3 apply_abs(const double m[4][3], Vec3 a)
{
    return vec3(a.x * fabs(m[0][0]) + a.y * fabs(m[1][0]) + a.z * fabs(m[2][0]),
                a.x * fabs(m[0][1]) + a.y * fabs(m[1][1]) + a.z * fabs(m[2][1]),
                a.x * fabs(m[0][2]) + a.y * fabs(m[1][2]) + a.z * fabs(m[2][2]));
}

static void sight_local(Local *out, const Affine *place, const Sight *from)
{
    out->from = *from;
    out->reach = add(vec3_abs(from->to), add(vec3_abs(from->along1), vec3_abs(from->along2)));
    out->size = vec3_abs(from->o);
    if (place->identity)
        return;
    out->from.o = affine_apply(place->inv, from->o);
    out->from.to = affine_apply_linear(place->inv, from->to);
    out->from.along1 = affine_apply_linear(place->inv, from->along1);
    out->from.along2 = affine_apply_linear(place->inv, from->along2);
    out->reach = apply_abs(place->inv, out->reach);
    out->size = add(apply_abs(place->inv, out->size), vec3_abs(vec3(place->inv[3][0], place->inv[3][1], place->inv[3][2])));
}

static inline f4 single(double x)
{
    return f4_set((float)x);
}

static Plain plain(double at, double by_s, double by_r)
{
    return (Plain){ single(at), single(by_s), single(by_r) };
}

static Plain plain_axis(const Sight *from, int axis)
{
    return plain(vec3_at(from->to, axis), vec3_at(from->along1, axis), vec3_at(from->along2, axis));
}

/* Neither does anything overflow, nor are digits lost to tiny numbers. */
static bool is_moderate(double reach)
{
    return reach > 0x1p-30 && reach < 0x1p30;
}

/* GRAIN: many times the slope below which planes are not met, and the margins of insides. */
static void slab_add(Body *b, Plain step, double o, double lo, double hi, double reach, double longest, double size)
{
    double least = SLOW * reach + GRAIN * (longest + size + fabs(hi));
    b->slab[b->n_slabs++] = (Slab){ step, single(lo - o), single(hi - o), single(is_moderate(longest) ? least : INFINITY) };
}

/* The error of a step, seen from the centre, makes one of `doubt` in the square of the distance at which the ray passes; and that
 * an error of roots which grows towards the rim. */
static void round_set(Body *b, const Local *at, const Solid *solid)
{
    Vec3 o = sub(at->from.o, solid->centre), reach = at->reach, size = add(at->size, vec3_abs(solid->centre));
    if (solid->round == 2)
        o.z = reach.z = size.z = 0;
    double r = solid->radius, away = length(o), far = length(reach);
    double doubt = r * (0x1p-16 * (away + r) + 0x1p-36 * max_abs(size));
    if (!is_moderate(far) || !(away < 0x1p10 * r))
        doubt = INFINITY;
    b->round = solid->round;
    b->ball = (Round){ { plain_axis(&at->from, 0), plain_axis(&at->from, 1), plain_axis(&at->from, 2) },
                       { single(o.x), single(o.y), single(o.z) },
                       single(r * r), single(far * far * 0x1p-4), single(doubt), single(0x1p22 * doubt * doubt) };
}

/* False: it is not as simple. */
static bool body_set(Body *b, const Prim *prim, const Sight *from)
{
    Local at;
    b->n_slabs = 0;
    b->round = 0;
    b->inverse = (prim->flags & PRIM_INVERSE) != 0;
    if (prim->ops->half_space != NULL) {
        Vec3 n;
        double distance;
        sight_local(&at, prim->place, from);
        prim->ops->half_space(prim->data, &n, &distance);
        const Sight *s = &at.from;
        slab_add(b, plain(dot(n, s->to), dot(n, s->along1), dot(n, s->along2)), dot(n, s->o), -INFINITY, distance,
                 dot(vec3_abs(n), at.reach), max_abs(at.reach), max_abs(at.size));
        return true;
    }
    Solid solid;
    if (prim->ops->solid == NULL || !prim->ops->solid(prim->data, &solid))
        return false;
    sight_local(&at, prim->place, from);
    for (int axis = 0; axis < 3; axis++) {
        double lo = vec3_at(solid.lo, axis), hi = vec3_at(solid.hi, axis);
        if (hi - lo < INFINITY)
            slab_add(b, plain_axis(&at.from, axis), vec3_at(at.from.o, axis), lo, hi, vec3_at(at.reach, axis), max_abs(at.reach),
                     vec3_at(at.size, axis));
    }
    if (solid.round != 0)
        round_set(b, &at, &solid);
    return true;
}

/* Its place among the bodies, or GLANCE_BODIES: it is none, or there is no room. */
static uint32_t body_of(Glance *g, const World *w, uint32_t prim, const Sight *from)
{
    uint32_t i = 0;
    while (i < g->n_bodies && g->body[i].prim != prim)
        i++;
    if (i == g->n_bodies && i < GLANCE_BODIES) {
        if (!body_set(&g->body[i], &w->prim[prim], from))
            return GLANCE_BODIES;
        g->body[i].prim = prim;
        g->n_bodies++;
    }
    return i;
}

static bool add_siblings(Glance *g, const World *w, uint32_t prim, const Sight *from)
{
    for (uint32_t c = w->prim[prim].csg; c != 0; c = w->csg[c].parent) {
        const CsgNode *node = &w->csg[c];
        if (node->op != CSG_ALL)
            continue;
        for (uint32_t i = node->first; i < node->first + node->n; i++) {
            if (w->csg_child[i] == prim)
                continue;
            uint32_t body = body_of(g, w, w->csg_child[i], from);
            if (body == GLANCE_BODIES || g->n_siblings == GLANCE_SIBLINGS)
                return false;
            g->sibling[g->n_siblings++] = (uint8_t)body;
        }
    }
    return true;
}

static bool sighted_add(Glance *g, const World *w, uint32_t prim, const Sight *from)
{
    uint32_t first = g->n_siblings, body;
    if (g->n == GLANCE_BODIES || (w->prim[prim].csg != 0 && !fan_climbs(w, &w->prim[prim])))
        return false;
    if ((body = body_of(g, w, prim, from)) == GLANCE_BODIES || !add_siblings(g, w, prim, from))
        return false;
    g->sighted[g->n++] = (Sighted){ body, first, g->n_siblings - first };
    return true;
}

void glance_start(Glance *g, const World *w, const Shaft *among, const Sight *from)
{
    double reach = max_abs(from->to) - max_abs(from->along1) - max_abs(from->along2);
    g->n = g->n_opaque = g->n_bodies = g->n_siblings = 0;
    g->blind = !(reach > 0x1p-14 * max_abs(from->o));
    for (uint32_t i = 0; i < among->n && !(reach <= 0x1p-14 * max_abs(from->o)); i++) {
        g->blind |= !sighted_add(g, w, among->prim[i], from);
        if (i < among->n_opaque)
            g->n_opaque = g->n;
    }
}

/* ---- what rays meet ---- */

/* Between which places is ray i inside? enter > leave: nowhere. */
typedef struct Span {
    f4 enter, leave;
    uint32_t sure;
} Span;

static inline f4 at_rays(const Plain *x, f4 s, f4 r)
{
    return f4_add(f4_add(f4_mul(x->by_s, s), f4_mul(x->by_r, r)), x->at);
}

static inline void span_cut(Span *span, f4 enter, f4 leave)
{
    span->enter = f4_max(enter, span->enter);
    span->leave = f4_min(leave, span->leave);
}

static inline void cut_by_slab(Span *span, const Slab *slab, f4 s, f4 r)
{
    f4 step = at_rays(&slab->step, s, r), inverse = f4_div(f4_set(1), step);
    f4 a = f4_mul(slab->lo, inverse), b = f4_mul(slab->hi, inverse);
    span->sure &= f4_lt(slab->least, f4_abs(step));
    span_cut(span, f4_min(a, b), f4_max(a, b));
}

static inline void cut_by_round(Span *span, const Round *ball, int n, f4 s, f4 r)
{
    f4 step[3], a = f4_set(0), b = f4_set(0), h2 = ball->radius2;
    for (int i = 0; i < n; i++) {
        step[i] = at_rays(&ball->step[i], s, r);
        a = f4_add(a, f4_mul(step[i], step[i]));
        b = f4_sub(b, f4_mul(ball->o[i], step[i]));
    }
    f4 inverse = f4_div(f4_set(1), a), middle = f4_mul(b, inverse);
    for (int i = 0; i < n; i++) {
        f4 x = f4_add(ball->o[i], f4_mul(step[i], middle));
        h2 = f4_sub(h2, f4_mul(x, x));
    }
    f4 size = f4_abs(h2), half = f4_signed(f4_sqrt(f4_mul(size, inverse)), h2);        /* passes: enters after it leaves */
    span->sure &= f4_lt(ball->least2, a) & f4_lt(ball->doubt, size) & f4_lt(ball->doubt_roots, f4_mul(size, a));
    span_cut(span, f4_sub(middle, half), f4_add(middle, half));
}

static inline Span span_of(const Body *b, f4 s, f4 r)
{
    Span span = { f4_set(-INFINITY), f4_set(INFINITY), FAN_ALL };
    for (uint32_t i = 0; i < b->n_slabs; i++)
        cut_by_slab(&span, &b->slab[i], s, r);
    if (b->round == 3)
        cut_by_round(&span, &b->ball, 3, s, r);
    else if (b->round == 2)
        cut_by_round(&span, &b->ball, 2, s, r);
    return span;
}

typedef struct Looking {                       /* four rays */
    const Glance *g;
    f4 s, r;
    uint32_t known;                            /* bit per body: span is */
    Span span[GLANCE_BODIES];
} Looking;

static inline const Span *look_at(Looking *l, uint32_t body)
{
    if (!(l->known >> body & 1)) {
        l->span[body] = span_of(&l->g->body[body], l->s, l->r);
        l->known |= 1u << body;
    }
    return &l->span[body];
}

static inline uint32_t surely_before(f4 a, f4 b)
{
    return f4_lt(f4_add(a, f4_set(APART)), b);
}

typedef struct Meets { uint32_t surely, maybe; } Meets;

/* Does the root at t count, of rays that meet the solid? */
static inline Meets root_counts(Looking *l, const Sighted *prim, f4 t, Meets meets)
{
    f4 start = f4_set(0), end = f4_set(1), later = f4_add(t, f4_set(APART)), earlier = f4_sub(t, f4_set(APART));
    meets.surely &= f4_lt(start, earlier) & f4_lt(later, end);
    meets.maybe &= ~(f4_lt(later, start) | f4_lt(end, earlier));
    for (uint32_t i = 0; i < prim->n && meets.maybe != 0; i++) {
        uint32_t body = l->g->sibling[prim->first + i];
        const Span *span = look_at(l, body);
        uint32_t in = span->sure & f4_lt(span->enter, earlier) & f4_lt(later, span->leave);
        uint32_t out = span->sure & (f4_lt(later, span->enter) | f4_lt(span->leave, earlier));
        bool inverse = l->g->body[body].inverse;
        meets.surely &= inverse ? out : in;
        meets.maybe &= ~(inverse ? in : out);
    }
    return meets;
}

static inline Meets prim_is_met(Looking *l, const Sighted *prim)
{
    const Span *span = look_at(l, prim->body);
    f4 enter = span->enter, leave = span->leave, start = f4_max(enter, f4_set(0)), end = f4_min(leave, f4_set(1));
    uint32_t unsure = FAN_ALL & ~span->sure;
    Meets within = { span->sure & surely_before(start, end), span->sure & ~surely_before(end, start) };
    if (prim->n == 0) {
        within.surely &= surely_before(f4_set(0), enter) | surely_before(leave, f4_set(1));
        within.maybe &= ~(surely_before(enter, f4_set(0)) & surely_before(f4_set(1), leave));
        within.maybe |= unsure;
        return within;
    }
    if (within.maybe == 0)
        return (Meets){ 0, unsure };
    Meets in = root_counts(l, prim, enter, within), out = root_counts(l, prim, leave, within);
    return (Meets){ in.surely | out.surely, in.maybe | out.maybe | unsure };
}

/* What hides all of them moves to the front: neighbours ask it first. */
uint32_t glance_hides(Glance *g, f4 s, f4 r, uint32_t rays, uint32_t *clear)
{
    Looking l;                                 /* not cleared: spans are many */
    l.g = g;
    l.s = s;
    l.r = r;
    l.known = 0;
    uint32_t hidden = 0, open = g->blind ? rays : 0;
    for (uint32_t i = 0; i < g->n; i++) {
        Meets meets = prim_is_met(&l, &g->sighted[i]);
        open |= meets.maybe;
        if (i < g->n_opaque)
            hidden |= meets.surely & rays;
        if (hidden == rays) {
            Sighted front = g->sighted[i];
            g->sighted[i] = g->sighted[0];
            g->sighted[0] = front;
            break;
        }
    }
    *clear = rays & ~hidden & ~open;
    return hidden;
}
