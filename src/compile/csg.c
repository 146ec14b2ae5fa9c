/* csg.c - set operations over items: what they reach, and boxes cut by what stands around them.
 *
 * A leaf of an intersection can only be hit where the intersection can be, so the accelerator gets each leaf's box cut by
 * those of its ancestors: an endless plane in an intersection becomes a face. */
#include "compile/context.h"
#include "compile/polytope.h"
#include "compile/slice.h"

enum { LISTED_MAX = 8 };                       /* from so many children on, a tree answers "who is around this point?" */

/* What sums of products along three axes may be off by, and more. */
static const double ASKEW = 0x1p-48;

Reach item_reach(const Compile *c, uint32_t item)
{
    if (is_node(item)) {
        const CsgNode *node = &c->csg.data[~item];
        if (node->flags & CSG_BOUND)
            return item_reach(c, c->csg_child.data[node->first]);
        return (Reach){ node->box, (node->flags & CSG_INVERSE) != 0 };
    }
    const Prim *prim = &c->prim.data[item];
    if (prim->ops->flags & SHAPE_NO_BOX_IN_CSG)
        return (Reach){ bounds_everything(), false };
    bool patch = (prim->flags & PRIM_PATCH) != 0;      /* nowhere inside, also inverted */
    return (Reach){ c->box.data[item], (prim->flags & PRIM_INVERSE) && !patch };
}

Bounds item_hull(const Compile *c, uint32_t item)
{
    if (!is_node(item))
        return c->box.data[item];
    const CsgNode *node = &c->csg.data[~item];
    Bounds hull = bounds_empty();
    uint32_t n = node->flags & (CSG_CLIP | CSG_BOUND) ? 1 : node->n;
    for (uint32_t i = 0; i < n; i++)
        hull = bounds_union(hull, item_hull(c, c->csg_child.data[node->first + i]));
    if (node->op == CSG_ALL && !(node->flags & (CSG_INVERSE | CSG_BOUND)))
        hull = bounds_intersection(hull, node->box);
    return hull;
}

/* ---- bounds that hold all of a body ---- */

/* Nothing is inside the child beyond its box, and it has one. */
static bool is_solid(const Compile *c, uint32_t item)
{
    return !item_reach(c, item).co && (is_node(item) || !(c->prim.data[item].ops->flags & SHAPE_NO_BOX_IN_CSG));
}

/* The box of a prim along the axes of a space that lies askew to the world's. */
static Bounds prim_hull_in(const Compile *c, uint32_t item, const Affine *to_space)
{
    const Prim *prim = &c->prim.data[item];
    if (prim->ops->reach == NULL)
        return bounds_transformed(c->box.data[item], to_space);
    Affine whole = affine_then(*prim->place, *to_space);
    Bounds box;
    for (int j = 0; j < 3; j++) {
        Vec3 n = vec3(whole.m[0][j], whole.m[1][j], whole.m[2][j]);
        double at = whole.m[3][j], most = prim->ops->reach(prim->data, n), least = prim->ops->reach(prim->data, negated(n));
        double pad = (fabs(at) + fabs(most) + fabs(least)) * ASKEW;
        vec3_set(&box.lo, j, at - least - pad);
        vec3_set(&box.hi, j, at + most + pad);
    }
    return box;
}

/* As item_hull. What an intersection shows lies in each of its children that are no complements. */
static Bounds item_hull_in(const Compile *c, uint32_t item, const Affine *to_space)
{
    if (!is_node(item))
        return prim_hull_in(c, item, to_space);
    const CsgNode *node = &c->csg.data[~item];
    Bounds all = bounds_empty(), common = bounds_everything();
    uint32_t n = node->flags & CSG_BOUND ? 1 : node->n;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t child = c->csg_child.data[node->first + i];
        Bounds hull = item_hull_in(c, child, to_space);
        all = bounds_union(all, hull);
        if (!is_node(child) && is_solid(c, child))
            common = bounds_intersection(common, hull);
    }
    return node->op == CSG_ALL && !(node->flags & CSG_BOUND) ? bounds_intersection(all, common) : all;
}

static bool corners_inside(const Prim *prim, Bounds box, const Affine *back)
{
    if (!bounds_is_finite(box))
        return false;
    for (int i = 0; i < 8; i++) {
        Vec3 corner = vec3(i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 4 ? box.hi.z : box.lo.z);
        if (!prim->ops->inside(prim->data, affine_point(back, corner)))
            return false;
    }
    return true;
}

