/* bvh.c - a tree of boxes, eight children to a node, split by the surface area heuristic.
 *
 * A node starts as one range of items; the range whose box is largest is split in two until there are eight. Splits are
 * binned (Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007). Of very many items the upper levels are
 * built over the cells of a grid instead, each standing for the items in it: that decides nearly the same for a fraction of
 * the passes over all items. */
#include "accel/bvh.h"

#include "accel/accel.h"
#include "base/array.h"
#include "base/simd.h"

enum {
    N_BINS = 16,
    MANY = 1 << 15,                            /* so many items are cheap ones (triangles), and memory counts */
    LEAF_FEW = 1, LEAF_MANY = 4,               /* a range of so many items may stay whole: calling one costs more than a node */
    DEPTH_BINNED = 40,                         /* below it ranges are halved by count: log8(2^32) more levels at most */
    GRID_FROM = 4096,                          /* a range of more items is sorted into a grid first */
    PER_CELL = 12,                             /* items to a cell, if they filled the space evenly */
    CELLS_FEW = 48,                            /* a range of cells with no more items becomes one of items */
    ITEMS_PER_NODE = 4
};

/* Testing an item costs about this many box tests: an indirect call, often a transform, sometimes a set operation. */
static const float COST_FEW = 3, COST_MANY = 1.5f;

typedef struct Box { f4 lo, hi; } Box;         /* the fourth of each means nothing */

typedef struct Item {                          /* sorted in place: every pass over a range reads on in memory */
    float lo[3];
    uint32_t index;                            /* of a cell: where its items begin in Builder.in_cells */
    float hi[3];
    uint32_t n;                                /* items in the cell; 1 for an item */
} Item;

typedef struct Range {
    Item *item;
    uint32_t n, total;                         /* items or cells; items in them */
    Box box, middles;                          /* of the items, and of their middles */
    bool cells;
    bool whole;                                /* stays a leaf */
} Range;

typedef struct Builder {
    Bvh *bvh;
    Arena *arena;                              /* for what serves the building only */
    Arena *world;                              /* for nodes, and nothing else until the last one stands */
    Item *item;                                /* in the order of the leaves, as far as they are placed */
    Item *in_cells;                            /* the others, cell by cell */
    uint32_t n_placed;
    uint32_t capacity, leaf_max;
    float cost;
} Builder;

static Box box_none(void)
{
    return (Box){ f4_set(INFINITY), f4_set(-INFINITY) };
}

/* Bounds of items never are NaN; a NaN in the fourth place stays there. */
static Box box_both(Box a, Box b)
{
    return (Box){ f4_min(b.lo, a.lo), f4_max(b.hi, a.hi) };
}

static Box item_box(const Item *item)
{
    return (Box){ f4_load(item->lo), f4_load(item->hi) };
}

static void item_set_box(Item *item, Box b)
{
    uint32_t index = item->index, n = item->n; /* behind the three that count */
    f4_store(item->lo, b.lo);
    f4_store(item->hi, b.hi);
    item->index = index;
    item->n = n;
}

