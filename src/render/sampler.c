/* sampler.c - see sampler.h. */
#include "render/sampler.h"

#include "texture/texture.h"
#include "world/fan.h"
#include "world/shaft.h"

/* Kept apart, so that plain rays need not make room for what others do. */
#define ALONE __attribute__((noinline))

static const Colour NOTHING = { 0, 0, 0, 0, 1 };       /* where no ray goes */

static const Bounds NOWHERE = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

/* Where rays start that are not odd: with focal blur within the aperture, for orthographic cameras on the picture and some pixels
 * around it. Everywhere there the bodies are mostly those around the location, so that not each ray need ask. */
static Bounds home_of(const Sampling *s)
{
    const CameraDef *def = s->camera.def;
    double unit = s->world->unit;
    Vec3 eye = scaled(def->location, unit), half;
    if (s->mesh != NULL)
        return NOWHERE;
    if (s->blur != NULL) {
        double reach = def->aperture * (0.5 + 2 * s->blur->jitter) * unit;
        half = vec3(reach, reach, reach);
    } else if (def->kind == CAMERA_ORTHOGRAPHIC) {
        double u = (0.5 + 4 / s->camera.width) * unit, v = (0.5 + 4 / s->camera.height) * unit;
        Vec3 right = scaled(def->right, u), up = scaled(def->up, v);
        half = vec3(fabs(right.x) + fabs(up.x), fabs(right.y) + fabs(up.y), fabs(right.z) + fabs(up.z));
    } else {
        return NOWHERE;
    }
    Bounds home = { sub(eye, half), add(eye, half) };
    return world_same_bodies(s->world, eye, home) ? home : NOWHERE;
}

/* Places within the pixel, cells of 16 x 16, each jittered. POV: the jitter is biased towards the upper left. */
static const Vec2 *blur_cells(Arena *arena, const PositionHash *h)
{
    Vec2 *cell = arena_array(arena, Vec2, 16 * 16);
    for (int i = 0; i < 16 * 16; i++) {
        double x = (2 * (i % 16) + 1) / 32.0 - 0.5, y = (2 * (i / 16) + 1) / 32.0 - 0.5;
        Vec2 j = position_jitter(h, x, y);
        cell[i] = (Vec2){ x + (j.u - 0.5) / 16, y + (j.v - 0.5) / 16 };
    }
    return cell;
}

Sampling *sampling_new(Arena *arena, const World *w, const RenderOptions *options)
{
    Sampling *s = arena_new(arena, Sampling);
    s->world = w;
    s->tracing = tracing_new(arena, w, options->quality, options->output_alpha);
    s->camera = camera_new(&w->camera, options->width, options->height);
    s->mesh = mesh_camera_new(arena, w, options->width, options->height);
    s->blur = blur_new(arena, &w->camera);
    s->moves = camera_moves(&w->camera);
    s->home = s->moves ? home_of(s) : NOWHERE;
    bool strays = s->blur == NULL && w->globals.radiosity.on;      /* passes of radiosity look beyond the picture */
    if (s->home.lo.x <= s->home.hi.x && !strays)
        s->moves = false;
    bool plain = s->blur == NULL && w->camera.normal == NULL;
    s->pinhole = w->camera.kind == CAMERA_PERSPECTIVE && plain;
    s->parallel = w->camera.kind == CAMERA_ORTHOGRAPHIC && plain;
    s->across = normalized(cross(w->camera.up, w->camera.direction));
    s->down = normalized(cross(w->camera.direction, s->across));
    s->focus = w->camera.focal_distance / length(w->camera.direction);
    s->radius = w->camera.aperture / 2;
    if (s->blur != NULL || (options->antialias != 0 && options->jitter > 0))
        position_hash_fill(&s->hash);
    if (s->blur != NULL)
        s->blur_cell = blur_cells(arena, &s->hash);
    return s;
}

