/* camera.c - camera { ... }: what is written is only recorded, then takes effect in a fixed order (03-camera, section 1).
 *
 * Before version 3.5 each item acted at once; both ways use the same few steps. */
#include "sdl/blocks.h"

static const double PARALLEL = 1e-10;          /* POV: below this in every component, a cross product is nothing */

CameraDef camera_default(void)
{
    return (CameraDef){
        .kind = CAMERA_PERSPECTIVE, .direction = { 0, 0, 1 }, .up = { 0, 1, 0 }, .right = { 1.33, 0, 0 },
        .sky = { 0, 1, 0 }, .look_at = { 0, 0, 1 }, .focal_point = { 0, 0, 1 }, .confidence = 0.9,
        .variance = 1.0 / 10000, .focal_distance = 1, .place = affine_identity(), .rays_per_pixel = 1,
    };
}

/* What the block has written, and what the steps leave for later ones. */
typedef struct Draft {
    CameraDef c;
    bool has_up, has_right, has_look_at, old;
    double reach;                              /* |direction| as focal_distance sees it; 0: not set */
} Draft;

/* ---- the steps ---- */

static void apply_angle(Draft *d)
{
    CameraDef *c = &d->c;
    if (!(c->angle > 0) || (c->kind != CAMERA_PERSPECTIVE && (d->old || c->kind != CAMERA_ORTHOGRAPHIC)))
        return;
    c->direction = normalized(c->direction);
    c->direction = scaled(c->direction, length(c->right) / (2 * tan(c->angle * PI / 360)));
    d->reach = length(c->direction);
}

static void apply_look_at(Parser *p, Draft *d)
{
    CameraDef *c = &d->c;
    double ld = length(c->direction), lu = length(c->up), lr = length(c->right);
    double hand = dot(cross(c->up, c->direction), c->right);
    Vec3 to = sub(c->look_at, c->location);
    double size = fmax(max_abs(c->look_at), max_abs(c->location));
    if (max_abs(to) <= 1e-15 * size || max_abs(to) == 0)
        parse_fail(p, "Camera location and look_at point must be different.");
    to = normalized(to);
    Vec3 right = cross(c->sky, to);
    double sky = max_abs(c->sky);
    if (max_abs(right) <= PARALLEL * sky) {
        parse_warn(p, "Camera is looking along its sky vector.");
        right = c->right;
    }
    right = normalized(right);
    c->up = scaled(cross(to, right), lu);
    c->direction = scaled(to, ld);
    c->right = scaled(right, hand > 0 ? lr : -lr);
    d->reach = ld;
}

static void apply_orthographic(Draft *d)
{
    CameraDef *c = &d->c;
    double far = length(sub(c->look_at, c->location)), near = length(c->direction);
    if (!(far > 0) || !(near > 0))
        return;
    c->right = scaled(c->right, far / near);
    c->up = scaled(c->up, far / near);
}

static void apply_focus(Draft *d)
{
    CameraDef *c = &d->c;
    c->focal_distance = c->has_focal_point ? length(sub(c->focal_point, c->location)) : d->reach;
    if (c->focal_distance == 0)
        c->focal_distance = 1;
}

static void apply_move(CameraDef *c, const Affine *m)
{
    c->location = affine_point(m, c->location);
    c->direction = affine_vector(m, c->direction);
    c->up = affine_vector(m, c->up);
    c->right = affine_vector(m, c->right);
    c->place = affine_then(c->place, *m);
}

static bool skewed(Vec3 a, Vec3 b)
{
    return fabs(dot(a, b)) > 1e-10 * fmax(1e-300, max_abs(a) * max_abs(b));
}

/* ---- the items ---- */

static void angle(Parser *p, Draft *d)
{
    CameraDef *c = &d->c;
    if (c->kind == CAMERA_ORTHOGRAPHIC && !parse_at_number(p)) {
        c->has_angle = true;
        return;
    }
    c->angle = parse_float(p);
    c->has_angle = true;
    if (c->angle < 0)
        parse_fail(p, "Negative viewing angle.");
    if ((c->kind == CAMERA_PERSPECTIVE || c->kind == CAMERA_ORTHOGRAPHIC) && c->angle >= 180)
        parse_fail(p, "Viewing angle has to be smaller than 180 degrees.");
    if (c->kind == CAMERA_SPHERICAL) {
        parse_comma(p);
        c->v_angle = parse_at_number(p) ? parse_float(p) : c->angle / 2;
        c->has_v_angle = true;
    }
}

