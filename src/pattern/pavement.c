/* pavement.c - tilings of the xz plane by groups of squares, triangles or hexagons.
 *
 * Which cells form a tile is data (pavement_table.c). Here is what is drawn in a cell: an edge is closed if another tile lies
 * beyond it, open if not, and corners get their forms from the edges about them (06-noise-and-patterns, section 8). */
#include "pattern/pavement.h"

#include <stdlib.h>

#include "pattern/wave.h"
#include "sdl/parse.h"

enum { MAX_PERIOD = 12 };

static const double S = 1.73205080756887729353;

typedef struct { int8_t tile, i, j; } Place;                   /* a cell of one period: its tile, and where the table has it */

typedef struct {
    int sides, cells, number;
    int form, interior, exterior;
    const Pavement *row;
    Place place[2 * MAX_PERIOD];
} Params;

typedef struct { long long i, j; int tile; } Tile;             /* a tile of the plane: its number, and its translation */

static bool same(Tile a, Tile b)
{
    return a.i == b.i && a.j == b.j && a.tile == b.tile;
}

static long long divided(long long a, long long b)             /* rounded down; b > 0 */
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/* Moves a cell into the first period; its index there. */
static int reduce(const Pavement *row, long long *i, long long *j, int down)
{
    long long k = divided(*j, row->across[1]);
    *j -= k * row->across[1];
    *i -= k * row->across[0];
    *i -= divided(*i, row->along[0]) * row->along[0];
    return (int)(*j * row->along[0] + *i) * 2 + down;
}

static Tile tile_of(const Params *p, long long i, long long j, int down)
{
    long long ri = i, rj = j;
    const Place *place = &p->place[reduce(p->row, &ri, &rj, down)];
    return (Tile){ i - place->i, j - place->j, place->tile };
}

static void fill(Params *p)
{
    int8_t tile = 0;
    for (const char *s = p->row->tiles; *s != 0;) {
        char *end;
        long long i = strtol(s, &end, 10), j = strtol(end + 1, &end, 10);
        int down = *end == 'd';
        s = end + (*end == 'u' || *end == 'd');
        long long ri = i, rj = j;
        p->place[reduce(p->row, &ri, &rj, down)] = (Place){ tile, (int8_t)i, (int8_t)j };
        if (*s == ';')
            tile++;
        if (*s != 0)
            s++;
    }
}

/* Finds the row for what has been said so far; NULL until it is consistent. */
static void choose(Params *p)
{
    p->row = NULL;
    for (const Pavement *row = pavement_table; row->sides != 0; row++)
        if (row->sides == p->sides && row->cells == p->cells && row->number == p->number)
            p->row = row;
    if (p->row != NULL)
        fill(p);
}

static bool item(Parser *p, void *params)
{
    Params *d = params;
    if (parse_accept(p, KW_NUMBER_OF_SIDES)) {
        d->sides = parse_int(p);
        if (d->sides != 3 && d->sides != 4 && d->sides != 6)
            parse_fail(p, "pavement: number_of_sides must be 3, 4 or 6, not %d", d->sides);
    } else if (parse_accept(p, KW_NUMBER_OF_TILES)) {
        d->cells = parse_int(p);
        if (d->cells < 1 || d->cells > 6)
            parse_fail(p, "pavement: number_of_tiles must be 1 to 6, not %d", d->cells);
    } else if (parse_accept(p, KW_PATTERN)) {
        d->number = parse_int(p);
        if (d->number < 1 || d->number > 35)
            parse_fail(p, "pavement: there is no pattern %d", d->number);
    } else if (parse_accept(p, KW_FORM)) {
        d->form = parse_int(p);
    } else if (parse_accept(p, KW_INTERIOR)) {
        d->interior = parse_int(p);
    } else if (parse_accept(p, KW_EXTERIOR)) {
        d->exterior = parse_int(p);
    } else {
        return false;
    }
    choose(d);
    return true;
}

static void parse(Parser *p, void *params)
{
    (void)p;
    Params *d = params;
    *d = (Params){ .sides = 3, .cells = 1, .number = 1 };
    choose(d);
}

static void finish(Parser *p, const void *params)
{
    const Params *d = params;
    if (d->row == NULL)
        parse_fail(p, "pavement: no pattern %d with number_of_sides %d and number_of_tiles %d", d->number, d->sides, d->cells);
}

static int modulo(int a, int n)
{
    return (a % n + n) % n;
}

typedef struct Square { double x, z; bool closed[4]; } Square; /* x, z: -1..1; edges right, left, far, near */

/* The edges toward one side of each axis. */
static bool edge_x(const Square *q, int s) { return q->closed[s > 0 ? 0 : 1]; }
static bool edge_z(const Square *q, int s) { return q->closed[s > 0 ? 2 : 3]; }

static double bend(int form, double a, double b)
{
    switch (form) {
    case 0: return fmax(fmax(-a, -b), fmin(a, b));
    case 1: return fmin(1, fabs(1 - a - b));
    default: return fmin(1, fabs(hypot(1 - a, 1 - b) - 1));
    }
}

