/* tiling.c - tilings of the xz plane by regular polygons and the like; numbers 25 to 27 are Penrose's.
 *
 * A tiling is a list of convex tiles that a lattice of translations repeats (06-noise-and-patterns, section 7). The value falls
 * from the edges of a tile to its middle, within the band of the tile's class. The list is built when the scene is read, with
 * every copy that reaches the lattice's parallelogram at the origin, so that a point is looked up in one short list. */
#include "pattern/penrose.h"
#include "sdl/parse.h"

enum { MAX_EDGES = 12, MAX_TILES = 24, MAX_COPIES = 160, REACH = 3 };

typedef struct Tile {
    int n;
    Vec2 corner[MAX_EDGES];                    /* counterclockwise seen with x right and z up */
    double rate[MAX_EDGES];                    /* 1/D of each edge */
    double class, extra, least;                /* value = max((class + 1 - ...)/classes + extra, least) */
} Tile;

typedef struct Edge { double a, b, c, rate; } Edge;            /* a x + b z + c: distance inward */
typedef struct Copy { int n; const Edge *edge; double top, least; } Copy;

typedef struct {
    int number;
    double classes, scale;                     /* scale: of the plane (13, 14) */
    Vec2 along, across;                        /* the lattice */
    double inverse[4];
    Vec2 lo, hi;                               /* box of the parallelogram */
    int n_tiles, n_copies;
    Copy *copy;
} Tiling;

typedef struct Builder { Tiling *t; Arena *arena; double rate; Tile tile[MAX_TILES]; } Builder;

static const double S = 1.73205080756887729353, Q = 1.41421356237309504880;

static Tile *add_tile(Builder *b, double class, int n, const Vec2 *corner)
{
    Tile *tile = &b->tile[b->t->n_tiles++];
    *tile = (Tile){ .n = n, .class = class };
    double area = 0;
    for (int i = 0; i < n; i++) {
        Vec2 p = corner[i], q = corner[(i + 1) % n];
        area += p.u * q.v - q.u * p.v;
    }
    for (int i = 0; i < n; i++) {
        tile->corner[i] = corner[area > 0 ? i : n - 1 - i];
        tile->rate[i] = b->rate;
    }
    return tile;
}

static void lattice(Builder *b, double classes, double distance, Vec2 along, Vec2 across)
{
    b->t->classes = classes;
    b->rate = 1 / distance;
    b->t->along = along;
    b->t->across = across;
}

static Tile *triangle(Builder *b, double class, double x0, double z0, double x1, double z1, double x2, double z2)
{
    return add_tile(b, class, 3, (Vec2[]){ { x0, z0 }, { x1, z1 }, { x2, z2 } });
}

static Tile *quad(Builder *b, double class, Vec2 p, Vec2 q, Vec2 r, Vec2 s)
{
    return add_tile(b, class, 4, (Vec2[]){ p, q, r, s });
}

static Tile *rect(Builder *b, double class, double x0, double z0, double x1, double z1)
{
    return quad(b, class, (Vec2){ x0, z0 }, (Vec2){ x1, z0 }, (Vec2){ x1, z1 }, (Vec2){ x0, z1 });
}

/* Edges of length 1, the first corner in this direction (degrees). */
static Tile *regular(Builder *b, double class, int n, double x, double z, double first)
{
    Vec2 corner[MAX_EDGES];
    double radius = 0.5 / sin(PI / n);
    for (int i = 0; i < n; i++) {
        double a = first * PI / 180 + 2 * PI * i / n;
        corner[i] = (Vec2){ x + radius * cos(a), z + radius * sin(a) };
    }
    return add_tile(b, class, n, corner);
}

/* A unit square on the edge of a polygon with centre (x, z), this far away, in this direction. */
static Tile *square_at(Builder *b, double class, double x, double z, double apothem, double direction)
{
    double a = direction * PI / 180, far = apothem + 0.5;
    return regular(b, class, 4, x + far * cos(a), z + far * sin(a), direction + 45);
}

