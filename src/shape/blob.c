/* blob.c - blob { threshold T, sphere | cylinder | component, ... }: where the sum of the components' fields is T.
 *
 * A component of strength s gives s (1 - rho^2)^2, rho being the distance in its radii, and nothing beyond 1. A cylinder
 * is three elements: its body and two half balls. Along a ray each element begins and ends once and is a quartic in between,
 * so from event to event the sum is a quartic, written in Bernstein form: most stretches are done by a look at the
 * signs. Elements stand in a tree when they are many (08-shapes, section 13). */
#include "base/array.h"
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct {
    bool cylinder;
    Vec3 a, b;                                 /* centre; second end */
    double radius, strength;
    Affine place;                              /* the component's own transforms */
    const Texture *texture;                    /* NULL: the blob's */
} Component;

typedef ARRAY(Component) Components;

typedef struct { double threshold; Components component; } Params;

typedef enum { BALL, LOW_HALF, HIGH_HALF, BODY } ElementKind;      /* halves: z <= 0, z >= 0; body: 0 <= z <= length */

typedef struct {
    ElementKind kind;
    uint32_t component;
    double strength, length;
    Vec3 centre;                               /* plain balls: (p - centre) * shrink is in units of the radius */
    double shrink, radius;                     /* 0: by the matrix */
    double to_unit[4][3];
} Element;

typedef struct {
    double threshold;
    uint32_t n, n_textures;
    const uint32_t *texture;                   /* of components; NULL: all have the blob's own */
    Bounds box;                                /* holds all that can be seen */
    Vec3 middle, half;                         /* of the box; half its size, and a little more than any rounding */
    const AccelOps *accel_ops;
    const void *accel;
    Element element[];
} Blob;

enum { FEW = 8, MANY = 64, STRETCHES = 3, MOST_ACTIVE = 2048 };

/* POV: inside reaches this far below the threshold. */
static const double INSIDE_SLACK = 1e-6;

/* Far more than products and sums of coordinates are off by, relative to them. */
static const double ROUNDING = 0x1p-44;

/* ---- parsing ---- */

/* After `component`: strength, radius, centre, without braces. */
static Component old_component(Parser *p)
{
    Component c = { .place = affine_identity() };
    c.strength = parse_float(p);
    c.radius = parse_next_float(p);
    c.a = parse_next_vec3(p);
    return c;
}

static Component new_component(Parser *p, bool cylinder)
{
    Component c = { .cylinder = cylinder, .strength = 1 };
    parse_open(p);
    c.a = parse_vec3(p);
    if (cylinder)
        c.b = parse_next_vec3(p);
    c.radius = parse_next_float(p);
    parse_comma(p);
    parse_accept(p, KW_STRENGTH);
    c.strength = parse_float(p);
    parse_stray_comma(p);
    c.place = affine_identity();
    while (parse_part_item(p, &c.texture, &c.place))
        ;
    parse_close(p);
    if (cylinder && max_abs(sub(c.a, c.b)) == 0)
        parse_fail(p, "Degenerate cylindrical component in blob.");
    return c;
}

static bool item(Parser *p, void *params)
{
    Params *b = params;
    if (parse_accept(p, KW_THRESHOLD))
        b->threshold = parse_float(p);
    else if (parse_accept(p, KW_COMPONENT))
        array_push(parse_arena(p), &b->component, old_component(p));
    else if (parse_accept(p, KW_SPHERE))
        array_push(parse_arena(p), &b->component, new_component(p, false));
    else if (parse_accept(p, KW_CYLINDER))
        array_push(parse_arena(p), &b->component, new_component(p, true));
    else
        return false;
    parse_stray_comma(p);
    return true;
}

static void parse(Parser *p, void *params)
{
    ((Params *)params)->threshold = 1;
    while (item(p, params))
        ;
}

static void finish(Parser *p, void *params)
{
    const Params *b = params;
    if (b->component.n == 0)
        parse_fail(p, "Missing components in blob.");
    if (!(b->threshold > 0))
        parse_warn(p, "a blob with a threshold of %g cannot be seen", b->threshold);
}

/* ---- compiling ---- */