bool item_holds(const Compile *c, uint32_t item, uint32_t body, Bounds hull)
{
    if (is_node(item))
        return false;
    const Prim *prim = &c->prim.data[item];
    if (!(prim->ops->flags & SHAPE_CONVEX) || (prim->flags & PRIM_INVERSE) || prim->ops->inside == NULL)
        return false;
    Affine back = affine_inverse(*prim->place);
    return corners_inside(prim, hull, &back) ||
           (!back.identity && corners_inside(prim, item_hull_in(c, body, &back), c->identity));
}

/* What a child leaves of a box that the others of an intersection have cut. */
static Bounds cut_by_child(const Compile *c, uint32_t item, Bounds box)
{
    if (is_node(item))
        return box;
    const Prim *prim = &c->prim.data[item];
    if (prim->ops->within == NULL || (prim->flags & (PRIM_INVERSE | PRIM_PATCH)) || bounds_is_empty(box))
        return box;
    const Affine *place = prim->place;
    Affine back = affine_inverse(*place);
    Bounds local = prim->ops->within(prim->data, bounds_transformed(box, &back));
    if (bounds_is_empty(local))
        return box;
    return bounds_intersection(box, bounds_transformed(local, place));
}

static bool is_plane(const Compile *c, uint32_t item)
{
    return !is_node(item) && c->prim.data[item].ops->half_space != NULL;
}

/* How far a body goes along n: no point of it has a larger n . p. */
static double item_reach_along(const Compile *c, uint32_t item, Vec3 n)
{
    if (!is_node(item)) {
        const Prim *prim = &c->prim.data[item];
        if (prim->ops->reach != NULL)
            return dot(n, affine_point(prim->place, vec3(0, 0, 0))) + prim->ops->reach(prim->data, affine_normal_back(prim->place, n));
        const Bounds *box = &c->box.data[item];
        return bounds_is_finite(*box) ? fmax(n.x * box->lo.x, n.x * box->hi.x) + fmax(n.y * box->lo.y, n.y * box->hi.y) +
                                            fmax(n.z * box->lo.z, n.z * box->hi.z) : INFINITY;
    }
    const CsgNode *node = &c->csg.data[~item];
    double all = -INFINITY, common = INFINITY;
    uint32_t count = node->flags & CSG_BOUND ? 1 : node->n;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t child = c->csg_child.data[node->first + i];
        double at = item_reach_along(c, child, n);
        all = fmax(all, at);
        if (is_solid(c, child) && !is_plane(c, child))
            common = fmin(common, at);
    }
    return node->op == CSG_ALL && !(node->flags & CSG_BOUND) ? fmin(all, common) : all;
}

static HalfSpace half_space_of(const Prim *prim)
{
    const Affine *place = prim->place;
    Vec3 normal;
    double distance;
    prim->ops->half_space(prim->data, &normal, &distance);
    Vec3 on = affine_point(place, scaled(normal, distance)), across = normalized(affine_normal(place, normal));
    double sign = prim->flags & PRIM_INVERSE ? -1 : 1;
    return (HalfSpace){ scaled(across, sign), sign * dot(across, on) };
}

/* What the planes among the children leave of an endless box, together with its sides. */
static Bounds cut_by_planes(const Compile *c, const Items *children, Bounds box)
{
    HalfSpace h[POLYTOPE_MAX + 1];
    uint32_t n = 0;
    for (int side = 0; side < 6; side++) {
        double at = vec3_at(side < 3 ? box.lo : box.hi, side % 3), sign = side < 3 ? -1 : 1;
        if (isfinite(at)) {
            h[n].normal = vec3(0, 0, 0);
            vec3_set(&h[n].normal, side % 3, sign);
            h[n++].distance = sign * at;
        }
    }
    for (uint32_t i = 0; i < children->n && n <= POLYTOPE_MAX; i++)
        if (!is_node(children->data[i]) && c->prim.data[children->data[i]].ops->half_space != NULL)
            h[n++] = half_space_of(&c->prim.data[children->data[i]]);
    return bounds_intersection(box, polytope_box(h, n));
}

/* Half spaces that hold an intersection: those of its planes that stand along no axis of the world, and, against each of them, how
 * far its solid children go. */