/* A unit triangle with one corner at (x, z), reaching out in this direction. */
static Tile *triangle_at(Builder *b, double class, double x, double z, double direction)
{
    double a = (direction - 30) * PI / 180, c = (direction + 30) * PI / 180;
    return triangle(b, class, x, z, x + cos(a), z + sin(a), x + cos(c), z + sin(c));
}

static void trapezoids(Builder *b, double right, double left, double lower, double upper)
{
    quad(b, right, (Vec2){ 3, 1 }, (Vec2){ 4, 0 }, (Vec2){ 4, 4 }, (Vec2){ 3, 3 });
    quad(b, left, (Vec2){ 1, 1 }, (Vec2){ 0, 0 }, (Vec2){ 0, 4 }, (Vec2){ 1, 3 });
    quad(b, lower, (Vec2){ 1, 1 }, (Vec2){ 0, 0 }, (Vec2){ 4, 0 }, (Vec2){ 3, 1 });
    quad(b, upper, (Vec2){ 1, 3 }, (Vec2){ 0, 4 }, (Vec2){ 4, 4 }, (Vec2){ 3, 3 });
    b->t->scale = Q;
}

static void hexagon_squares_triangles(Builder *b, const double class[6], double classes, double apart)
{
    double h = 0.5 + S / 2;
    lattice(b, classes, S / 6, (Vec2){ (3 + S) / 2, (1 + S) / 2 }, (Vec2){ 0, 1 + S });
    regular(b, class[0], 6, h, h, 0)->least = (classes - 1 + (classes == 3 ? 1e-7 : 1e-6)) / classes;
    square_at(b, class[1], h, h, S / 2, 90);
    square_at(b, class[2], h, h, S / 2, 30)->extra = apart / classes;
    square_at(b, class[3], h, h, S / 2, 150)->extra = apart / classes;
    triangle_at(b, class[4], h + 1, h, 0);
    triangle_at(b, class[5], h - 1, h, 180);
}

/* What of the grid of unit triangles a sparse lattice of hexagons leaves (19, 20). */
static void hexagons_in_triangles(Builder *b, double sign)
{
    Vec2 u = { 2.5, sign * S / 2 }, v = { 7, 0 };
    lattice(b, 3, S / 6, u, v);
    regular(b, 2, 6, 1, S, 0)->least = 2.000001 / 3;
    double det = u.u * v.v - u.v * v.u;
    for (int j = -8; j <= 8; j++)
        for (int i = -16; i <= 16; i++)
            for (int up = 0; up <= 1; up++) {
                double x = i + j * 0.5, z = j * S / 2;
                double cx = x + (up ? 0.5 : 1), cz = z + (up ? S / 6 : S / 3);
                double s = (cx * v.v - cz * v.u) / det, t = (u.u * cz - u.v * cx) / det;
                if (s < 0 || s >= 1 || t < 0 || t >= 1)
                    continue;
                bool covered = false;          /* by a hexagon of the lattice about */
                for (int m = -4; m <= 4; m++)
                    for (int n = -4; n <= 4; n++) {
                        double dx = cx - (1 + m * u.u + n * v.u), dz = cz - (S + m * u.v + n * v.v);
                        covered = covered || dx * dx + dz * dz < 0.5;
                    }
                if (!covered && up)
                    triangle(b, 0, x, z, x + 1, z, x + 0.5, z + S / 2);
                else if (!covered)
                    triangle(b, 1, x + 0.5, z + S / 2, x + 1.5, z + S / 2, x + 1, z);
            }
}

static void dodecagon_hexagons_squares(Builder *b, const double class[5], double classes)
{
    double x = 1.5 + S / 2, z = 1 + S, apothem = 1 + S / 2;
    lattice(b, classes, 0.5, (Vec2){ (3 + S) / 2, 1.5 * S + 1.5 }, (Vec2){ 3 + S, 0 });
    regular(b, class[0], 12, x, z, 15)->extra = 1e-6 / classes;
    regular(b, class[1], 6, x, z + apothem + S / 2, 0);
    regular(b, class[1], 6, x, z - apothem - S / 2, 0);
    square_at(b, class[2], x, z, apothem, 180);
    square_at(b, class[3], x, z, apothem, 240);
    square_at(b, class[4], x, z, apothem, 120);
}