/* z from 0 to the length, in units of the radius, along the cylinder. */
static Affine frame(const Component *c, double *along)
{
    Vec3 axis = sub(c->b, c->a);
    double unit = build_unit(max_abs(axis));
    axis = scaled(axis, 1 / unit);
    *along = length(axis) * unit / fabs(c->radius);
    return affine_then(affine_frame(c->a, axis, fabs(c->radius), fabs(c->radius)), c->place);
}

static void plain_ball(Element *e, const Component *c, double unit)
{
    e->centre = scaled(c->a, 1 / unit);
    e->shrink = unit / fabs(c->radius);
    e->radius = fabs(c->radius) / unit;
}

static void matrix_of(Element *e, const Affine *place, double unit, double from_z)
{
    Affine all = affine_then(affine_then(affine_translate(vec3(0, 0, from_z)), *place), affine_scale(vec3(1 / unit, 1 / unit, 1 / unit)));
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            e->to_unit[i][j] = all.inv[i][j];
}

/* Bounds in units of `unit` come with the elements. */
static uint32_t elements_of(const Component *c, uint32_t index, double unit, Element *e, Bounds *box)
{
    double k = 1 / unit;
    Affine shrink = affine_scale(vec3(k, k, k));
    if (!c->cylinder) {
        *e = (Element){ .kind = BALL, .component = index, .strength = c->strength };
        double r = fabs(c->radius);
        Affine place = affine_then(affine_then(affine_scale(vec3(r, r, r)), affine_translate(c->a)), c->place);
        if (!c->place.identity)
            matrix_of(e, &place, unit, 0);
        else
            plain_ball(e, c, unit);
        place = affine_then(place, shrink);
        *box = shape_padded(bounds_transformed((Bounds){ vec3(-1, -1, -1), vec3(1, 1, 1) }, &place));
        return 1;
    }
    static const ElementKind kinds[3] = { BODY, LOW_HALF, HIGH_HALF };
    double along;
    Affine place = frame(c, &along), all = affine_then(place, shrink);
    const double z0[3] = { 0, -1, along }, z1[3] = { along, 0, along + 1 };
    for (int i = 0; i < 3; i++) {
        e[i] = (Element){ .kind = kinds[i], .component = index, .strength = c->strength, .length = along };
        matrix_of(&e[i], &place, unit, i == 2 ? along : 0);
        box[i] = shape_padded(bounds_transformed((Bounds){ vec3(-1, -1, z0[i]), vec3(1, 1, z1[i]) }, &all));
    }
    return 3;
}

static void textures(ShapeBuild *b, const Params *from, Blob *out)
{
    bool any = false;
    for (uint32_t i = 0; i < from->component.n; i++)
        any |= from->component.data[i].texture != NULL;
    if (!any)
        return;
    uint32_t *texture = build_data(b, from->component.n * sizeof *texture);
    for (uint32_t i = 0; i < from->component.n; i++)
        texture[i] = build_texture(b, from->component.data[i].texture, NULL);
    out->texture = texture;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *from = params;
    uint32_t n = from->component.n, most = 0;
    double size = 0;
    for (uint32_t i = 0; i < n; i++) {
        const Component *c = &from->component.data[i];
        most += c->cylinder ? 3 : 1;
        size = fmax(size, max_abs(affine_point(&c->place, c->a)) + fabs(c->radius));
    }
    double unit = shape_unit(b, size);
    Blob *out = build_data(b, sizeof *out + most * sizeof(Element));
    Bounds *box = arena_array(b->arena, Bounds, most), all = bounds_empty();
    for (uint32_t i = 0; i < n; i++) {
        const Component *c = &from->component.data[i];
        if (c->strength == 0 || c->radius == 0)
            continue;
        uint32_t made = elements_of(c, i, unit, &out->element[out->n], &box[out->n]);
        for (uint32_t k = out->n; k < out->n + made && c->strength > 0; k++)
            all = bounds_union(all, box[k]);
        out->n += made;
    }
    if (!(from->threshold > 0) || bounds_is_empty(all))
        return;
    out->threshold = from->threshold;
    out->middle = lerp(all.lo, all.hi, 0.5);
    double room = ROUNDING * (max_abs(all.lo) + max_abs(all.hi));
    out->half = add(sub(all.hi, out->middle), vec3(room, room, room));
    out->box = all;
    out->accel_ops = b->accel;
    out->accel = out->n > FEW ? b->accel->build(b->arena, box, out->n) : NULL;
    textures(b, from, out);
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, all);
}