/* Half the surface; 0 for an empty box. */
static inline float box_area(Box b)
{
    float d[4];
    f4_store(d, f4_max(f4_sub(b.hi, b.lo), f4_set(0)));
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/* Twice the middle, which orders items as well. Of what is unbounded it may be no number: that counts as last. */
static inline f4 box_middle(Box b)
{
    return f4_add(b.lo, b.hi);
}

/* At most x, and one ulp less; -INFINITY for what is not a number. Without branches on how x rounds: nobody can foresee that. Floats
 * in order are whole numbers in order, once those below 0 are turned round. */
static inline float outward_below(double x)
{
    const int32_t infinity = 0x7f800000;
    float f = (float)x;
    int32_t bits = (int32_t)float_bits(f), sign = bits >> 31, rank = ((bits & INT32_MAX) ^ sign) - sign;
    rank -= 1 + ((double)f > x);
    rank = rank > -infinity ? rank : -infinity;
    sign = rank >> 31;
    float below = float_of_bits((uint32_t)((rank ^ sign) - sign) | ((uint32_t)sign & 0x80000000u));
    return f == f ? below : -INFINITY;
}

static Item item_outward(const Bounds *b, uint32_t index)
{
    Item out = { .index = index, .n = 1 };
    for (int i = 0; i < 3; i++) {
        out.lo[i] = outward_below(vec3_at(b->lo, i));
        out.hi[i] = -outward_below(-vec3_at(b->hi, i));
    }
    return out;
}

/* ---- splitting ---- */

typedef struct Split {
    int axis;                                  /* -1: none found */
    int bin;                                   /* first bin of the right side */
    float cost;
} Split;

typedef struct Bins {
    int n;                                     /* per axis; fewer for few items */
    f4 lo, scale;                              /* bin = (middle - lo) * scale */
    Box box[3][N_BINS];
    uint32_t count[3][N_BINS];
} Bins;

static inline void bins_of(const Bins *bins, f4 middle, int32_t out[4])
{
    f4 most = f4_set((float)(bins->n - 1));
    f4 bin = f4_mul(f4_sub(middle, bins->lo), bins->scale);
    f4_to_int(out, f4_max(f4_min(bin, most), f4_set(0)));
}

static void bins_fill(Bins *bins, const Range *r)
{
    float size[4], scale[4] = { 0 };
    bins->n = r->n <= 8 ? 4 : r->n <= 64 ? 8 : N_BINS;
    bins->lo = r->middles.lo;
    f4_store(size, f4_sub(r->middles.hi, r->middles.lo));
    for (int axis = 0; axis < 3; axis++) {
        scale[axis] = size[axis] > 0 ? (float)bins->n / size[axis] : 0;
        scale[axis] = scale[axis] < INFINITY ? scale[axis] : 0;        /* all in one bin: no split on this axis */
        for (int i = 0; i < bins->n; i++) {
            bins->box[axis][i] = box_none();
            bins->count[axis][i] = 0;
        }
    }
    bins->scale = f4_load(scale);
    for (uint32_t i = 0; i < r->n; i++) {
        Box b = item_box(&r->item[i]);
        int32_t bin[4];
        bins_of(bins, box_middle(b), bin);
        for (int axis = 0; axis < 3; axis++) {
            bins->box[axis][bin[axis]] = box_both(bins->box[axis][bin[axis]], b);
            bins->count[axis][bin[axis]] += r->item[i].n;
        }
    }
}

/* The best plane between bins. */
static Split find_split(const Bins *bins, uint32_t n)
{
    Split best = { .axis = -1, .cost = INFINITY };
    for (int axis = 0; axis < 3; axis++) {
        float right_area[N_BINS];
        Box side = box_none();
        for (int i = bins->n - 1; i > 0; i--) {
            side = box_both(side, bins->box[axis][i]);
            right_area[i] = box_area(side);
        }
        side = box_none();
        uint32_t left = 0;
        for (int i = 1; i < bins->n; i++) {
            side = box_both(side, bins->box[axis][i - 1]);
            left += bins->count[axis][i - 1];
            if (left == 0 || left == n)
                continue;
            float cost = box_area(side) * (float)left + right_area[i] * (float)(n - left);
            if (cost < best.cost)
                best = (Split){ axis, i, cost };
        }
    }
    return best;
}

/* Without its items: box, middles and total are still to be filled in. */
static Range range_empty(Item *item, uint32_t n, bool cells)
{
    Range r;
    r.item = item;
    r.n = n;
    r.total = 0;
    r.box = r.middles = box_none();
    r.cells = cells;
    r.whole = n == 1 && !cells;
    return r;
}

static Range range_of(Item *item, uint32_t n, bool cells)
{
    Range r = range_empty(item, n, cells);
    for (uint32_t i = 0; i < n; i++) {
        Box b = item_box(&item[i]);
        f4 m = box_middle(b);
        r.box = box_both(r.box, b);
        r.middles = box_both(r.middles, (Box){ m, m });
        r.total += item[i].n;
    }
    return r;
}

/* Leaves the first `left` items to *r, gives the others to *other. */
static void halve(Range *r, Range *other, uint32_t left)
{
    *other = range_of(r->item + left, r->n - left, r->cells);
    *r = range_of(r->item, left, r->cells);
}

/* Sorts the range by sides of the plane: the left one to *r, the right one to *other. The bins have their boxes already. */
static void halve_at_plane(Range *r, Range *other, const Bins *bins, const Split *s)
{
    Box left = box_none(), right = box_none(); /* middles */
    Item *item = r->item;
    uint32_t i = 0, j = r->n;
    float lo[4], scale[4];
    f4_store(lo, bins->lo);
    f4_store(scale, bins->scale);
    while (i < j) {
        f4 m = box_middle(item_box(&item[i]));
        /* bins_of on this axis, not cut to a whole number */
        if ((item[i].lo[s->axis] + item[i].hi[s->axis] - lo[s->axis]) * scale[s->axis] < (float)s->bin) {
            left = box_both(left, (Box){ m, m });
            i++;
        } else {
            right = box_both(right, (Box){ m, m });
            Item swapped = item[i];
            item[i] = item[--j];
            item[j] = swapped;
        }
    }
    uint32_t n = r->n;
    *r = range_empty(item, i, r->cells);
    *other = range_empty(item + i, n - i, r->cells);
    r->middles = left;
    other->middles = right;
    for (int k = 0; k < bins->n; k++) {
        Range *side = k < s->bin ? r : other;
        side->box = box_both(side->box, bins->box[s->axis][k]);
        side->total += bins->count[s->axis][k];
    }
}

/* ---- the grid ---- */

typedef struct Grid {
    f4 lo, scale;                              /* cell = (middle - lo) * scale */
    f4 last;                                   /* the last cell on each axis */
    uint32_t size[3];
} Grid;

/* Cells are cubes; an axis shorter than their edge has one, and leaves more to the others. */
static Grid grid_over(const Range *r)
{
    Grid g = { .lo = r->middles.lo };
    float side[4], scale[4] = { 0 }, last[4] = { 0 };
    double edge = 0;
    f4_store(side, f4_sub(r->middles.hi, r->middles.lo));
    for (int round = 0; round < 3; round++) {
        double volume = 1;
        int n_axes = 0;
        for (int i = 0; i < 3; i++)
            if ((double)side[i] > edge) {
                volume *= (double)side[i];
                n_axes++;
            }
        if (n_axes > 0)
            edge = pow(volume * PER_CELL / r->n, 1.0 / n_axes);
    }
    for (int i = 0; i < 3; i++) {
        double n = (double)side[i] > edge ? (double)side[i] / edge : 1;
        g.size[i] = n < 1024 ? (uint32_t)n : 1024;
        float by = g.size[i] > 1 ? (float)g.size[i] / side[i] : 0;
        scale[i] = by < INFINITY ? by : 0;
        last[i] = (float)(g.size[i] - 1);
    }
    g.scale = f4_load(scale);
    g.last = f4_load(last);
    return g;
}

static uint32_t cell_of(const Grid *g, const Item *item)
{
    int32_t at[4];
    f4 cell = f4_mul(f4_sub(box_middle(item_box(item)), g->lo), g->scale);
    f4_to_int(at, f4_max(f4_min(cell, g->last), f4_set(0)));
    return ((uint32_t)at[2] * g->size[1] + (uint32_t)at[1]) * g->size[0] + (uint32_t)at[0];
}

/* The range's items, sorted by cell into `to`, a part of in_cells; the cells that are not empty. */
static Range range_of_cells(Builder *k, const Range *r, Item *to)
{
    Grid g = grid_over(r);
    uint32_t n_cells = g.size[0] * g.size[1] * g.size[2], n = 0, begin = (uint32_t)(to - k->in_cells);
    uint32_t *cell_at = arena_array(k->arena, uint32_t, r->n), *count = arena_array(k->arena, uint32_t, n_cells);
    for (uint32_t i = 0; i < r->n; i++) {
        cell_at[i] = cell_of(&g, &r->item[i]);
        n += count[cell_at[i]]++ == 0;
    }
    Item *cell = arena_array(k->arena, Item, n);
    Box none = box_none();
    n = 0;
    for (uint32_t i = 0; i < n_cells; i++)
        if (count[i] > 0) {
            item_set_box(&cell[n], none);
            cell[n].index = begin;
            begin += count[i];
            count[i] = n++;                    /* from here on: which one */
        }
    for (uint32_t i = 0; i < r->n; i++) {
        Item *c = &cell[count[cell_at[i]]];
        k->in_cells[c->index + c->n++] = r->item[i];
        item_set_box(c, box_both(item_box(c), item_box(&r->item[i])));
    }
    return range_of(cell, n, true);
}

/* The cells' items are placed: where they stand now, their leaves will be. */
static Range range_placed(Builder *k, const Range *r)
{
    Item *first = k->item + k->n_placed;
    for (uint32_t i = 0; i < r->n; i++) {
        memcpy(k->item + k->n_placed, k->in_cells + r->item[i].index, r->item[i].n * sizeof *first);
        k->n_placed += r->item[i].n;
    }
    return range_of(first, r->total, false);
}

/* When there is no more to decide among the cells. A single one that holds very many gets a grid of its own. */
static void leave_cells(Builder *k, Range *r)
{
    if (!r->cells || (r->n > 1 && r->total > CELLS_FEW))
        return;
    uint32_t placed = k->n_placed;
    Item *within = r->n == 1 ? k->in_cells + r->item[0].index : NULL;
    *r = range_placed(k, r);
    if (within == NULL || r->n < GRID_FROM)
        return;
    Range cells = range_of_cells(k, r, within);
    if (cells.n > 1) {
        *r = cells;
        k->n_placed = placed;
    }
}

/* ---- cutting ---- */

/* Two items can be cut in one way only: no bins for a third of all ranges. */
static uint32_t cut_pair(const Builder *k, const Range *r)
{
    float area = box_area(r->box), apart = box_area(item_box(&r->item[0])) + box_area(item_box(&r->item[1]));
    return area + apart * k->cost < area * 2 * k->cost ? 1 : 0;
}

/* At the best plane; false: better left whole. */
static bool cut_by_area(const Builder *k, Range *r, Range *other)
{
    if (r->n == 2 && !r->cells) {
        uint32_t left = cut_pair(k, r);
        if (left > 0)
            halve(r, other, left);
        return left > 0;
    }
    Bins bins;
    bins_fill(&bins, r);
    Split s = find_split(&bins, r->total);
    float area = box_area(r->box);
    bool pays = s.axis >= 0 && area + s.cost * k->cost < area * (float)r->total * k->cost;
    if (r->total <= k->leaf_max && !pays)
        return false;
    if (s.axis >= 0)
        halve_at_plane(r, other, &bins, &s);
    else
        halve(r, other, r->n / 2);
    return true;
}

static bool cut_by_count(const Builder *k, Range *r, Range *other)
{
    if (r->n <= k->leaf_max)
        return false;
    halve(r, other, r->n / 2);
    return true;
}

/* Cuts *r in two, or marks it whole. */
static bool split(Builder *k, Range *r, Range *other, bool binned)
{
    if (r->cells && !binned)
        *r = range_placed(k, r);
    if (!(binned ? cut_by_area(k, r, other) : cut_by_count(k, r, other))) {
        r->whole = true;
        return false;
    }
    leave_cells(k, r);
    leave_cells(k, other);
    return true;
}

/* ---- nodes ---- */

static uint32_t node_new(Builder *k)
{
    Bvh *b = k->bvh;
    if (b->n_nodes == k->capacity)
        b->node = array_grow(k->world, b->node, b->n_nodes, &k->capacity, sizeof *b->node);
    return b->n_nodes++;
}

/* By area while the tree grows by area; by count when ranges are halved, to keep the depth. */
static int widest(const Range *range, uint32_t n, bool binned)
{
    int best = -1;
    float size = -1;
    for (uint32_t i = 0; i < n; i++) {
        float s = binned ? box_area(range[i].box) : (float)range[i].total;
        if (!range[i].whole && !(s <= size)) {
            best = (int)i;
            size = s;
        }
    }
    return best;
}

/* So few items are a child each: boxes of children cost next to nothing. Two in nearly the same box stay together. */
static uint32_t spread(const Builder *k, const Range *all, Range *range)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < all->n; i += range[n++].n) {
        range[n] = range_of(all->item + i, i + 1 < all->n ? 2 : 1, false);
        if (range[n].n == 2 && cut_pair(k, &range[n]) > 0)
            range[n] = range_of(all->item + i, 1, false);
        range[n].whole = true;
    }
    return n;
}