static void dodecagon_triangles(Builder *b)
{
    double k = 1 + S / 2;
    lattice(b, 3, S / 6, (Vec2){ k, S + 1.5 }, (Vec2){ 2 + S, 0 });
    Tile *d = regular(b, 2, 12, k, k, 15);
    d->extra = 1e-7 / 3;
    for (int i = 0; i < 12; i++) {             /* POV: three of the four edges along the axes count for less */
        Vec2 p = d->corner[i], q = d->corner[(i + 1) % 12];
        double x = (p.u + q.u) / 2 - k, z = (p.v + q.v) / 2 - k;
        if (fabs(z) < 1e-6 || (fabs(x) < 1e-6 && z < 0))
            d->rate[i] = 3;
    }
    triangle(b, 0, -0.5, 0.5, 0.5, 0.5, 0, 0.5 + S / 2);
    triangle(b, 1, k - 0.5, 0, k + 0.5, 0, k, -S / 2);
}

static void squares_turned(Builder *b)
{
    double B = 1 + S;
    lattice(b, 6, S / 6, (Vec2){ B / 2, B / 2 }, (Vec2){ B, 0 });
    triangle(b, 0, 0, -0.5, 0, 0.5, S / 2, 0);
    triangle(b, 2, 0, -0.5, 0, 0.5, -S / 2, 0);
    triangle(b, 3, B / 2 - 0.5, 0, B / 2 + 0.5, 0, B / 2, S / 2);
    triangle(b, 1, B / 2 - 0.5, 0, B / 2 + 0.5, 0, B / 2, -S / 2);
    Vec2 p = { S / 2, 0 }, q = { 0, 0.5 }, r = { 0.5, 0.5 + S / 2 }, s = { S / 2 + 0.5, S / 2 };
    quad(b, 4, p, q, r, s)->least = 4.000001 / 6;
    quad(b, 5, (Vec2){ B - p.u, p.v }, (Vec2){ B - q.u, q.v }, (Vec2){ B - r.u, r.v }, (Vec2){ B - s.u, s.v })->least =
        5.000001 / 6;
}

static void build_simple(Builder *b)
{
    const Vec2 o = { 0, 0 }, e = { 1, 0 }, f = { 0.5, S / 2 };
    switch (b->t->number) {
    case 1: lattice(b, 1, 0.5, (Vec2){ 1, 0 }, (Vec2){ 0, 1 }); rect(b, 0, 0, 0, 1, 1); break;
    case 2: lattice(b, 1, S / 2, (Vec2){ 1.5, S / 2 }, (Vec2){ 0, S }); regular(b, 0, 6, 0.5, S / 2, 0); break;
    case 3:
        lattice(b, 2, S / 6, e, f);
        triangle(b, 0, 0, 0, 1, 0, 0.5, S / 2);
        triangle(b, 1, 0.5, S / 2, 1.5, S / 2, 1, 0);
        break;
    case 4: lattice(b, 1, S / 4, e, f); quad(b, 0, o, e, (Vec2){ 1.5, S / 2 }, f); break;
    case 5:
        lattice(b, 3, S / 4, (Vec2){ 1.5, S / 2 }, (Vec2){ 0, S });
        quad(b, 0, o, e, (Vec2){ 1.5, S / 2 }, f);
        quad(b, 1, o, f, (Vec2){ 0, S }, (Vec2){ -0.5, S / 2 });
        quad(b, 2, f, (Vec2){ 1.5, S / 2 }, (Vec2){ 1, S }, (Vec2){ 0, S });
        break;
    case 6: lattice(b, 2, 0.5, (Vec2){ 1, 1 }, (Vec2){ 4, 0 }); rect(b, 1, 0, 0, 1, 2); rect(b, 0, 1, 0, 3, 1); break;
    case 7:
        lattice(b, 2, 0.5, (Vec2){ 1 + Q, 0 }, (Vec2){ 0, 1 + Q });
        regular(b, 0, 4, (1 + Q) / 2, (1 + Q) / 2, 0);
        regular(b, 1, 8, 0, 0, 22.5);
        break;
    case 8:
        lattice(b, 3, S / 6, e, (Vec2){ 0.5, 1 + S / 2 });
        rect(b, 2, 0, 0, 1, 1)->extra = 1e-7 / 3;
        triangle(b, 0, 0, 1, 1, 1, 0.5, 1 + S / 2);
        triangle(b, 1, 0, 1, 0.5, 1 + S / 2, -0.5, 1 + S / 2);
        break;
    case 9:
        lattice(b, 3, S / 6, (Vec2){ 2, 0 }, (Vec2){ 1, S });
        regular(b, 2, 6, 0.5, S / 2, 0)->least = 2.0000001 / 3;
        triangle(b, 0, -1, 0, 0, 0, -0.5, S / 2);
        triangle(b, 1, -1, S, 0, S, -0.5, S / 2);
        break;
    case 10: lattice(b, 1, 0.5, e, (Vec2){ 0.5, 1 }); rect(b, 0, 0, 0, 1, 1); break;
    default:                                   /* 11, and 12 that mirrors it */
        lattice(b, 3, 0.5, (Vec2){ 3, 0 }, (Vec2){ 0, 3 });
        rect(b, 2, 0, 0, 1, 2);
        rect(b, 1, 1, 0, 3, 1);
        rect(b, 0, 1, 1, 2, 2);
        rect(b, 2, 2, 1, 3, 3);
        rect(b, 1, 0, 2, 2, 3);
        break;
    }
}