/* ---- along a ray ---- */

typedef struct {
    double s0, s1;                             /* where it begins and ends */
    double middle, a, least;                   /* rho^2 = least + a (s - middle)^2 */
    double strength;
    uint32_t element;
} Active;

typedef struct { double s; uint32_t active; bool begins; } Event;

typedef struct {
    const Blob *blob;
    Vec3 o, u;                                 /* from the point nearest to the middle; unit length */
    double from, to;                           /* the stretch that is done */
    double limit;                              /* nothing beyond can win */
    uint32_t n;
    bool full;
    double shift, len;
    HitSink *sink;
    Active active[MOST_ACTIVE];
    Event event[2 * MOST_ACTIVE];
    uint32_t live[MOST_ACTIVE];
} Line;

static Vec3 to_unit(const Element *e, Vec3 p)
{
    return e->shrink != 0 ? scaled(sub(p, e->centre), e->shrink) : affine_apply(e->to_unit, p);
}

static void cut(double z, double dz, double lo, double hi, double *s0, double *s1)
{
    if (dz == 0) {
        if (z < lo || z > hi)
            *s1 = -INFINITY;
        return;
    }
    double a = (lo - z) / dz, b = (hi - z) / dz;
    *s0 = fmax(*s0, fmin(a, b));
    *s1 = fmin(*s1, fmax(a, b));
}

/* A plain ball: u is of unit length, so little is left to divide. */
static bool cross_ball(const Line *l, const Element *e, Active *x)
{
    Vec3 v = sub(e->centre, l->o);
    double shrink2 = e->shrink * e->shrink;
    x->middle = dot(v, l->u);
    x->least = length2(sub(v, scaled(l->u, x->middle))) * shrink2;
    if (!(x->least < 1))
        return false;
    double half = sqrt(1 - x->least) * e->radius;
    x->a = shrink2;
    x->s0 = x->middle - half;
    x->s1 = x->middle + half;
    return true;
}

static bool cross_mapped(const Line *l, const Element *e, Active *x)
{
    Vec3 o = affine_apply(e->to_unit, l->o), u = affine_apply_linear(e->to_unit, l->u);
    double z = o.z, dz = u.z;
    if (e->kind == BODY)
        o.z = u.z = 0;
    x->s0 = -INFINITY;
    x->s1 = INFINITY;
    x->middle = 0;
    x->a = length2(u);
    if (x->a > 0) {
        x->middle = -dot(o, u) / x->a;
        x->least = length2(add(o, scaled(u, x->middle)));
        if (!(x->least < 1))
            return false;
        double half = sqrt((1 - x->least) / x->a);
        x->s0 = x->middle - half;
        x->s1 = x->middle + half;
    } else if (!((x->least = length2(o)) < 1))
        return false;
    if (e->kind == BODY)
        cut(z, dz, 0, e->length, &x->s0, &x->s1);
    else if (e->kind == LOW_HALF)
        cut(z, dz, -2, 0, &x->s0, &x->s1);
    else if (e->kind == HIGH_HALF)
        cut(z, dz, 0, 2, &x->s0, &x->s1);
    return x->s0 < x->s1;
}

static bool visit(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    Line *l = user;
    const Element *e = &l->blob->element[item];
    if (l->n == MOST_ACTIVE) {
        l->full = true;
        return true;
    }
    Active *x = &l->active[l->n];
    if (!(e->shrink != 0 ? cross_ball(l, e, x) : cross_mapped(l, e, x)) || x->s1 < l->from || x->s0 > l->to)
        return false;
    x->strength = e->strength;
    x->element = item;
    l->n++;
    return false;
}

static bool event_before(const Line *l, const Event *a, const Event *b)
{
    return a->s < b->s || (a->s == b->s && l->active[a->active].element < l->active[b->active].element);
}