static uint32_t askew_sides(const Compile *c, const uint32_t *child, uint32_t n_children, HalfSpace h[POLYTOPE_MAX])
{
    uint32_t n_planes = 0;
    for (uint32_t i = 0; i < n_children && n_planes < POLYTOPE_MAX / 2; i++)
        if (is_plane(c, child[i])) {
            h[n_planes] = half_space_of(&c->prim.data[child[i]]);
            n_planes += isfinite(h[n_planes].distance) && max_abs(h[n_planes].normal) < 1;
        }
    uint32_t n = n_planes;
    for (uint32_t k = 0; k < n_planes; k++) {
        h[n] = (HalfSpace){ negated(h[k].normal), INFINITY };
        for (uint32_t i = 0; i < n_children; i++)
            if (is_solid(c, child[i]) && !is_plane(c, child[i]))
                h[n].distance = fmin(h[n].distance, item_reach_along(c, child[i], h[n].normal));
        n += isfinite(h[n].distance);
    }
    return n;
}

/* What planes that stand askew leave of a finite box. */
static Bounds cut_askew(const Compile *c, const Items *children, Bounds box)
{
    HalfSpace h[POLYTOPE_MAX];
    uint32_t n = askew_sides(c, children->data, children->n, h);
    if (n == 0)
        return box;
    Bounds left = polytope_within(box, h, n);
    return bounds_is_empty(left) ? box : bounds_intersection(box, left);
}

/* Leaves that all contain a point if some intersection does: planes, and those that know what a box leaves of them. */
enum { PLANES_MAX = 32, SOLIDS_MAX = 8 };
typedef struct Members {
    HalfSpace plane[PLANES_MAX];
    const Prim *solid[SOLIDS_MAX];
    uint32_t n_planes, n_solids;
} Members;

static void members_add(const Compile *c, uint32_t item, Members *m)
{
    if (is_node(item)) {
        const CsgNode *node = &c->csg.data[~item];
        if (node->op == CSG_ALL && !(node->flags & (CSG_INVERSE | CSG_BOUND)))
            for (uint32_t i = 0; i < node->n; i++)
                members_add(c, c->csg_child.data[node->first + i], m);
        return;
    }
    const Prim *prim = &c->prim.data[item];
    if (prim->ops->half_space != NULL && m->n_planes < PLANES_MAX)
        m->plane[m->n_planes++] = half_space_of(prim);
    else if (prim->ops->within != NULL && !(prim->flags & (PRIM_INVERSE | PRIM_PATCH)) && m->n_solids < SOLIDS_MAX)
        m->solid[m->n_solids++] = prim;
}

/* What is left of an endless box between planes that stand along the axes of some member, or of a member's own members. */
static Bounds cut_by_slices(const Compile *c, const Items *children, Bounds box)
{
    Members m;
    m.n_planes = m.n_solids = 0;
    for (uint32_t i = 0; i < children->n; i++)
        members_add(c, children->data[i], &m);
    for (uint32_t i = 0; i < m.n_solids; i++)
        box = bounds_intersection(box, slice_box(m.solid[i], m.plane, m.n_planes));
    return box;
}

/* Of all children together. An ALL is outside wherever one child is; if every child is a complement, it is one itself. */
static Reach reach_of(const Compile *c, CsgOp op, const Items *children)
{
    Bounds within = bounds_everything(), around = bounds_empty(), co_within = bounds_everything(), co_around = bounds_empty();
    uint32_t n_co = 0;
    for (uint32_t i = 0; i < children->n; i++) {
        Reach r = item_reach(c, children->data[i]);
        if (r.co) {
            n_co++;
            co_within = bounds_intersection(co_within, r.box);
            co_around = bounds_union(co_around, r.box);
        } else {
            within = bounds_intersection(within, r.box);
            around = bounds_union(around, r.box);
        }
    }
    if (op == CSG_ALL)
        for (uint32_t i = 0; i < children->n; i++)
            within = cut_by_child(c, children->data[i], within);
    if (op == CSG_ALL && !bounds_is_finite(within) && !bounds_is_empty(within) && n_co < children->n)
        within = cut_by_slices(c, children, cut_by_planes(c, children, within));
    else if (op == CSG_ALL && !bounds_is_empty(within) && n_co < children->n)
        within = cut_askew(c, children, within);
    if (op == CSG_ALL)
        return n_co > 0 && n_co == children->n ? (Reach){ co_around, true } : (Reach){ within, false };
    return n_co > 0 ? (Reach){ co_within, true } : (Reach){ around, false };
}

static void set_parent(Compile *c, uint32_t item, uint32_t node)
{
    if (is_node(item))
        c->csg.data[~item].parent = node;
    else
        c->prim.data[item].csg = node;
}

/* Outside its box, does the child say what a search of this operation is not looking for? Then the tree may skip it. */
static bool is_selective(CsgOp op, Reach r)
{
    return (op == CSG_ALL) == r.co;
}