static void blur_samples(Parser *p, CameraDef *c)
{
    int first = parse_int(p);
    parse_comma(p);
    c->blur_samples_min = 0;
    c->blur_samples = first;
    if (parse_at_number(p)) {
        c->blur_samples_min = first;
        c->blur_samples = parse_int(p);
        if (c->blur_samples_min <= 0)
            parse_fail(p, "Illegal number of focal blur samples.");
    }
    if (c->blur_samples <= 0)
        parse_fail(p, "Illegal number of focal blur samples.");
    if (c->blur_samples_min > c->blur_samples)
        parse_fail(p, "Focal blur samples minimum must not be larger than maximum.");
}

static bool lens_item(Parser *p, CameraDef *c, int keyword)
{
    double v;
    switch (keyword) {
    case KW_BLUR_SAMPLES: parse_skip(p); blur_samples(p, c); return true;
    case KW_APERTURE: parse_skip(p); c->aperture = parse_float(p); return true;
    case KW_CONFIDENCE:
        parse_skip(p);
        v = parse_float(p);
        if (v > 0 && v < 1)
            c->confidence = v;
        else
            parse_warn(p, "Illegal confidence value. Default is used.");
        return true;
    case KW_VARIANCE:
        parse_skip(p);
        v = parse_float(p);
        if (v >= 0 && v <= 1)
            c->variance = v;
        else
            parse_warn(p, "Illegal variance value. Default is used.");
        return true;
    case KW_BOKEH:
        parse_skip(p);
        block_open(p, "bokeh");
        if (parse_peek(p) != KW_PIGMENT)
            parse_expected(p, "pigment");
        c->bokeh = parse_pigment(p);
        block_close(p, "bokeh");
        return true;
    case KW_NORMAL: c->normal = parse_normal(p); return true;
    default: return false;
    }
}

static bool item(Parser *p, Draft *d, Affine *place)
{
    CameraDef *c = &d->c;
    Affine move;
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_LOCATION: parse_skip(p); c->location = parse_vec3(p); return true;
    case KW_DIRECTION: parse_skip(p); c->direction = parse_vec3(p); return true;
    case KW_UP: parse_skip(p); c->up = parse_vec3(p); d->has_up = true; return true;
    case KW_RIGHT: parse_skip(p); c->right = parse_vec3(p); d->has_right = true; return true;
    case KW_SKY: parse_skip(p); c->sky = parse_vec3(p); return true;
    case KW_ANGLE:
        parse_skip(p);
        angle(p, d);
        if (d->old)
            apply_angle(d);
        return true;
    case KW_LOOK_AT:
        parse_skip(p);
        c->look_at = parse_vec3(p);
        d->has_look_at = true;
        if (d->old)
            apply_look_at(p, d);
        return true;
    case KW_FOCAL_POINT:
        parse_skip(p);
        c->focal_point = parse_vec3(p);
        c->has_focal_point = true;
        if (d->old)
            apply_focus(d);
        return true;
    default:
        if (lens_item(p, c, keyword))
            return true;
        if (!parse_move(p, &move))
            return false;
        if (d->old)
            apply_move(c, &move);
        else
            *place = affine_then(*place, move);
        return true;
    }
}

/* ---- types ---- */

typedef ARRAY(const Object *) Objects;

static void mesh_camera(Parser *p, CameraDef *c)
{
    Objects mesh = { 0 };
    block_open(p, "mesh_camera");
    c->rays_per_pixel = parse_int(p);
    parse_comma(p);
    c->distribution = parse_int(p);
    parse_comma(p);
    if (parse_at_number(p))
        c->max_distance = parse_float(p);
    parse_comma(p);
    const Object *o;
    while ((o = parse_object(p)) != NULL) {
        array_push(parse_arena(p), &mesh, o);
        parse_comma(p);
    }
    c->smooth = parse_accept(p, KW_SMOOTH);
    block_close(p, "mesh_camera");
    if (mesh.n == 0)
        parse_fail(p, "mesh_camera needs a mesh.");
    if (c->rays_per_pixel < 1)
        parse_fail(p, "Illegal number of rays per pixel: %d.", c->rays_per_pixel);
    if (c->distribution < 0 || c->distribution > 3)
        parse_fail(p, "Illegal distribution method of mesh_camera: %d; there are 0 to 3.", c->distribution);
    if (c->distribution >= 2 && c->rays_per_pixel != 1)
        parse_fail(p, "Distribution methods 2 and 3 of mesh_camera need one ray per pixel.");
    if (c->distribution == 0 && (uint32_t)c->rays_per_pixel > mesh.n)
        parse_fail(p, "Distribution method 0 of mesh_camera needs a mesh for each ray.");
    if (c->smooth && c->distribution != 3)
        parse_fail(p, "'smooth' of mesh_camera needs distribution method 3.");
    c->mesh = mesh.data;
    c->n_mesh = mesh.n;
}

