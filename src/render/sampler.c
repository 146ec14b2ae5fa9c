/* sampler.c - see sampler.h. */
#include "render/sampler.h"

#include "texture/texture.h"
#include "world/shaft.h"

/* Kept apart, so that plain rays need not make room for what others do. */
#define ALONE __attribute__((noinline))
#define INLINE inline __attribute__((always_inline))

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
    s->parallel = w->camera.kind == CAMERA_ORTHOGRAPHIC && s->blur == NULL && w->camera.normal == NULL;
    s->across = normalized(cross(w->camera.up, w->camera.direction));
    s->down = normalized(cross(w->camera.direction, s->across));
    s->focus = w->camera.focal_distance / length(w->camera.direction);
    s->radius = w->camera.aperture / 2;
    position_hash_fill(&s->hash);
    if (s->blur != NULL)
        s->blur_cell = blur_cells(arena, &s->hash);
    return s;
}

void sampler_init(Sampler *s, Arena *arena, const Sampling *sampling, Radiosity *radiosity)
{
    s->sampling = sampling;
    s->tracer = tracer_new(arena, sampling->tracing, radiosity);
    tracer_interiors(s->tracer, scaled(sampling->camera.def->location, sampling->world->unit), &s->at_home);
}

void sampler_free(Sampler *s)
{
    tracer_free(s->tracer);
}

bool sampler_took_chances(const Sampler *s)
{
    return tracer_took_chances(s->tracer);
}

/* A ray in scene space, d of unit length. */
static inline Colour shoot_along(Sampler *s, Vec3 from, Vec3 d, double reach)
{
    const Sampling *all = s->sampling;
    Vec3 o = scaled(from, all->world->unit);
    const Interiors *around = &s->at_home;
    if (all->moves && !bounds_contain(all->home, o)) {
        tracer_interiors(s->tracer, o, &s->elsewhere);
        around = &s->elsewhere;
    }
    return tracer_camera_ray(s->tracer, o, d, reach, around);
}

INLINE static Colour shoot(Sampler *s, const CameraRay *ray, double reach)
{
    Vec3 d = normalized(ray->d);
    const Normal *normal = s->sampling->camera.def->normal;
    if (normal != NULL)
        d = normalized(normal_perturb(normal, vec3(ray->work.u, ray->work.v, 0), d, NULL));
    return shoot_along(s, ray->o, d, reach);
}

/* ---- focal blur ---- */

typedef struct Moments { double sum[4], square[4]; } Moments;  /* red, green, blue, transmit */

static void moments_add(Moments *m, Colour c)
{
    double v[4] = { (double)c.r, (double)c.g, (double)c.b, (double)c.t };
    for (int i = 0; i < 4; i++) {
        m->sum[i] += v[i];
        m->square[i] += v[i] * v[i];
    }
}

static bool moments_settled(const Moments *m, uint32_t n, double threshold)
{
    for (int i = 0; i < 4; i++) {
        double mean = m->sum[i] / n;
        if (!((m->square[i] / n - mean * mean) / n < threshold))
            return false;
    }
    return true;
}

/* POV: all rays start near the location, those of orthographic cameras too. */
static bool blur_ray(const Sampling *all, double x, double y, int seed, uint32_t m, CameraRay *ray)
{
    const Blur *blur = all->blur;
    const uint16_t *hash = all->hash.permutation;
    uint32_t at = (uint32_t)seed + m, row = hash[(at + 1) % HASH_SIZE] % 16, column = hash[at % HASH_SIZE] % 16;
    Vec2 within = all->blur_cell[16 * row + column];
    x += within.u;
    y += within.v;
    if (!camera_ray(&all->camera, x, y, ray))
        return false;
    Vec2 k = position_jitter(&all->hash, x + 0.5, y - 0.5);
    double ex = all->radius * (blur->place[m].u + 2 * blur->jitter * k.u);
    double ey = all->radius * (blur->place[m].v + 2 * blur->jitter * k.v);
    Vec3 e = sub(scaled(all->across, ex), scaled(all->down, ey));
    ray->o = add(all->camera.def->location, e);
    ray->d = sub(scaled(ray->d, all->focus), e);
    return true;
}

ALONE static Colour blurred(Sampler *s, double x, double y)
{
    const Blur *blur = s->sampling->blur;
    int seed = (int)(313 * x + 11) + (int)(311 * y + 17);
    Moments moments = { { 0 }, { 0 } };
    Colour sum = { 0, 0, 0, 0, 0 };
    const uint8_t *chunk = blur->chunk;
    uint32_t m = 0;
    while (m < blur->n) {
        uint32_t end = m + (*chunk != 0 ? *chunk++ : 4);
        for (; m < end && m < blur->n; m++) {
            CameraRay ray;
            if (blur_ray(s->sampling, x, y, seed, m, &ray)) {
                Colour c = shoot(s, &ray, INFINITY);
                sum = colour_add(sum, c);
                moments_add(&moments, c);
            } else {
                moments_add(&moments, NOTHING);
            }
        }
        if (m >= blur->n_min && moments_settled(&moments, m, blur->threshold[m]))
            break;
    }
    return colour_scaled(sum, 1 / (float)m);
}

/* ---- mesh cameras ---- */

ALONE static Colour through_mesh(Sampler *s, double x, double y)
{
    const MeshCamera *mesh = s->sampling->mesh;
    Colour sum = { 0, 0, 0, 0, 0 };
    float n = 0;
    for (int k = 0; k < mesh_camera_rays(mesh); k++) {
        CameraRay ray;
        double reach;
        if (!mesh_camera_ray(mesh, x, y, k, &ray, &reach))
            continue;
        sum = colour_add(sum, shoot(s, &ray, reach));
        n++;
    }
    return n > 0 ? colour_scaled(sum, 1 / n) : NOTHING;
}

Colour sampler_colour(Sampler *s, double x, double y)
{
    const Camera *camera = &s->sampling->camera;
    if (s->sampling->parallel) {
        Vec2 at = camera_place(camera, x, y);
        return shoot_along(s, camera_parallel_origin(camera, at.u, at.v), camera->direction, INFINITY);
    }
    if (s->sampling->mesh != NULL)
        return through_mesh(s, x, y);
    if (s->sampling->blur != NULL)
        return blurred(s, x, y);
    CameraRay ray;
    return camera_ray(camera, x, y, &ray) ? shoot(s, &ray, INFINITY) : NOTHING;
}