void sampler_init(Sampler *s, Arena *arena, const Sampling *sampling, Radiosity *radiosity)
{
    Vec3 eye = scaled(sampling->camera.def->location, sampling->world->unit);
    s->sampling = sampling;
    s->tracer = tracer_new(arena, sampling->tracing, radiosity);
    s->ray = tracer_eye(s->tracer);
    *s->ray = (Ray){ eye, sampling->camera.direction, 0, INFINITY };
    tracer_interiors(s->tracer, eye, &s->at_home);
}

void sampler_free(Sampler *s)
{
    tracer_free(s->tracer);
}

bool sampler_took_chances(const Sampler *s)
{
    return tracer_took_chances(s->tracer);
}

/* The ray starts at a place in world space; its direction is written already. */
static inline Colour look_from(Sampler *s, Vec3 from)
{
    const Sampling *all = s->sampling;
    const Interiors *around = &s->at_home;
    s->ray->o = from;
    if (all->moves && !bounds_contain(all->home, s->ray->o)) {
        tracer_interiors(s->tracer, s->ray->o, &s->elsewhere);
        around = &s->elsewhere;
    }
    return tracer_look(s->tracer, around);
}

static inline Colour shoot(Sampler *s, const CameraRay *ray)
{
    Vec3 d = normalized(ray->d);
    const Normal *normal = s->sampling->camera.def->normal;
    if (normal != NULL)
        d = normalized(normal_perturb(normal, vec3(ray->work.u, ray->work.v, 0), d, NULL));
    s->ray->d = d;
    return look_from(s, scaled(ray->o, s->sampling->world->unit));
}

/* ---- focal blur ---- */

typedef double Quad __attribute__((vector_size(32)));      /* red, green, blue, transmit */
typedef struct Moments { Quad sum, square; } Moments;

/* The fourth is transmit: filter is 0. */
static inline Rgb four_of(Colour c)
{
    return (Rgb){ c.r, c.g, c.b, c.t };
}

static inline void moments_add(Moments *m, Rgb c)
{
    Quad v = __builtin_convertvector(c, Quad);
    m->sum += v;
    m->square += v * v;
}

static bool moments_settled(const Moments *m, uint32_t n, double threshold)
{
    typedef int64_t Answers __attribute__((vector_size(32)));
    Quad mean = m->sum / (double)n, spread = (m->square / (double)n - mean * mean) / (double)n;
    Answers below = spread < threshold;        /* not so where it is NaN */
    return (below[0] & below[1] & below[2] & below[3]) != 0;
}

/* Where a sample lies, from the middle of the pixel. */
static inline Vec2 blur_within(const Sampling *all, int seed, uint32_t m)
{
    const uint16_t *hash = all->hash.permutation;
    uint32_t at = (uint32_t)seed + m, row = hash[(at + 1) % HASH_SIZE] % 16, column = hash[at % HASH_SIZE] % 16;
    return all->blur_cell[16 * row + column];
}

/* Where on the aperture its ray starts: across and down. POV: all rays start near the location, those of orthographic cameras too. */
static inline Vec2 blur_start(const Sampling *all, double x, double y, uint32_t m)
{
    const Blur *blur = all->blur;
    Vec2 k = position_jitter(&all->hash, x + 0.5, y - 0.5);
    return (Vec2){ all->radius * (blur->place[m].u + 2 * blur->jitter * k.u), all->radius * (blur->place[m].v + 2 * blur->jitter * k.v) };
}

/* False: nothing is seen there. */
ALONE static bool blur_bent(Sampler *s, double x, double y, uint32_t m, Colour *out)
{
    const Sampling *all = s->sampling;
    CameraRay ray;
    if (!camera_ray(&all->camera, x, y, &ray))
        return false;
    Vec2 start = blur_start(all, x, y, m);
    Vec3 e = sub(scaled(all->across, start.u), scaled(all->down, start.v));
    ray.o = add(all->camera.def->location, e);
    ray.d = sub(scaled(ray.d, all->focus), e);
    *out = shoot(s, &ray);
    return true;
}