static void insert_events(Line *l, uint32_t gap)
{
    for (uint32_t i = gap, n = 2 * l->n; i < n; i++) {
        Event e = l->event[i];
        uint32_t k = i;
        for (; k >= gap && event_before(l, &e, &l->event[k - gap]); k -= gap)
            l->event[k] = l->event[k - gap];
        l->event[k] = e;
    }
}

/* Shell sort: lists are short, hardly ever long. */
static void sort_events(Line *l)
{
    static const uint32_t gaps[] = { 1750, 701, 301, 132, 57, 23, 10 };
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        if (gaps[g] < l->n)
            insert_events(l, gaps[g]);
    insert_events(l, 1);
}

/* The live ones stand in order of their elements, so that sums do not depend on how they were found. */
static void live_add(Line *l, uint32_t *n, uint32_t active)
{
    uint32_t k = (*n)++;
    for (; k > 0 && l->active[l->live[k - 1]].element > l->active[active].element; k--)
        l->live[k] = l->live[k - 1];
    l->live[k] = active;
}

static void live_remove(Line *l, uint32_t *n, uint32_t active)
{
    uint32_t k = 0;
    while (l->live[k] != active)
        k++;
    for ((*n)--; k < *n; k++)
        l->live[k] = l->live[k + 1];
}

/* Field minus threshold over [x, y] in Bernstein form; false if it cannot reach the threshold. */
static bool quartic_over(const Line *l, uint32_t n, double x, double y, double f[5])
{
    double most = 0;
    for (uint32_t i = 0; i < n; i++)
        most += greater(l->active[l->live[i]].strength, 0);
    if (most < l->blob->threshold)
        return false;
    for (int k = 0; k < 5; k++)
        f[k] = -l->blob->threshold;
    for (uint32_t i = 0; i < n; i++) {
        const Active *a = &l->active[l->live[i]];
        double dx = x - a->middle, dy = y - a->middle;
        double g0 = greater(0, 1 - (a->least + a->a * dx * dx)), g2 = greater(0, 1 - (a->least + a->a * dy * dy));
        double g1 = 1 - (a->least + a->a * dx * dy);
        f[0] += a->strength * g0 * g0;
        f[1] += a->strength * g0 * g1;
        f[2] += a->strength * (g0 * g2 + 2 * g1 * g1) / 3;
        f[3] += a->strength * g1 * g2;
        f[4] += a->strength * g2 * g2;
    }
    return true;
}

static void march(Line *l)
{
    for (uint32_t i = 0; i < l->n; i++) {
        l->event[2 * i] = (Event){ l->active[i].s0, i, true };
        l->event[2 * i + 1] = (Event){ l->active[i].s1, i, false };
    }
    sort_events(l);
    uint32_t n = 0;
    double f[5], root[4];
    for (uint32_t i = 0; i + 1 < 2 * l->n; i++) {
        const Event *e = &l->event[i];
        if (e->begins)
            live_add(l, &n, e->active);
        else
            live_remove(l, &n, e->active);
        double x = greater(e->s, l->from), y = lesser(l->event[i + 1].s, l->to);
        if (x > l->limit || x > l->to)
            return;
        if (!(x < y) || !quartic_over(l, n, x, y, f))
            continue;
        int found = bernstein_roots(f, 4, root);
        for (int k = 0; k < found; k++)
            hit_add(l->sink, l->shift + (x + (y - x) * root[k]) / l->len, 0);
        if (found > 0)
            l->limit = (hit_limit(l->sink) - l->shift) * l->len;
    }
}

static void collect(Line *l)
{
    const Blob *b = l->blob;
    l->n = 0;
    l->full = false;
    if (b->accel != NULL) {
        Ray part = { add(l->o, scaled(l->u, l->from)), l->u, 0, l->to - l->from };
        double t_max = part.t_max;
        b->accel_ops->walk(b->accel, &part, &t_max, visit, l);
    } else
        for (uint32_t i = 0; i < b->n && !l->full; i++)
            visit(l, i, NULL);
}

static bool beside(double across, double away, double h)
{
    return fabs(across - away) > h + ROUNDING * (fabs(across) + fabs(away));
}

/* Seen along an axis, the line leaves the box on one side; m: its origin, from the middle of the box. Half of the lines that come
 * here do, and are spared a root and seven quotients. */