static void build_tiles(Builder *b)
{
    switch (b->t->number) {
    case 13: case 14: {
        bool few = b->t->number == 13;
        lattice(b, few ? 3 : 5, 0.5, (Vec2){ 4, 0 }, (Vec2){ 0, 4 });
        rect(b, few ? 0 : 4, 1, 1, 3, 3)->extra = few ? 0 : 1e-6 / 5;
        trapezoids(b, few ? 2 : 0, few ? 2 : 1, few ? 1 : 2, few ? 1 : 3);
        break;
    }
    case 15:
        lattice(b, 2, 0.5, (Vec2){ 2, 1 }, (Vec2){ -1, 2 });
        rect(b, 0, 0, 0, 1, 1);
        rect(b, 1, 1, -1, 3, 1)->extra = 1e-8;
        break;
    case 16: hexagon_squares_triangles(b, (const double[]){ 2, 0, 0, 0, 1, 1 }, 3, 0); break;
    case 17: hexagon_squares_triangles(b, (const double[]){ 5, 0, 1, 2, 4, 3 }, 6, 1e-6); break;
    case 18:
        lattice(b, 2, 0.5, (Vec2){ 2, 2 }, (Vec2){ 4, 0 });
        rect(b, 1, 0, 0, 1, 2);
        rect(b, 1, 1, 0, 2, 2);
        rect(b, 0, 2, 0, 4, 1);
        rect(b, 0, 2, 1, 4, 2);
        break;
    case 19: hexagons_in_triangles(b, -1); break;
    case 20: hexagons_in_triangles(b, 1); break;
    case 21: squares_turned(b); break;
    case 22: dodecagon_triangles(b); break;
    case 23: dodecagon_hexagons_squares(b, (const double[]){ 2, 0, 1, 1, 1 }, 3); break;
    case 24: dodecagon_hexagons_squares(b, (const double[]){ 4, 0, 1, 2, 3 }, 5); break;
    default: build_simple(b); break;
    }
}