static const struct { int keyword; CameraKind kind; } kinds[] = {
    { KW_PERSPECTIVE, CAMERA_PERSPECTIVE }, { KW_ORTHOGRAPHIC, CAMERA_ORTHOGRAPHIC }, { KW_FISHEYE, CAMERA_FISHEYE },
    { KW_ULTRA_WIDE_ANGLE, CAMERA_ULTRA_WIDE_ANGLE }, { KW_OMNIMAX, CAMERA_OMNIMAX }, { KW_PANORAMIC, CAMERA_PANORAMIC },
    { KW_SPHERICAL, CAMERA_SPHERICAL }, { KW_CYLINDER, CAMERA_CYLINDER_1 }, { KW_MESH_CAMERA, CAMERA_MESH },
};

static bool type_word(Parser *p, CameraDef *c)
{
    int keyword = parse_peek(p);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (kinds[i].keyword != keyword)
            continue;
        parse_skip(p);
        c->kind = kinds[i].kind;
        if (keyword == KW_CYLINDER) {
            int n = parse_int(p);
            if (n < 1 || n > 4)
                parse_fail(p, "Invalid cylinder camera type, valid are types 1 to 4.");
            c->kind = (CameraKind)(CAMERA_CYLINDER_1 + n - 1);
        } else if (keyword == KW_MESH_CAMERA) {
            mesh_camera(p, c);
        }
        return true;
    }
    return false;
}

static void finish(Parser *p, Draft *d, const Affine *place)
{
    CameraDef *c = &d->c;
    if (!d->old) {
        apply_angle(d);
        if (d->has_look_at)
            apply_look_at(p, d);
        if (c->kind == CAMERA_ORTHOGRAPHIC && ((!d->has_up && !d->has_right) || c->has_angle))
            apply_orthographic(d);
        if (!c->has_angle && !d->has_look_at)
            d->reach = 1;
        if (d->reach == 0)
            d->reach = 1;
        apply_focus(d);
        if (!place->identity)
            apply_move(c, place);
    }
    if (skewed(c->right, c->up) || skewed(c->right, c->direction) || skewed(c->up, c->direction))
        parse_warn(p, "Camera vectors are not perpendicular. Making look_at the last statement may help.");
}

/* Up to version 3.4 the kinds may come anywhere and act at once. */
static CameraDef old_camera(Parser *p, Draft *d)
{
    Affine unused = affine_identity();
    for (;;) {
        CameraKind before = d->c.kind;
        if (type_word(p, &d->c)) {
            if (d->c.kind == CAMERA_ORTHOGRAPHIC && before != CAMERA_ORTHOGRAPHIC)
                apply_orthographic(d);
        } else if (!item(p, d, &unused)) {
            break;
        }
    }
    block_close(p, "camera");
    finish(p, d, &unused);
    return d->c;
}

static const char *modifier_of(CameraKind kind)
{
    static const char *const what[] = {
        [CAMERA_PERSPECTIVE] = "perspective camera modifier", [CAMERA_ORTHOGRAPHIC] = "orthographic camera modifier",
        [CAMERA_FISHEYE] = "fisheye camera modifier", [CAMERA_ULTRA_WIDE_ANGLE] = "ultra_wide_angle camera modifier",
        [CAMERA_OMNIMAX] = "omnimax camera modifier", [CAMERA_PANORAMIC] = "panoramic camera modifier",
        [CAMERA_SPHERICAL] = "spherical camera modifier", [CAMERA_CYLINDER_1] = "cylinder camera modifier",
        [CAMERA_CYLINDER_2] = "cylinder camera modifier", [CAMERA_CYLINDER_3] = "cylinder camera modifier",
        [CAMERA_CYLINDER_4] = "cylinder camera modifier", [CAMERA_MESH] = "mesh camera modifier",
    };
    return what[kind];
}

CameraDef camera_block(Parser *p)
{
    Blocks *b = parse_blocks(p);
    Affine place = affine_identity();
    Draft d = { .c = b->default_camera, .old = parse_version(p) < 350 };
    block_open(p, "camera");
    const CameraDef *known = parse_take_block(p, BLOCK_CAMERA);
    if (known != NULL)
        d.c = *known;
    else if (d.old && b->scene->has_camera)
        d.c = b->scene->camera;                /* POV: old cameras go on where the last one ended */
    if (d.old)
        return old_camera(p, &d);
    if (known != NULL) {
        Affine move;
        while (parse_move(p, &move))
            apply_move(&d.c, &move);
        block_close(p, "camera");
        return d.c;
    }
    while (type_word(p, &d.c))
        ;
    while (item(p, &d, &place))
        ;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (parse_peek(p) == kinds[i].keyword && kinds[i].kind != d.c.kind)
            parse_expected(p, modifier_of(d.c.kind));
    block_close(p, "camera");
    finish(p, &d, &place);
    return d.c;
}
