/* mesh1.c - mesh { triangle { ... } smooth_triangle { ... } ... }: vertices, normals and uv vectors written over and over are
 * kept once, found by hashing. */
#include <string.h>

#include "sdl/block.h"
#include "shape/mesh.h"
#include "shape/shape.h"

/* Items of `size` bytes, each once. */
typedef struct Pool {
    unsigned char *data;
    uint32_t size, n, capacity, *slot, n_slots;            /* slot: index + 1, open addressing */
} Pool;

typedef ARRAY(Index3) Faces;

typedef struct Soup {
    Pool vertex, normal, uv;
    Faces face, face_normal, face_uv, face_texture;        /* the last three end where their last use was */
    ARRAY(ListedTexture) texture;
    bool zero_normal;
} Soup;

typedef struct Params {
    MeshParams mesh;                           /* first: all that is asked of it later */
    Soup *soup;                                /* while it is parsed */
} Params;

static uint32_t hash(const void *item, uint32_t size)
{
    uint64_t h = size;
    for (uint32_t i = 0; i < size; i += 4) {
        uint32_t word;
        memcpy(&word, (const unsigned char *)item + i, 4);
        h = (h ^ word) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
    }
    return (uint32_t)(h ^ h >> 32);
}

static uint32_t find(const Pool *pool, const void *item)
{
    uint32_t at = hash(item, pool->size) & (pool->n_slots - 1);
    while (pool->slot[at] && memcmp(pool->data + (size_t)(pool->slot[at] - 1) * pool->size, item, pool->size) != 0)
        at = (at + 1) & (pool->n_slots - 1);
    return at;
}

static uint32_t pool_index(Arena *a, Pool *pool, const void *item, uint32_t size)
{
    pool->size = size;
    if (pool->n == pool->capacity)
        pool->data = array_grow(a, pool->data, pool->n, &pool->capacity, size);
    if (pool->n >= pool->n_slots / 2) {
        pool->n_slots = pool->n_slots ? pool->n_slots * 4 : 64;
        pool->slot = arena_array(a, uint32_t, pool->n_slots);
        for (uint32_t i = 0; i < pool->n; i++)
            pool->slot[find(pool, pool->data + (size_t)i * size)] = i + 1;
    }
    uint32_t at = find(pool, item);
    if (pool->slot[at] == 0) {
        memcpy(pool->data + (size_t)pool->n * size, item, size);
        pool->slot[at] = ++pool->n;
    }
    return pool->slot[at] - 1;
}

static uint32_t texture_index(Arena *a, Soup *s, const Texture *t)
{
    for (uint32_t i = s->texture.n; i-- > 0;)
        if (s->texture.data[i].texture == t)
            return i;
    array_push(a, &s->texture, (ListedTexture){ .texture = t });
    return s->texture.n - 1;
}

/* Entry `at` of a list that may be shorter: missing ones are NONE. */
static void put(Arena *a, Faces *list, uint32_t at, Index3 item)
{
    while (list->n < at)
        array_push(a, list, (Index3){ { MESH_NONE, MESH_NONE, MESH_NONE } });
    array_push(a, list, item);
}

static const Texture *declared_texture(Parser *p)
{
    const Texture *t = parse_take_block(p, BLOCK_TEXTURE);
    if (t == NULL)
        parse_expected(p, "texture identifier");
    return t;
}

/* [uv_vectors a, b, c] [texture { Id } | texture_list { Id, Id, Id }] */
static void face_modifiers(Parser *p, Soup *s, uint32_t face)
{
    Arena *a = parse_arena(p);
    if (parse_accept(p, KW_UV_VECTORS)) {
        Index3 f;
        for (int k = 0; k < 3; k++) {
            parse_comma(p);
            Vec2 uv = parse_vec2(p);
            uv = (Vec2){ uv.u + 0.0, uv.v + 0.0 };
            f.v[k] = pool_index(a, &s->uv, &uv, sizeof uv);
        }
        parse_stray_comma(p);
        put(a, &s->face_uv, face, f);
    }
    if (parse_accept(p, KW_TEXTURE)) {
        parse_open(p);
        uint32_t t = texture_index(a, s, declared_texture(p));
        parse_close(p);
        put(a, &s->face_texture, face, (Index3){ { t, t, t } });
    } else if (parse_accept(p, KW_TEXTURE_LIST)) {
        Index3 f;
        parse_open(p);
        for (int k = 0; k < 3; k++) {
            f.v[k] = texture_index(a, s, declared_texture(p));
            parse_comma(p);
        }
        parse_close(p);
        put(a, &s->face_texture, face, f);
    }
}

