/* clearance.c - a grid around a solid; each cell knows how many layers of cells around it are empty.
 *
 * For solids that are traced in small steps, most of which go through air: what lies beyond the last cell that may hold something need
 * not be searched. A line is followed from its far end in leaps as long as the layers allow. Cells are judged by the balls around them,
 * from coarse to fine, and once in a coarser grid to learn what box the grid is to fill. */
#include "shape/clearance.h"

#include <string.h>

#include "shape/shape.h"

enum { LEVELS = CLEARANCE_LEVELS, SIDE = CLEARANCE_SIDE };

typedef struct {
    Bounds box;
    Vec3 cell;                                 /* its sides */
    MayHold *may_hold;
    const void *solid;
    uint32_t row[SIDE][SIDE];                  /* [z][y], bit x: may hold something */
    Bounds hull;                               /* of those */
} Cells;

_Static_assert(SIDE == 32, "a row is a word");

/* Judges the eighths of a cube of 2^level cells a side, down to cubes of 2^least. */
static void judge(Cells *c, int level, int least, int x, int y, int z)
{
    static const double room = 1 + 1e-6;       /* for rounding */
    int half = 1 << (level - 1);
    Vec3 size = scaled(c->cell, half), lo[8], centre[8];
    for (int k = 0; k < 8; k++) {
        lo[k] = add(c->box.lo, mul(c->cell, vec3(x + (k & 1) * half, y + (k >> 1 & 1) * half, z + (k >> 2) * half)));
        centre[k] = add(lo[k], scaled(size, 0.5));
    }
    for (uint32_t some = c->may_hold(c->solid, centre, 0.5 * room * length(size)); some != 0; some &= some - 1) {
        int k = __builtin_ctz(some), kx = x + (k & 1) * half, ky = y + (k >> 1 & 1) * half, kz = z + (k >> 2) * half;
        if (level - 1 > least) {
            judge(c, level - 1, least, kx, ky, kz);
            continue;
        }
        c->row[kz][ky] |= UINT32_C(1) << kx;
        c->hull = bounds_union(c->hull, (Bounds){ lo[k], add(lo[k], size) });
    }
}

static Bounds judged(Cells *c, Bounds box, MayHold *may_hold, const void *solid, int least)
{
    *c = (Cells){ .box = box, .cell = scaled(sub(box.hi, box.lo), 1.0 / SIDE), .may_hold = may_hold, .solid = solid,
                  .hull = bounds_empty() };
    judge(c, LEVELS, least, 0, 0, 0);
    return c->hull;
}

/* Every marked cell marks its neighbours, 26 of them. */
static void spread(uint32_t row[SIDE][SIDE])
{
    uint32_t wide[SIDE][SIDE];
    for (int z = 0; z < SIDE; z++) {
        for (int y = 0; y < SIDE; y++)
            wide[z][y] = row[z][y] | row[z][y] << 1 | row[z][y] >> 1;
        for (int y = 0; y < SIDE; y++)
            row[z][y] = wide[z][y] | wide[z][y > 0 ? y - 1 : y] | wide[z][y + 1 < SIDE ? y + 1 : y];
    }
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            wide[z][y] = row[z][y] | row[z > 0 ? z - 1 : z][y] | row[z + 1 < SIDE ? z + 1 : z][y];
    memcpy(row, wide, sizeof wide);
}

void clearance_build(Clearance *c, MayHold *may_hold, const void *solid, double size)
{
    Cells cells;
    Bounds box = { vec3(-size, -size, -size), vec3(size, size, size) };
    for (int i = 0; i < 2 && !bounds_is_empty(box); i++)
        box = judged(&cells, box, may_hold, solid, 1);
    *c = (Clearance){ .box = box, .lo = box.lo };
    if (!bounds_is_empty(box))
        c->box = judged(&cells, box, may_hold, solid, 0);
    if (bounds_is_empty(c->box))
        return;
    c->per_cell = vec3(1 / cells.cell.x, 1 / cells.cell.y, 1 / cells.cell.z);
    c->cell = lesser(cells.cell.x, lesser(cells.cell.y, cells.cell.z));
    for (bool more = true; more;) {
        more = false;
        spread(cells.row);
        for (int z = 0; z < SIDE; z++)
            for (int y = 0; y < SIDE; y++)
                for (uint32_t clear = ~cells.row[z][y]; clear != 0; clear &= clear - 1, more = true)
                    c->gap[z][y][__builtin_ctz(clear)]++;
    }
}

static inline int cell_of(double x)
{
    int i = (int)x;
    return i < 0 ? 0 : i >= SIDE ? SIDE - 1 : i;
}

double clearance_from(const Clearance *c, Vec3 o, Vec3 u)
{
    double first = -INFINITY, s = INFINITY;
    if (c->cell == 0)
        return -INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double lo = vec3_at(c->box.lo, axis) - vec3_at(o, axis), hi = vec3_at(c->box.hi, axis) - vec3_at(o, axis), d = vec3_at(u, axis);
        if (d == 0) {
            if (lo > 0 || hi < 0)
                return -INFINITY;
            continue;
        }
        double a = lo / d, b = hi / d;
        first = greater(first, lesser(a, b));
        s = lesser(s, greater(a, b));
    }
    while (s >= first) {
        Vec3 p = sub(add(o, scaled(u, s)), c->lo);
        uint8_t gap = c->gap[cell_of(p.z * c->per_cell.z)][cell_of(p.y * c->per_cell.y)][cell_of(p.x * c->per_cell.x)];
        if (gap == 0)
            return s;
        s -= gap * c->cell;
    }
    return -INFINITY;
}