uint32_t csg_node(Compile *c, CsgOp op, uint32_t flags, const Items *children, uint32_t first_prim)
{
    Reach r = reach_of(c, op, children);
    uint32_t index = c->csg.n;
    array_push(c->arena, &c->csg, (CsgNode){ .first = c->csg_child.n, .n = children->n, .n_listed = children->n,
                                             .first_prim = first_prim, .n_prims = c->prim.n - first_prim, .op = op,
                                             .flags = flags | (r.co ? CSG_INVERSE : 0), .box = r.box });
    for (uint32_t i = 0; i < children->n; i++) {
        set_parent(c, children->data[i], index);
        array_push(c->arena, &c->csg_child, children->data[i]);
    }
    return ~index;
}

/* Turns the order of the prims from first_prim on around; nodes from first_node on are those above them. */
void csg_reverse(Compile *c, uint32_t first_prim, uint32_t first_node)
{
    uint32_t end = c->prim.n;
    if (end - first_prim < 2)
        return;
    for (uint32_t i = first_prim, j = end - 1; i < j; i++, j--) {
        Prim prim = c->prim.data[i];
        c->prim.data[i] = c->prim.data[j];
        c->prim.data[j] = prim;
        Bounds box = c->box.data[i];
        c->box.data[i] = c->box.data[j];
        c->box.data[j] = box;
    }
    for (uint32_t k = first_node; k < c->csg.n; k++) {
        CsgNode *node = &c->csg.data[k];
        node->first_prim = first_prim + end - (node->first_prim + node->n_prims);
        for (uint32_t i = node->first; i < node->first + node->n; i++)
            if (!is_node(c->csg_child.data[i]))
                c->csg_child.data[i] = first_prim + end - 1 - c->csg_child.data[i];
    }
}

/* The box of a node's bounds: all its rays pass through it. */
static Bounds bound_box(const Compile *c, const CsgNode *node)
{
    if (node->n == 1)
        return node->box;
    Bounds box = bounds_everything();
    for (uint32_t i = 1; i < node->n; i++) {
        Reach r = item_reach(c, c->csg_child.data[node->first + i]);
        if (!r.co)
            box = bounds_intersection(box, r.box);
    }
    return box;
}

/* Planes of an intersection are seen where they bound it: their boxes shrink to its faces. */
static void cut_to_faces(Compile *c, const CsgNode *node, Bounds box)
{
    HalfSpace h[POLYTOPE_MAX];
    const uint32_t *child = &c->csg_child.data[node->first];
    uint32_t n = askew_sides(c, child, node->n, h);
    for (uint32_t i = 0; i < node->n; i++)
        if (is_plane(c, child[i])) {
            HalfSpace plane = half_space_of(&c->prim.data[child[i]]);
            if (isfinite(plane.distance))
                c->box.data[child[i]] = bounds_intersection(box, polytope_face(plane, box, h, n));
        }
}

/* What a bound that is too small leaves outside still shows on rays that meet the bound, so bounds cut no boxes. But a leaf that
 * would have no finite box without them is looked for within them only: its hits outside do not count (PRIM_BOXED). */
static void cut_item(Compile *c, uint32_t item, Bounds limit, Bounds bound, bool to_faces)
{
    if (!is_node(item)) {
        Bounds box = bounds_intersection(c->box.data[item], limit);
        if (!bounds_is_finite(box) && !bounds_is_empty(box) && bounds_is_finite(bound)) {
            box = bounds_intersection(box, bound);
            c->prim.data[item].flags |= PRIM_BOXED;
        }
        c->box.data[item] = box;
        return;
    }
    const CsgNode *node = &c->csg.data[~item];
    if (node->flags & CSG_BOUND)
        bound = bounds_intersection(bound, bound_box(c, node));
    else if (!(node->flags & CSG_INVERSE))
        limit = bounds_intersection(limit, node->box);
    uint32_t n = node->flags & CSG_BOUND ? 1 : node->n;
    for (uint32_t i = 0; i < n; i++)
        cut_item(c, c->csg_child.data[node->first + i], limit, bound, to_faces);
    if (to_faces && node->op == CSG_ALL && !(node->flags & (CSG_CLIP | CSG_BOUND | CSG_INVERSE)) && bounds_is_finite(limit))
        cut_to_faces(c, node, limit);
}

/* ---- when all is known ---- */