static bool passes_by(Vec3 half, Vec3 m, Vec3 d)
{
    double x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    return beside(d.x * m.y, d.y * m.x, half.x * y + half.y * x) || beside(d.y * m.z, d.z * m.y, half.y * z + half.z * y) ||
           beside(d.z * m.x, d.x * m.z, half.z * x + half.x * z);
}

/* The part of the line within the box. */
static bool enter(const Bounds *box, const Line *l, double *in, double *out)
{
    *in = -INFINITY;
    *out = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_at(l->o, axis), u = vec3_at(l->u, axis), lo = vec3_at(box->lo, axis), hi = vec3_at(box->hi, axis);
        if (u == 0) {
            if (o < lo || o > hi)
                return false;
            continue;
        }
        double a = (lo - o) / u, b = (hi - o) / u;
        *in = greater(*in, lesser(a, b));
        *out = lesser(*out, greater(a, b));
    }
    return *in <= *out;
}

/* A blob of many components is done in stretches, to be spared those behind what the ray hits. The stretches depend on where
 * the ray begins, not on where it ends: that must not change a sum. One with too many components is halved. */
static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Blob *b = shape;
    Vec3 from_middle = sub(ray->o, b->middle);
    if (passes_by(b->half, from_middle, ray->d))
        return;
    Line l;
    double end;
    l.blob = b;
    l.sink = sink;
    l.len = length(ray->d);
    l.u = scaled(ray->d, 1 / l.len);
    l.shift = -dot(from_middle, l.u) / l.len;
    l.o = ray_at(ray, l.shift);
    l.limit = (hit_limit(sink) - l.shift) * l.len;
    if (!enter(&b->box, &l, &l.from, &end))
        return;
    l.from = greater((ray->t_min - l.shift) * l.len, l.from);
    double stretch = b->n > MANY ? (end - l.from) / STRETCHES : end - l.from, least = stretch * 0x1p-30;
    l.to = b->n > MANY ? l.from + stretch : end;
    while (l.from < end && l.from <= l.limit) {
        collect(&l);
        if (l.full && l.to - l.from > least) {
            l.to = l.from + 0.5 * (l.to - l.from);
            continue;
        }
        march(&l);
        l.from = l.to;
        l.to = l.to + stretch < end - 0.5 * stretch ? l.to + stretch : end;
    }
}

/* ---- at a point ---- */

typedef struct {
    const Blob *blob;
    Vec3 p, normal;
    double field;
    Surface *out;                              /* for textures; NULL: field alone */
} Point;

static bool reaches(const Element *e, Vec3 q)
{
    return e->kind == BALL || (e->kind == LOW_HALF && q.z < 0) || (e->kind == HIGH_HALF && q.z > 0) ||
           (e->kind == BODY && q.z >= 0 && q.z <= e->length);
}

static void weigh_texture(Surface *s, uint32_t texture, double weight)
{
    uint32_t i = 0;
    while (i < s->n_textures && s->texture[i].texture != texture)
        i++;
    if (i == SURFACE_MAX_TEXTURES)
        return;
    if (i == s->n_textures) {
        s->texture[i].texture = texture;
        s->texture[i].weight = 0;
        s->n_textures++;
    }
    s->texture[i].weight += (float)weight;
}

static bool feel(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    Point *at = user;
    const Element *e = &at->blob->element[item];
    Vec3 q = to_unit(e, at->p);
    if (!reaches(e, q))
        return false;
    if (e->kind == BODY)
        q.z = 0;
    double g = 1 - length2(q);
    if (!(g >= 0))
        return false;
    at->field += e->strength * g * g;
    Vec3 n = e->shrink != 0 ? scaled(q, e->shrink) : affine_apply_transposed(e->to_unit, q);
    at->normal = add(at->normal, scaled(n, e->strength * g));
    if (at->out != NULL && g > 0)
        weigh_texture(at->out, at->blob->texture[e->component], fabs(e->strength) * g * g);
    return false;
}

/* Sums in the order of the elements, whatever the accelerator: found first, then added up. */
typedef struct { uint32_t n, item[MOST_ACTIVE]; } Found;

