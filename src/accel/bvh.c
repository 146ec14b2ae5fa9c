/* bvh.c - a tree of boxes, eight children to a node, split by the surface area heuristic.
 *
 * A node starts as one range of items; the range whose box is largest is split in two until there are eight. Splits are
 * binned (Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007). */
#include "accel/bvh.h"

#include "accel/accel.h"
#include "base/array.h"

enum {
    N_BINS = 16,
    LEAF_MAX = 4,                              /* a range of so many items may stay whole */
    DEPTH_BINNED = 40                          /* below it ranges are halved by count: log8(2^32) more levels at most */
};

/* Testing an item costs about this many box tests: an indirect call, and often a transform. */
static const float ITEM_COST = 1.5f;

typedef struct Box { float lo[3], hi[3]; } Box;

typedef struct Item {                          /* sorted in place: every pass over a range reads on in memory */
    Box box;
    uint32_t index;
} Item;

typedef struct Range {
    uint32_t first, n;
    Box box, middles;                          /* of the items, and of their middles */
    bool whole;                                /* stays a leaf */
} Range;

typedef struct Builder {
    Bvh *bvh;
    Arena *arena;
    Item *item;
    uint32_t capacity;
} Builder;

static Box box_none(void)
{
    return (Box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static void box_add(Box *a, const Box *b)
{
    for (int i = 0; i < 3; i++) {
        a->lo[i] = b->lo[i] < a->lo[i] ? b->lo[i] : a->lo[i];
        a->hi[i] = b->hi[i] > a->hi[i] ? b->hi[i] : a->hi[i];
    }
}

/* Half the surface; 0 for an empty box. Divided first: boxes may be as large as floats go. */
static float box_area(const Box *b)
{
    float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x >= 0 && y >= 0 && z >= 0 ? x * y + y * z + z * x : 0;
}

/* Kept finite: one odd box must not spoil the others' bins. */
static float box_middle(const Box *b, int axis)
{
    float m = b->lo[axis] * 0.5f + b->hi[axis] * 0.5f;
    return isfinite(m) ? m : 0;
}

static Box box_outward(const Bounds *b)
{
    Box out;
    for (int i = 0; i < 3; i++) {
        float lo = float_below(vec3_at(b->lo, i)), hi = float_above(vec3_at(b->hi, i));
        out.lo[i] = lo > -INFINITY ? float_down(lo) : -INFINITY;       /* NaN too */
        out.hi[i] = hi < INFINITY ? float_up(hi) : INFINITY;
    }
    return out;
}

/* ---- splitting ---- */

typedef struct Split {
    int axis;                                  /* -1: none found */
    float lo, scale;                           /* bin = (middle - lo) * scale */
    int bin;                                   /* first bin of the right side */
    float cost;
} Split;

typedef struct Bins {
    Box box[N_BINS];
    uint32_t n[N_BINS];
} Bins;

static int bin_of(float lo, float scale, float middle)
{
    float at = (middle - lo) * scale;
    return at > 0 ? (int)(at < N_BINS - 1 ? at : N_BINS - 1) : 0;
}

/* The best plane between bins, if better than *best. */
static void try_bins(const Bins *bins, uint32_t n, Split s, Split *best)
{
    float right_area[N_BINS];
    Box side = box_none();
    for (int i = N_BINS - 1; i > 0; i--) {
        box_add(&side, &bins->box[i]);
        right_area[i] = box_area(&side);
    }
    side = box_none();
    uint32_t left = 0;
    for (int i = 1; i < N_BINS; i++) {
        box_add(&side, &bins->box[i - 1]);
        left += bins->n[i - 1];
        if (left == 0 || left == n)
            continue;
        float cost = box_area(&side) * (float)left + right_area[i] * (float)(n - left);
        if (cost < best->cost) {
            s.bin = i;
            s.cost = cost;
            *best = s;
        }
    }
}

static Split find_split(const Builder *k, const Range *r)
{
    Bins bins[3];
    Split s[3], best = { .axis = -1, .cost = INFINITY };
    for (int axis = 0; axis < 3; axis++) {
        float lo = r->middles.lo[axis], size = r->middles.hi[axis] - lo, scale = N_BINS / size;
        bool flat = !(size > 0) || !isfinite(scale);
        s[axis] = (Split){ .axis = flat ? -1 : axis, .lo = lo, .scale = flat ? 0 : scale };
        for (int i = 0; i < N_BINS; i++) {
            bins[axis].box[i] = box_none();
            bins[axis].n[i] = 0;
        }
    }
    for (uint32_t i = r->first; i < r->first + r->n; i++) {
        const Box *b = &k->item[i].box;
        for (int axis = 0; axis < 3; axis++) {
            int bin = bin_of(s[axis].lo, s[axis].scale, box_middle(b, axis));
            bins[axis].n[bin]++;
            box_add(&bins[axis].box[bin], b);
        }
    }
    for (int axis = 0; axis < 3; axis++)
        if (s[axis].axis >= 0)
            try_bins(&bins[axis], r->n, s[axis], &best);
    return best;
}

/* Sorts the range by sides of the plane; returns how many are left of it. */
static uint32_t partition(const Builder *k, const Range *r, const Split *s)
{
    uint32_t i = r->first, j = r->first + r->n;
    while (i < j)
        if (bin_of(s->lo, s->scale, box_middle(&k->item[i].box, s->axis)) < s->bin)
            i++;
        else {
            Item item = k->item[i];
            k->item[i] = k->item[--j];
            k->item[j] = item;
        }
    return i - r->first;
}

static Range range_of(const Builder *k, uint32_t first, uint32_t n)
{
    Range r = { .first = first, .n = n, .box = box_none(), .middles = box_none(), .whole = n == 1 };
    for (uint32_t i = first; i < first + n; i++) {
        const Box *b = &k->item[i].box;
        box_add(&r.box, b);
        Box m;
        for (int axis = 0; axis < 3; axis++)
            m.lo[axis] = m.hi[axis] = box_middle(b, axis);
        box_add(&r.middles, &m);
    }
    return r;
}

/* Cuts *r in two, or marks it whole. */
static bool split(const Builder *k, Range *r, Range *other, bool binned)
{
    Split s = { .axis = -1 };
    if (binned)
        s = find_split(k, r);
    float area = box_area(&r->box);
    if (r->n <= LEAF_MAX && !(s.axis >= 0 && area + s.cost * ITEM_COST < area * (float)r->n * ITEM_COST)) {
        r->whole = true;
        return false;
    }
    uint32_t first = r->first, n = r->n, left = s.axis >= 0 ? partition(k, r, &s) : n / 2;
    if (left == 0 || left == n)
        left = n / 2;
    *r = range_of(k, first, left);
    *other = range_of(k, first + left, n - left);
    return true;
}

/* ---- nodes ---- */

static uint32_t node_new(Builder *k)
{
    Bvh *b = k->bvh;
    if (b->n_nodes == k->capacity)
        b->node = array_grow(k->arena, b->node, b->n_nodes, &k->capacity, sizeof *b->node);
    return b->n_nodes++;
}

/* By area while the tree grows by area; by count when ranges are halved, to keep the depth. */
static int widest(const Range *range, uint32_t n, bool binned)
{
    int best = -1;
    float size = -1;
    for (uint32_t i = 0; i < n; i++) {
        float s = binned ? box_area(&range[i].box) : (float)range[i].n;
        if (!range[i].whole && !(s <= size)) {
            best = (int)i;
            size = s;
        }
    }
    return best;
}

static void build_node(Builder *k, uint32_t index, Range all, int depth)
{
    Range range[BVH_WIDTH] = { all };
    uint32_t n = 1;
    bool binned = depth < DEPTH_BINNED;
    int at;
    while (n < BVH_WIDTH && (at = widest(range, n, binned)) >= 0)
        if (split(k, &range[at], &range[n], binned))
            n++;
    BvhNode node = { .n = n };
    for (uint32_t i = 0; i < n; i++) {
        const Range *r = &range[i];
        for (int axis = 0; axis < 3; axis++) {
            node.lo[axis][i] = r->box.lo[axis];
            node.hi[axis][i] = r->box.hi[axis];
        }
        bool leaf = r->whole || r->n <= LEAF_MAX;
        node.count[i] = leaf ? (uint8_t)r->n : 0;
        node.child[i] = leaf ? r->first : node_new(k);
    }
    k->bvh->node[index] = node;
    for (uint32_t i = 0; i < n; i++)
        if (node.count[i] == 0)
            build_node(k, node.child[i], range[i], depth + 1);
}

/* Boxes and growing nodes live in an arena of their own, so that the World keeps only what it walks. */
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
        item[i] = (Item){ box_outward(&boxes[i]), i };
    Builder k = { .bvh = b, .arena = &scratch, .item = item };
    build_node(&k, node_new(&k), range_of(&k, 0, n), 0);
    b->node = arena_copy(a, b->node, b->n_nodes * sizeof *b->node);
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

const AccelOps accel_bvh = { .name = "bvh", .build = build, .walk = walk, .around = around };