/* Four rays. */
typedef struct Aim { double o[3][FAN_RAYS], d[3][FAN_RAYS]; } Aim;

/* a + u b + v c, as camera_blend has it. */
static inline Vec3s blends(Vec3 a, Vec3 b, d4 u, Vec3 c, d4 v)
{
    return vec3s_add(vec3s_add(vec3s_set(a), vec3s_scaled(vec3s_set(b), u)), vec3s_scaled(vec3s_set(c), v));
}

/* As normalized() has it. */
static inline Vec3s unit_vectors(Vec3s d)
{
    d4 n = d4_sqrt(vec3s_dot(d, d)), inverse = d4_div(d4_set(1), n);
    if (d4_lt(d4_set(0), n) != FAN_ALL) {      /* some is the zero vector, and stays it */
        double length[4], by[4];
        d4_store(length, n);
        for (int i = 0; i < 4; i++)
            by[i] = length[i] > 0 ? 1 / length[i] : 1;
        inverse = d4_load(by);
    }
    return vec3s_scaled(d, inverse);
}

static inline d4 four_at(const double *x)      /* stored one by one: not to be read at once */
{
    return d4_of(x[0], x[1], x[2], x[3]);
}

/* Of samples m ... m + 3, as blur_bent has them, through a perspective camera without a normal. */
static void blur_aim(const Sampling *all, double x, double y, int seed, uint32_t m, Aim *out)
{
    const CameraDef *def = all->camera.def;
    double px[FAN_RAYS], py[FAN_RAYS], across[FAN_RAYS], down[FAN_RAYS];
    for (uint32_t i = 0; i < FAN_RAYS; i++) {
        uint32_t k = m + i < all->blur->n ? m + i : m;
        Vec2 within = blur_within(all, seed, k);
        px[i] = x + within.u;
        py[i] = y + within.v;
        Vec2 start = blur_start(all, px[i], py[i], k);
        across[i] = start.u;
        down[i] = start.v;
    }
    d4 half = d4_set(0.5);
    d4 u = d4_sub(d4_div(d4_add(four_at(px), half), d4_set(all->camera.width)), half);
    d4 v = d4_sub(half, d4_div(d4_add(four_at(py), half), d4_set(all->camera.height)));
    Vec3s d = blends(def->direction, def->right, u, def->up, v);
    Vec3s e = vec3s_sub(vec3s_scaled(vec3s_set(all->across), four_at(across)), vec3s_scaled(vec3s_set(all->down), four_at(down)));
    Vec3s o = vec3s_scaled(vec3s_add(vec3s_set(def->location), e), d4_set(all->world->unit));
    d = unit_vectors(vec3s_sub(vec3s_scaled(d, d4_set(all->focus)), e));
    d4_store(out->o[0], o.x), d4_store(out->o[1], o.y), d4_store(out->o[2], o.z);
    d4_store(out->d[0], d.x), d4_store(out->d[1], d.y), d4_store(out->d[2], d.z);
}

static inline Colour look_aimed(Sampler *s, const Aim *aim, uint32_t i)
{
    s->ray->d = vec3(aim->d[0][i], aim->d[1][i], aim->d[2][i]);
    return look_from(s, vec3(aim->o[0][i], aim->o[1][i], aim->o[2][i]));
}