static double inner_corner(int interior, double a, double b)
{
    switch (interior) {
    case 0: return fmin(a, b);
    case 1: return a + b - 1;
    default: return 1 - hypot(1 - a, 1 - b);
    }
}

static double outer_corner(int exterior, double a, double b)
{
    switch (exterior) {
    case 0: return 0;
    case 1: return fmin(1, a + b);
    default: return a >= 0 && b >= 0 ? fmin(1, hypot(a, b)) : 0;
    }
}

static double square_value(const Params *p, double x, double z)
{
    long long i = (long long)floor(x), j = (long long)floor(z);
    Tile self = tile_of(p, i, j, 0);
    Square q = { 2 * (x - (double)i) - 1, 2 * (z - (double)j) - 1,
                 { !same(self, tile_of(p, i + 1, j, 0)), !same(self, tile_of(p, i - 1, j, 0)),
                   !same(self, tile_of(p, i, j + 1, 0)), !same(self, tile_of(p, i, j - 1, 0)) } };
    int form = modulo(p->form, 4), interior = modulo(p->interior, 3), exterior = modulo(p->exterior, 3);
    double v = 0;
    for (int k = 0; k < 4; k++) {
        double along = k == 0 ? q.x : k == 1 ? -q.x : k == 2 ? q.z : -q.z;
        if (q.closed[k])
            v = fmax(v, along);
    }
    for (int sx = -1; sx <= 1; sx += 2)
        for (int sz = -1; sz <= 1; sz += 2) {
            bool here_x = edge_x(&q, sx), here_z = edge_z(&q, sz);
            double a = sx * q.x, b = sz * q.z;
            if (!here_x && !here_z && !same(self, tile_of(p, i + sx, j + sz, 0))) {
                if (form < 3 && edge_x(&q, -sx) && edge_z(&q, -sz))
                    return bend(form, a, b);
                v = fmax(v, inner_corner(interior, a, b));
            } else if (here_x && here_z) {
                v = fmax(v, outer_corner(exterior, a, b));
            }
        }
    return v;
}

/* The triangle of the grid that holds the point. Corners are in lattice coordinates: (i, j) stands at (i + j/2, j S/2). */
typedef struct Corner { long long i, j; } Corner;
typedef struct Triangle {
    long long i, j;
    int down;
    Corner corner[3];
    double share[3];                           /* barycentric: 1 at the corner, 0 on the edge opposite */
    Vec2 p;                                    /* the point, from the corner of the grid nearest by */
} Triangle;

static Triangle triangle_at(double x, double z)
{
    double b = z / (S / 2), a = x - b / 2;
    Triangle t = { .i = (long long)floor(a), .j = (long long)floor(b) };
    double fa = a - (double)t.i, fb = b - (double)t.j;
    t.down = fa + fb > 1;
    if (t.down) {
        t.corner[0] = (Corner){ t.i + 1, t.j + 1 };
        t.corner[1] = (Corner){ t.i, t.j + 1 };
        t.corner[2] = (Corner){ t.i + 1, t.j };
        t.share[0] = fa + fb - 1;
        t.share[1] = 1 - fa;
        t.share[2] = 1 - fb;
    } else {
        t.corner[0] = (Corner){ t.i, t.j };
        t.corner[1] = (Corner){ t.i + 1, t.j };
        t.corner[2] = (Corner){ t.i, t.j + 1 };
        t.share[0] = 1 - fa - fb;
        t.share[1] = fa;
        t.share[2] = fb;
    }
    t.p = (Vec2){ fa + fb / 2, fb * S / 2 };
    return t;
}

static Corner center_of(long long i, long long j, int down)
{
    const Corner up[3] = { { i, j }, { i + 1, j }, { i, j + 1 } }, under[3] = { { i + 1, j + 1 }, { i, j + 1 }, { i + 1, j } };
    for (int k = 0; k < 3; k++) {
        Corner c = down ? under[k] : up[k];
        if ((c.i - c.j - 1) % 3 == 0)
            return c;
    }
    return up[0];
}

static Tile triangle_tile(const Params *p, long long i, long long j, int down)
{
    if (p->sides == 3)
        return tile_of(p, i, j, down);
    Corner c = center_of(i, j, down);          /* of the hexagon that this triangle is a sixth of */
    long long r = (1 - (c.i - c.j)) / 3;
    return tile_of(p, c.j - 2 * r, r, 0);
}

/* Across the edge opposite to corner k. */
static void neighbour(long long *i, long long *j, int *down, int k)
{
    if (*down) {
        *i += k == 1;
        *j += k == 2;
    } else {
        *i -= k == 1;
        *j -= k == 2;
    }
    *down = !*down;
}

static Tile beyond(const Params *p, long long i, long long j, int down, int k)
{
    neighbour(&i, &j, &down, k);
    return triangle_tile(p, i, j, down);
}

static bool one_tile_round(const Params *p, Corner c, Tile self)
{
    return same(self, triangle_tile(p, c.i, c.j, 0)) && same(self, triangle_tile(p, c.i - 1, c.j, 0)) &&
           same(self, triangle_tile(p, c.i, c.j - 1, 0)) && same(self, triangle_tile(p, c.i, c.j - 1, 1)) &&
           same(self, triangle_tile(p, c.i - 1, c.j - 1, 1)) && same(self, triangle_tile(p, c.i - 1, c.j, 1));
}

