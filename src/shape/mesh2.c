/* mesh2.c - mesh2 { vertex_vectors { n, ... } ... face_indices { n, ... } ... }: the lists become arrays as they stand. */
#include "base/array.h"
#include "sdl/block.h"
#include "shape/mesh.h"
#include "shape/shape.h"

/* Lists say how long they are before they come; a list longer than this is believed only as it does. */
enum { BELIEVED = 1 << 22 };

static uint32_t list_length(Parser *p, const char *what)
{
    parse_open(p);
    int n = parse_int(p);
    if (n < 0)
        parse_fail(p, "%s: the number of items is negative", what);
    return (uint32_t)n;
}

/* Room for item i of n. */
static void *room(Parser *p, void *data, uint32_t *capacity, uint32_t i, uint32_t n, size_t size)
{
    if (i < *capacity)
        return data;
    if (i == 0) {
        *capacity = n < BELIEVED ? n : BELIEVED;
        return arena_alloc_array(parse_arena(p), *capacity, size);
    }
    return array_grow(parse_arena(p), data, i, capacity, size);
}

/* Exporters write a comma behind the last item too. */
static void list_end(Parser *p)
{
    parse_comma(p);
    parse_close(p);
}

static void vertex_vectors(Parser *p, MeshParams *m)
{
    uint32_t n = list_length(p, "vertex_vectors"), capacity = 0;
    if (m->vertex != NULL)
        parse_warn(p, "Duplicate vertex_vectors block; ignoring previous block.");
    m->unit = 0;
    for (uint32_t i = 0; i < n; i++) {
        m->vertex = room(p, m->vertex, &capacity, i, n, sizeof *m->vertex);
        m->vertex[i] = mesh_vertex(p, m, parse_next_vec3(p));
    }
    m->n_vertices = n;
    list_end(p);
}

static void normal_vectors(Parser *p, MeshMore *m)
{
    uint32_t n = list_length(p, "normal_vectors"), capacity = 0;
    if (m->normal != NULL)
        parse_warn(p, "Duplicate normal_vectors block; ignoring previous block.");
    bool warned = false;
    for (uint32_t i = 0; i < n; i++) {
        bool zero;
        m->normal = room(p, m->normal, &capacity, i, n, sizeof *m->normal);
        m->normal[i] = mesh_normal(parse_next_vec3(p), &zero);
        if (zero && !warned)
            parse_warn(p, "Normal vector in mesh2 cannot be zero - changing it to <1,0,0>.");
        warned |= zero;
    }
    m->n_normals = n;
    list_end(p);
}

static void uv_vectors(Parser *p, MeshMore *m)
{
    uint32_t n = list_length(p, "uv_vectors"), capacity = 0;
    if (m->uv != NULL)
        parse_warn(p, "Duplicate uv_vectors block; ignoring previous block.");
    for (uint32_t i = 0; i < n; i++) {
        m->uv = room(p, m->uv, &capacity, i, n, sizeof *m->uv);
        parse_comma(p);
        m->uv[i] = parse_vec2(p);
    }
    m->n_uvs = n;
    list_end(p);
}

static void texture_list(Parser *p, MeshMore *m)
{
    uint32_t n = list_length(p, "texture_list"), capacity = 0;
    ListedTexture *list = NULL;
    for (uint32_t i = 0; i < n; i++) {
        list = room(p, list, &capacity, i, n, sizeof *list);
        parse_comma(p);
        list[i] = parse_listed_texture(p);
    }
    m->texture = list;
    m->n_textures = n;
    list_end(p);
}

static uint32_t checked(Parser *p, double index, uint32_t n, const char *what)
{
    if (!(index > -1 && index < n))
        parse_fail(p, "Mesh %s index out of range.", what);
    return (uint32_t)index;
}

static Index3 indices(Parser *p, uint32_t n, const char *what)
{
    Vec3 v = parse_next_vec3(p);
    return (Index3){ { checked(p, v.x, n, what), checked(p, v.y, n, what), checked(p, v.z, n, what) } };
}

/* [, t [, t2 [, t3]]] behind a face. */
static Index3 face_textures(Parser *p, uint32_t n)
{
    Index3 t;
    t.v[0] = checked(p, parse_float(p), n, "texture");
    parse_comma(p);
    t.v[1] = t.v[2] = t.v[0];
    for (int k = 1; k < 3 && parse_peek(p) != TOK_LESS && parse_at_number(p); k++) {
        t.v[k] = checked(p, parse_float(p), n, "texture");
        parse_comma(p);
    }
    return t;
}