ALONE static Colour blurred(Sampler *s, double x, double y)
{
    const Sampling *all = s->sampling;
    const Blur *blur = all->blur;
    bool bends = all->camera.def->kind != CAMERA_PERSPECTIVE || all->camera.def->normal != NULL;
    Aim aim;
    int seed = (int)(313 * x + 11) + (int)(311 * y + 17);
    Moments moments = { { 0 }, { 0 } };
    Rgb sum = rgb_grey(0);
    const uint8_t *chunk = blur->chunk;
    uint32_t m = 0;
    while (m < blur->n) {
        uint32_t end = m + (*chunk != 0 ? *chunk++ : 4);
        for (; m < end && m < blur->n; m++) {
            Colour c;
            if (bends) {
                Vec2 within = blur_within(all, seed, m);
                if (!blur_bent(s, x + within.u, y + within.v, m, &c)) {
                    moments_add(&moments, four_of(NOTHING));
                    continue;
                }
            } else {
                if (m % FAN_RAYS == 0)
                    blur_aim(all, x, y, seed, m, &aim);
                c = look_aimed(s, &aim, m % FAN_RAYS);
            }
            sum = rgb_add(sum, four_of(c));
            moments_add(&moments, four_of(c));
        }
        if (m >= blur->n_min && moments_settled(&moments, m, blur->threshold[m]))
            break;
    }
    sum = rgb_scaled(sum, 1 / (float)m);
    return colour_of(sum, 0, sum[3]);
}

/* ---- mesh cameras ---- */

ALONE static Colour through_mesh(Sampler *s, double x, double y)
{
    const MeshCamera *mesh = s->sampling->mesh;
    Colour sum = { 0, 0, 0, 0, 0 };
    float n = 0;
    for (int k = 0; k < mesh_camera_rays(mesh); k++) {
        CameraRay ray;
        if (!mesh_camera_ray(mesh, x, y, k, &ray, &s->ray->t_max))
            continue;
        sum = colour_add(sum, shoot(s, &ray));
        n++;
    }
    return n > 0 ? colour_scaled(sum, 1 / n) : NOTHING;
}

ALONE static Colour bent(Sampler *s, double x, double y)
{
    CameraRay ray;
    return camera_ray(&s->sampling->camera, x, y, &ray) ? shoot(s, &ray) : NOTHING;
}

/* For the plainest cameras half of the ray is written once and for all: where it starts, or where it leads. */
Colour sampler_colour(Sampler *s, double x, double y)
{
    const Sampling *all = s->sampling;
    const Camera *camera = &all->camera;
    if (all->pinhole) {
        Vec2 at = camera_place(camera, x, y);
        s->ray->d = normalized(camera_direction(camera, at.u, at.v));
        return tracer_look(s->tracer, &s->at_home);
    }
    if (all->parallel) {
        Vec2 at = camera_place(camera, x, y);
        return look_from(s, scaled(camera_parallel_origin(camera, at.u, at.v), all->world->unit));
    }
    if (all->mesh != NULL)
        return through_mesh(s, x, y);
    return all->blur != NULL ? blurred(s, x, y) : bent(s, x, y);
}

/* ---- rows ---- */

void sampler_row(Sampler *s, double x, double y, int n)
{
    const Sampling *all = s->sampling;
    const Camera *camera = &all->camera;
    const CameraDef *def = camera->def;
    s->row_x = x;
    s->row_y = y;
    if (!all->pinhole && !all->parallel)
        return;
    d4 v = d4_set(camera_place(camera, x, y).v);
    for (int i = 0; i < n; i += 4) {
        d4 at = d4_add(d4_of(0.5, 1.5, 2.5, 3.5), d4_set(x + i));
        d4 u = d4_sub(d4_div(at, d4_set(camera->width)), d4_set(0.5));
        Vec3s differ = all->pinhole ? unit_vectors(blends(def->direction, def->right, u, def->up, v))
                                    : vec3s_scaled(blends(def->location, def->right, u, def->up, v), d4_set(all->world->unit));
        d4_store(&s->row[0][i], differ.x);
        d4_store(&s->row[1][i], differ.y);
        d4_store(&s->row[2][i], differ.z);
    }
}

Colour sampler_in_other_row(Sampler *s, int i)
{
    if (s->sampling->parallel)
        return look_from(s, vec3(s->row[0][i], s->row[1][i], s->row[2][i]));
    return sampler_colour(s, s->row_x + i, s->row_y);
}