/* In the neighbour across the edge `open`, which is part of this tile: is its other edge at corner `near` closed? */
static bool closed_beyond(const Params *p, const Triangle *t, int open, int near, Tile self)
{
    long long i = t->i, j = t->j;
    int down = t->down;
    neighbour(&i, &j, &down, open);
    Corner c = t->corner[near];
    const Corner up[3] = { { i, j }, { i + 1, j }, { i, j + 1 } }, under[3] = { { i + 1, j + 1 }, { i, j + 1 }, { i + 1, j } };
    int there = 0;
    for (int k = 0; k < 3; k++) {
        Corner d = down ? under[k] : up[k];
        if (d.i == c.i && d.j == c.j)
            there = k;
    }
    int other = 3 - there - open;              /* the shared edge has the same number on both sides */
    return !same(self, beyond(p, i, j, down, other));
}

/* Distance between the point and corner k: sides are 1, so barycentric differences give it. */
static double corner_distance(const Triangle *t, int k)
{
    double b = t->share[(k + 1) % 3], c = t->share[(k + 2) % 3];
    return sqrt(b * b + c * c + b * c);
}

/* Along the edge from corner `from` to corner `end`: 1 at the former, 0 half way, -1 at the latter. */
static double along_edge(const Triangle *t, int from, int end)
{
    int third = 3 - from - end;
    return 1 - 2 * (t->share[end] + t->share[third] / 2);
}

typedef struct Corners { bool closed[3]; int near; Tile self; } Corners;

static double interior_corner(int interior, const Triangle *t, int k, bool near)
{
    switch (interior) {
    case 0: return 1 - 2 * S * (S / 2) * (1 - t->share[k]);
    case 1: return near ? fmin(1.5 * along_edge(t, k, (k + 1) % 3) - 0.5, 1.5 * along_edge(t, k, (k + 2) % 3) - 0.5) : 0;
    default: return 1 - 3 * corner_distance(t, k);
    }
}

/* A corner of 60 degrees between closed edges, of triangles only. */
static double exterior_corner(int exterior, const Triangle *t, int k, bool near, double v)
{
    if (exterior == 2 && near) {
        double b = t->share[1] - 1.0 / 3, c = t->share[2] - 1.0 / 3;
        return fmin(1, 2 * S * sqrt(b * b + c * c + b * c));
    }
    if (exterior == 1 && t->share[(k + 1) % 3] < 1.0 / 3 && t->share[(k + 2) % 3] < 1.0 / 3)
        return fmin(1, 2 * S * fabs(t->share[k] * S / 2 - S / 6));
    return v;
}

/* The 120 degree corners of forms 1 and 2; false if the near corner is none. */
static bool wide_corner(const Params *p, const Triangle *t, const Corners *c, int form, double *v)
{
    int near = c->near, a = (near + 1) % 3, b = (near + 2) % 3;
    if (c->closed[a] == c->closed[b])
        return false;
    int open = c->closed[a] ? b : a, end = 3 - near - open;
    if (!closed_beyond(p, t, open, near, c->self))
        return false;
    *v = form == 2 ? wave_clamp(2 * S * (corner_distance(t, end) - S / 3)) : fmin(1, 2 * fabs(along_edge(t, near, end)));
    return true;
}

static double triangle_value(const Params *p, double x, double z)
{
    Triangle t = triangle_at(x, z);
    Corners c = { .self = triangle_tile(p, t.i, t.j, t.down) };
    int form = modulo(p->form, 3), interior = modulo(p->interior, 3), exterior = modulo(p->exterior, 3);
    double v = 0;
    for (int k = 0; k < 3; k++) {
        c.closed[k] = !same(c.self, beyond(p, t.i, t.j, t.down, k));
        if (c.closed[k])
            v = fmax(v, 1 - 2 * S * (t.share[k] * S / 2));
        if (t.share[k] > t.share[c.near])
            c.near = k;
    }
    for (int k = 0; k < 3; k++)
        if (!c.closed[(k + 1) % 3] && !c.closed[(k + 2) % 3] && !one_tile_round(p, t.corner[k], c.self))
            v = fmax(v, interior_corner(interior, &t, k, k == c.near));
    for (int k = 0; p->sides == 3 && k < 3; k++)
        if (c.closed[(k + 1) % 3] && c.closed[(k + 2) % 3])
            v = exterior_corner(exterior, &t, k, k == c.near, v);
    if (form > 0)
        wide_corner(p, &t, &c, form, &v);
    return v;
}

static double value(const void *params, const PatternPoint *at)
{
    const Params *p = params;
    double x = at->p.x, z = at->p.z;
    if (p->row == NULL || !(fabs(x) < 1e15 && fabs(z) < 1e15))
        return 0;
    return p->sides == 4 ? square_value(p, x, z) : triangle_value(p, x, z);
}

const PatternOps pattern_pavement = {
    .keyword = "pavement", .params_size = sizeof(Params), .parse = parse, .item = item, .finish = finish, .value = value,
};