/* A copy of a tile moved by a lattice vector, if it may reach the parallelogram. */
static void add_copy(Builder *b, const Tile *tile, Vec2 move)
{
    Tiling *t = b->t;
    Vec2 lo = { INFINITY, INFINITY }, hi = { -INFINITY, -INFINITY };
    for (int i = 0; i < tile->n; i++) {
        Vec2 p = { tile->corner[i].u + move.u, tile->corner[i].v + move.v };
        lo = (Vec2){ fmin(lo.u, p.u), fmin(lo.v, p.v) };
        hi = (Vec2){ fmax(hi.u, p.u), fmax(hi.v, p.v) };
    }
    if (hi.u < t->lo.u - 1e-6 || lo.u > t->hi.u + 1e-6 || hi.v < t->lo.v - 1e-6 || lo.v > t->hi.v + 1e-6 ||
        t->n_copies == MAX_COPIES)
        return;
    Edge *edge = arena_array(b->arena, Edge, (size_t)tile->n);
    for (int i = 0; i < tile->n; i++) {
        Vec2 p = tile->corner[i], q = tile->corner[(i + 1) % tile->n];
        double dx = q.u - p.u, dz = q.v - p.v, n = sqrt(dx * dx + dz * dz);
        double a = -dz / n, c = dx / n;
        edge[i] = (Edge){ a, c, -(a * (p.u + move.u) + c * (p.v + move.v)), tile->rate[i] };
    }
    t->copy[t->n_copies++] = (Copy){ tile->n, edge, (tile->class + 1) + tile->extra * t->classes, tile->least };
}

static void add_copies(Builder *b)
{
    Tiling *t = b->t;
    Vec2 u = t->along, v = t->across;
    double det = u.u * v.v - u.v * v.u;
    const double inverse[4] = { v.v / det, -v.u / det, -u.v / det, u.u / det };
    for (int i = 0; i < 4; i++)
        t->inverse[i] = inverse[i];
    t->lo = (Vec2){ fmin(0, u.u) + fmin(0, v.u), fmin(0, u.v) + fmin(0, v.v) };
    t->hi = (Vec2){ fmax(0, u.u) + fmax(0, v.u), fmax(0, u.v) + fmax(0, v.v) };
    t->copy = arena_array(b->arena, Copy, MAX_COPIES);
    for (int i = -REACH; i <= REACH; i++)
        for (int j = -REACH; j <= REACH; j++)
            for (int k = 0; k < t->n_tiles; k++)
                add_copy(b, &b->tile[k], (Vec2){ i * u.u + j * v.u, i * u.v + j * v.v });
}

static void parse(Parser *p, void *params)
{
    Tiling *t = params;
    *t = (Tiling){ .number = parse_int(p), .scale = 1 };
    if (t->number < 1 || t->number > 27)
        parse_fail(p, "Invalid tiling: 1 to 27 are known, not %d.", t->number);
    if (t->number >= 25)
        return;
    Builder *b = arena_new(parse_arena(p), Builder);
    b->t = t;
    b->arena = parse_arena(p);
    build_tiles(b);
    add_copies(b);
}

static double folded(double x)
{
    return fabs(x - 6 * floor(x / 6) - 3);
}

static double value(const void *params, const PatternPoint *at)
{
    const Tiling *t = params;
    double x = at->p.x, z = at->p.z;
    if (t->number >= 25)
        return penrose_value(t->number, x, z);
    if (t->number == 12) {
        x = folded(x);
        z = folded(z);
    }
    x *= t->scale;
    z *= t->scale;
    double a = x * t->inverse[0] + z * t->inverse[1], b = x * t->inverse[2] + z * t->inverse[3];
    a -= floor(a);
    b -= floor(b);
    x = a * t->along.u + b * t->across.u;
    z = a * t->along.v + b * t->across.v;
    const Copy *best = NULL;
    double depth = -INFINITY;                  /* within the tile; rounding may leave no tile with a positive one */
    for (int i = 0; i < t->n_copies; i++) {
        const Copy *c = &t->copy[i];
        double inner = INFINITY;
        for (int k = 0; k < c->n && inner > depth; k++)
            inner = fmin(inner, (c->edge[k].a * x + c->edge[k].b * z + c->edge[k].c) * c->edge[k].rate);
        if (inner > depth) {
            depth = inner;
            best = c;
        }
    }
    if (best == NULL)
        return 0;
    double v = (best->top - fmin(1, fmax(0, depth))) / t->classes;
    return v < best->least ? best->least : v;
}

const PatternOps pattern_tiling = { .keyword = "tiling", .params_size = sizeof(Tiling), .parse = parse, .value = value };