static void face_indices(Parser *p, MeshParams *m)
{
    uint32_t n = list_length(p, "face_indices"), n_textures = m->more->n_textures, capacity = 0, texture_capacity = 0;
    if (n == 0)
        parse_fail(p, "No faces in triangle mesh.");
    for (uint32_t i = 0; i < n; i++) {
        m->face = room(p, m->face, &capacity, i, n, sizeof *m->face);
        m->face[i] = indices(p, m->n_vertices, "face");
        if (n_textures == 0)
            continue;
        parse_comma(p);
        MeshMore *more = mesh_more(p, m);
        more->face_texture = room(p, more->face_texture, &texture_capacity, i, n, sizeof *more->face_texture);
        more->face_texture[i] = parse_peek(p) != TOK_LESS && parse_at_number(p)
                                    ? face_textures(p, n_textures)
                                    : (Index3){ { MESH_NONE, MESH_NONE, MESH_NONE } };
    }
    m->n_faces = n;
    list_end(p);
}

static void uv_indices(Parser *p, MeshMore *m, uint32_t n_faces)
{
    uint32_t n = list_length(p, "uv_indices"), capacity = 0;
    if (n != n_faces)
        parse_fail(p, "Number of uv indices must equal number of faces.");
    m->face_uv = NULL;
    for (uint32_t i = 0; i < n; i++) {
        m->face_uv = room(p, m->face_uv, &capacity, i, n, sizeof *m->face_uv);
        m->face_uv[i] = indices(p, m->n_uvs, "uv");
    }
    list_end(p);
}

static void normal_indices(Parser *p, MeshMore *m, uint32_t n_faces)
{
    uint32_t n = list_length(p, "normal_indices"), capacity = 0;
    if (n > n_faces)
        parse_fail(p, "Number of normal indices cannot be more than the number of faces.");
    m->face_normal = NULL;
    for (uint32_t i = 0; i < n_faces; i++) {   /* faces without are flat */
        m->face_normal = room(p, m->face_normal, &capacity, i, n_faces, sizeof *m->face_normal);
        m->face_normal[i] = i < n ? indices(p, m->n_normals, "normal") : (Index3){ { MESH_NONE, MESH_NONE, MESH_NONE } };
    }
    list_end(p);
}

/* False at anything else: nothing is taken. */
static bool list_before_faces(Parser *p, MeshParams *m)
{
    int keyword = parse_peek(p);
    if (keyword != KW_VERTEX_VECTORS && keyword != KW_NORMAL_VECTORS && keyword != KW_UV_VECTORS)
        return false;
    parse_skip(p);
    if (keyword == KW_VERTEX_VECTORS)
        vertex_vectors(p, m);
    else if (keyword == KW_NORMAL_VECTORS)
        normal_vectors(p, mesh_more(p, m));
    else
        uv_vectors(p, mesh_more(p, m));
    return true;
}

static bool list_behind_faces(Parser *p, MeshParams *m)
{
    int keyword = parse_peek(p);
    if (keyword != KW_UV_INDICES && keyword != KW_NORMAL_INDICES)
        return false;
    parse_skip(p);
    if (keyword == KW_UV_INDICES)
        uv_indices(p, mesh_more(p, m), m->n_faces);
    else
        normal_indices(p, mesh_more(p, m), m->n_faces);
    return true;
}

/* Indices that were left out. */
static void share_indices(Parser *p, MeshParams *m)
{
    MeshMore *more = mesh_more(p, m);
    if (more->n_uvs > 0 && more->face_uv == NULL) {
        if (more->n_uvs == m->n_vertices)
            more->face_uv = m->face;
        else if (more->n_uvs == 1)
            more->face_uv = arena_array(parse_arena(p), Index3, m->n_faces);
        else
            parse_fail(p, "Missing uv_indices section in mesh2.");
    }
    if (more->n_normals > 0 && more->face_normal == NULL) {
        if (more->n_normals != m->n_vertices)
            parse_fail(p, "Missing normal_indices section in mesh2.");
        more->face_normal = m->face;
    }
}

static void parse(Parser *p, void *params)
{
    MeshParams *m = params;
    mesh_begin(m);
    while (list_before_faces(p, m))
        ;
    if (m->n_vertices == 0)
        parse_fail(p, "No vertices in triangle mesh.");
    if (parse_accept(p, KW_TEXTURE_LIST))
        texture_list(p, mesh_more(p, m));
    parse_expect(p, KW_FACE_INDICES);
    face_indices(p, m);
    while (list_behind_faces(p, m))
        ;
    if (m->more->n_uvs > 0 || m->more->n_normals > 0)
        share_indices(p, m);
    mesh_ready(m);
}

const ShapeOps shape_mesh2 = {
    .keyword = "mesh2", .params_size = sizeof(MeshParams),
    .flags = SHAPE_PATCH | SHAPE_HAS_HIERARCHY | SHAPE_HAS_UV | SHAPE_SHARED | SHAPE_SMOOTH | SHAPE_HAS_TEXTURES, .parse = parse, .item = mesh_item,
    .compile = mesh_compile, .hits = mesh_hits, .inside = mesh_inside, .surface = mesh_surface, .extent = mesh_extent,
};