static void build_node(Builder *k, uint32_t index, Range all, int depth)
{
    Range range[BVH_WIDTH];
    range[0] = all;
    uint32_t n = 1, child[BVH_WIDTH];
    bool binned = depth < DEPTH_BINNED;
    int at;
    if (all.n <= BVH_WIDTH && !all.cells)
        n = spread(k, &all, range);
    while (n < BVH_WIDTH && (at = widest(range, n, binned)) >= 0)
        if (split(k, &range[at], &range[n], binned))
            n++;
    for (uint32_t i = 0; i < n; i++) {
        const Range *r = &range[i];
        bool leaf = r->whole || r->total <= k->leaf_max || (r->n == 2 && !r->cells && cut_pair(k, r) == 0);
        child[i] = leaf ? bvh_child((uint32_t)(r->item - k->item), r->n) : bvh_child(node_new(k), 0);
    }
    BvhNode *node = &k->bvh->node[index];      /* nodes stand still until the first child asks for more */
    node->used = (1u << n) - 1;
    for (uint32_t i = 0; i < n; i++) {
        float lo[4], hi[4];
        f4_store(lo, range[i].box.lo);
        f4_store(hi, range[i].box.hi);
        for (int axis = 0; axis < 3; axis++) {
            node->side[axis][i] = lo[axis];
            node->side[axis + 3][i] = hi[axis];
        }
        node->child[i] = child[i];
    }
    for (uint32_t i = 0; i < n; i++)
        if (bvh_count(child[i]) == 0)
            build_node(k, bvh_at(child[i]), range[i], depth + 1);
}