/* A difference of a difference takes away twice, which one node does as well: chains of them become one list. */
static bool melts_into(const CsgNode *inner, const CsgNode *outer)
{
    const uint32_t whole = CSG_CLIP | CSG_BOUND | CSG_CUTAWAY;
    return inner->op == outer->op && !((inner->flags ^ outer->flags) & CSG_MERGE) &&
           !((inner->flags | outer->flags) & whole);
}

static void gather(const Compile *c, const CsgNode *node, const CsgNode *outer, Items *out)
{
    for (uint32_t i = 0; i < node->n; i++) {
        uint32_t item = c->csg_child.data[node->first + i];
        if (is_node(item) && melts_into(&c->csg.data[~item], outer))
            gather(c, &c->csg.data[~item], outer, out);
        else
            array_push(c->arena, out, item);
    }
}

/* How much wider than a body the box is in which it is asked: more than any `inside` takes for the surface. */
static const double ROOM = 0x1p-16;

static Bounds roomy(Bounds b)
{
    return bounds_is_finite(b) ? bounds_grown(b, ROOM * fmax(max_abs(b.lo), max_abs(b.hi))) : bounds_everything();
}

static CsgPart part_of(const Compile *c, const CsgNode *parent, uint32_t item)
{
    bool wanted = parent->op == CSG_ANY;
    Reach r = item_reach(c, item);
    CsgPart part = { .box = roomy(r.box), .item = item, .far_answer = r.co == wanted, .near_answer = wanted };
    if (is_node(item))
        return part;
    const Prim *prim = &c->prim.data[item];
    part.inside = prim->ops->inside;
    part.data = prim->data;
    part.place = prim->place->identity ? NULL : prim->place;
    part.near_answer = wanted != ((prim->flags & PRIM_INVERSE) != 0);
    if ((prim->flags & PRIM_PATCH) || part.inside == NULL) {
        part.box = bounds_empty();
        part.far_answer = !wanted;
    }
    return part;
}

typedef struct Finished { Items child; ARRAY(CsgPart) part; } Finished;

/* Children that have to be asked one by one go first, the others into a tree of boxes. Nodes that melted away are above
 * nothing any more. */
static void finish_node(Compile *c, uint32_t index, Finished *out)
{
    CsgNode *node = &c->csg.data[index];
    Items all = { 0 }, later = { 0 };
    gather(c, node, node, &all);
    bool tree = all.n > LISTED_MAX && !(node->flags & (CSG_CLIP | CSG_BOUND));
    node->first = out->child.n;
    node->n = all.n;
    for (uint32_t i = 0; i < all.n; i++) {
        set_parent(c, all.data[i], index);
        if (tree && i > 0 && is_selective(node->op, item_reach(c, all.data[i])))
            array_push(c->arena, &later, all.data[i]);
        else
            array_push(c->arena, &out->child, all.data[i]);
    }
    node->n_listed = all.n - later.n;
    if (later.n > 0) {
        Bounds *box = arena_array(c->arena, Bounds, later.n);
        for (uint32_t i = 0; i < later.n; i++) {
            array_push(c->arena, &out->child, later.data[i]);
            box[i] = item_reach(c, later.data[i]).box;
        }
        node->accel = c->w->accel_ops->build(c->arena, box, later.n);
    }
    for (uint32_t i = 0; i < all.n; i++)
        array_push(c->arena, &out->part, part_of(c, node, out->child.data[node->first + i]));
    for (uint32_t i = 0; i < all.n; i++)
        if (is_node(all.data[i]))
            finish_node(c, ~all.data[i], out);
}

/* Bodies that the accelerator does not find are known by the boxes of all their leaves. Nodes stand in c->body in their order:
 * *at is where the search for the last one ended. */
static bool is_body(const Compile *c, uint32_t node, uint32_t *at)
{
    while (*at < c->body.n && (!is_node(c->body.data[*at]) || ~c->body.data[*at] < node))
        ++*at;
    return *at < c->body.n && ~c->body.data[*at] == node;
}

void csg_finish(Compile *c)
{
    Finished out = { 0 };
    uint32_t body = 0;
    for (uint32_t k = 1; k < c->csg.n; k++)
        if (c->csg.data[k].parent == 0)
            finish_node(c, k, &out);
    c->csg_child.data = out.child.data;
    c->csg_child.n = out.child.n;
    c->csg_child.capacity = out.child.capacity;
    c->w->csg_part = out.part.data;
    for (uint32_t k = 1; k < c->csg.n; k++)    /* not before: the trees are over boxes as they are */
        if (c->csg.data[k].parent == 0)
            cut_item(c, ~k, bounds_everything(), bounds_everything(), !is_body(c, k, &body));
}