static bool note(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    Found *f = user;
    uint32_t k = f->n;
    for (; k > 0 && f->item[k - 1] >= item; k--)
        if (f->item[k - 1] == item)
            return false;
    if (f->n == MOST_ACTIVE)
        return true;
    for (k = f->n++; k > 0 && f->item[k - 1] > item; k--)
        f->item[k] = f->item[k - 1];
    f->item[k] = item;
    return false;
}

static void feel_all(Point *at)
{
    const Blob *b = at->blob;
    if (b->accel == NULL) {
        for (uint32_t i = 0; i < b->n; i++)
            feel(at, i, NULL);
        return;
    }
    Found found;
    found.n = 0;
    b->accel_ops->around(b->accel, at->p, note, &found);
    for (uint32_t i = 0; i < found.n; i++)
        feel(at, found.item[i], NULL);
}

static double field_of(const Element *e, Vec3 p)
{
    Vec3 q = to_unit(e, p);
    if (!reaches(e, q))
        return 0;
    if (e->kind == BODY)
        q.z = 0;
    double g = 1 - length2(q);
    return g > 0 ? e->strength * g * g : 0;
}

static bool inside(const void *shape, Vec3 p)
{
    const Blob *b = shape;
    double field = 0;
    if (!bounds_contain(b->box, p))            /* of the strengths above 0: outside of it the field is not */
        return false;
    if (b->accel == NULL) {
        for (uint32_t i = 0; i < b->n; i++)
            field += field_of(&b->element[i], p);
    } else {
        Found found;
        found.n = 0;
        b->accel_ops->around(b->accel, p, note, &found);
        for (uint32_t i = 0; i < found.n; i++)
            field += field_of(&b->element[found.item[i]], p);
    }
    return field > b->threshold - INSIDE_SLACK;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Blob *b = shape;
    Point at = { .blob = b, .p = out->p, .out = b->texture != NULL ? out : NULL };
    out->n_textures = 0;
    feel_all(&at);
    out->normal = max_abs(at.normal) > 0 ? at.normal : vec3(1, 0, 0);
    double sum = 0;
    for (uint32_t i = 0; i < out->n_textures; i++)
        sum += out->texture[i].weight;
    for (uint32_t i = 0; i < out->n_textures; i++)
        out->texture[i].weight = (float)(out->texture[i].weight / sum);
}

/* POV: a box around each ball, as long each way as the longest edge of the box [0, r]^3 in the component's frame. */
static Bounds ball_extent(Vec3 centre, double r, const Affine *place)
{
    Vec3 x = affine_vector(place, vec3(1, 0, 0)), y = affine_vector(place, vec3(0, 1, 0)), z = affine_vector(place, vec3(0, 0, 1));
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = fmax(most, fabs(vec3_at(x, axis)) + fabs(vec3_at(y, axis)) + fabs(vec3_at(z, axis)));
    return bounds_grown((Bounds){ centre, centre }, r * most);
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *from = params;
    Bounds b = bounds_empty();
    for (uint32_t i = 0; i < from->component.n; i++) {
        const Component *c = &from->component.data[i];
        if (!(c->strength > 0))
            continue;
        double r = fabs(c->radius);
        Vec3 first = affine_point(&c->place, c->a), last = affine_point(&c->place, c->b);
        if (!c->cylinder) {
            b = bounds_union(b, ball_extent(first, r, &c->place));
            continue;
        }
        Vec3 axis = sub(c->b, c->a);
        double half = 0.5 * length(axis);
        Affine turned = affine_then(affine_frame(c->a, axis, 1, 1), c->place);
        b = bounds_union(b, ball_extent(first, r, &turned));
        b = bounds_union(b, ball_extent(last, r, &turned));
        b = bounds_union(b, ball_extent(lerp(first, last, 0.5), sqrt(half * half + r * r), &turned));
    }
    return bounds_transformed(b, place);
}

const ShapeOps shape_blob = {
    .keyword = "blob", .params_size = sizeof(Params), .flags = SHAPE_HAS_STURM | SHAPE_HAS_HIERARCHY | SHAPE_SHARED | SHAPE_HAS_TEXTURES, .parse = parse,
    .item = item, .finish = finish, .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