/* Boxes live in an arena of their own, so that the World keeps only what it walks. Of the room for nodes, generous unless leaves are
 * very small, what is not used is given back: it has not been touched. */
static void *build(Arena *a, const Bounds *boxes, uint32_t n)
{
    Arena scratch;
    arena_init(&scratch);
    Bvh *b = arena_new(a, Bvh);
    b->item = arena_array(a, uint32_t, n);
    b->n_items = n;
    b->isa = cpu_isa();
    Item *item = arena_array(&scratch, Item, n);
    for (uint32_t i = 0; i < n; i++)
        item[i] = item_outward(&boxes[i], i);
    Builder k = { .bvh = b, .arena = &scratch, .world = a, .capacity = n / ITEMS_PER_NODE + 2, .item = item, .leaf_max = n < MANY ? LEAF_FEW : LEAF_MANY,
                  .cost = n < MANY ? COST_FEW : COST_MANY };
    Range all = range_of(item, n, false);
    if (n >= GRID_FROM) {
        k.in_cells = arena_array(&scratch, Item, n);
        all = range_of_cells(&k, &all, k.in_cells);
        leave_cells(&k, &all);
    }
    b->node = arena_array(a, BvhNode, k.capacity);
    build_node(&k, node_new(&k), all, 0);
    arena_trim(a, b->node, b->n_nodes * sizeof *b->node);
    for (uint32_t i = 0; i < n; i++)
        b->item[i] = item[i].index;
    arena_free(&scratch);
    return b;
}

static bool walk(const void *accel, const Ray *ray, double *t_max, AccelVisit *visit, void *user)
{
    static BvhWalk *const walks[] = CPU_TABLE(bvh_walk);
    const Bvh *b = accel;
    return walks[b->isa](b, ray, t_max, visit, user);
}

static bool around(const void *accel, Vec3 p, AccelVisit *visit, void *user)
{
    static BvhAround *const arounds[] = CPU_TABLE(bvh_around);
    const Bvh *b = accel;
    return arounds[b->isa](b, p, visit, user);
}

static bool between(const void *accel, Vec3 o, Bounds to, AccelVisit *visit, void *user)
{
    static BvhBetween *const betweens[] = CPU_TABLE(bvh_between);
    const Bvh *b = accel;
    return betweens[b->isa](b, o, to, visit, user);
}

const AccelOps accel_bvh = { .name = "bvh", .build = build, .walk = walk, .around = around, .between = between };