static void drop_last(Faces *list, uint32_t face)
{
    if (list->n > face)
        list->n = face;
}

static void triangle(Parser *p, Params *to, bool smooth)
{
    Arena *a = parse_arena(p);
    Soup *s = to->soup;
    Vec3 at[3], n[3] = { { 0, 0, 0 } };
    uint32_t face = s->face.n;
    parse_open(p);
    for (int k = 0; k < 3; k++) {
        at[k] = k ? parse_next_vec3(p) : parse_vec3(p);
        if (smooth)
            n[k] = parse_next_vec3(p);
    }
    parse_stray_comma(p);
    face_modifiers(p, s, face);
    parse_close(p);
    Vec3 e = sub(at[0], at[1]), g = sub(at[2], at[1]);
    double unit = build_unit(fmax(max_abs(e), max_abs(g)));
    if (max_abs(cross(scaled(e, 1 / unit), scaled(g, 1 / unit))) == 0) {       /* POV: no message */
        drop_last(&s->face_uv, face);
        drop_last(&s->face_texture, face);
        return;
    }
    Index3 f, fn;
    for (int k = 0; k < 3; k++) {
        Float3 v = mesh_vertex(p, &to->mesh, at[k]);
        f.v[k] = pool_index(a, &s->vertex, &v, sizeof v);
        if (smooth) {
            bool zero;
            Float3 unit_normal = mesh_normal(n[k], &zero);
            fn.v[k] = pool_index(a, &s->normal, &unit_normal, sizeof unit_normal);
            if (zero && !s->zero_normal)
                parse_warn(p, "Normal vector in mesh cannot be zero - changing it to <1,0,0>.");
            s->zero_normal |= zero;
        }
    }
    array_push(a, &s->face, f);
    if (smooth)
        put(a, &s->face_normal, face, fn);
}

static Index3 *whole(Arena *a, Faces *list, uint32_t n)
{
    if (list->n == 0)
        return NULL;
    while (list->n < n)
        array_push(a, list, (Index3){ { MESH_NONE, MESH_NONE, MESH_NONE } });
    return list->data;
}

static void parse(Parser *p, void *params)
{
    Params *out = params;
    mesh_begin(&out->mesh);
    out->soup = arena_new(parse_arena(p), Soup);
}

static bool item(Parser *p, void *params)
{
    int kind = parse_peek(p);
    if (kind != KW_TRIANGLE && kind != KW_SMOOTH_TRIANGLE)
        return mesh_item(p, params);
    parse_skip(p);
    triangle(p, params, kind == KW_SMOOTH_TRIANGLE);
    return true;
}

static void finish(Parser *p, void *params)
{
    MeshParams *m = params;
    Arena *a = parse_arena(p);
    Soup *s = ((Params *)params)->soup;
    m->n_faces = s->face.n;
    if (m->n_faces == 0)
        parse_fail(p, "No triangles in triangle mesh.");
    m->vertex = (Float3 *)(void *)s->vertex.data;
    m->n_vertices = s->vertex.n;
    m->face = s->face.data;
    MeshMore *more = mesh_more(p, m);
    more->normal = (Float3 *)(void *)s->normal.data;
    more->uv = (Vec2 *)(void *)s->uv.data;
    more->texture = s->texture.data;
    more->n_normals = s->normal.n;
    more->n_uvs = s->uv.n;
    more->n_textures = s->texture.n;
    more->face_normal = whole(a, &s->face_normal, m->n_faces);
    more->face_uv = whole(a, &s->face_uv, m->n_faces);
    more->face_texture = whole(a, &s->face_texture, m->n_faces);
    mesh_ready(m);
}

const ShapeOps shape_mesh = {
    .keyword = "mesh", .params_size = sizeof(Params),
    .flags = SHAPE_PATCH | SHAPE_HAS_HIERARCHY | SHAPE_HAS_UV | SHAPE_SHARED | SHAPE_SMOOTH | SHAPE_HAS_TEXTURES, .parse = parse, .item = item,
    .finish = finish, .compile = mesh_compile, .hits = mesh_hits, .inside = mesh_inside, .surface = mesh_surface,
    .extent = mesh_extent,
};
