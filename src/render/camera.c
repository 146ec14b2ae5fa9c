/* camera.c - see camera.h. All in scene space: some cameras compare lengths with 1. */
#include "render/camera.h"

static double radians(double degrees)
{
    return degrees * (PI / 180);
}

Camera camera_new(const CameraDef *def, int width, int height)
{
    Camera c = { .def = def, .width = width, .height = height, .right = normalized(def->right), .up = normalized(def->up),
                 .direction = normalized(def->direction), .right_length = length(def->right), .up_length = length(def->up) };
    double h = def->angle, v = def->v_angle;
    if (def->kind == CAMERA_SPHERICAL) {
        h = def->has_angle ? h : 360;
        v = def->has_v_angle ? v : h / 2;
    } else if (!def->has_angle) {
        h = 90;
    }
    c.angle = radians(h);
    c.v_angle = radians(v);
    return c;
}

bool camera_moves(const CameraDef *def)
{
    return def->kind == CAMERA_ORTHOGRAPHIC || def->kind == CAMERA_CYLINDER_3 || def->kind == CAMERA_CYLINDER_4 ||
           def->kind == CAMERA_MESH || (def->aperture != 0 && def->blur_samples > 0);
}

/* Turned about a unit axis; about up, a positive angle carries direction towards right. */
static Vec3 turned(Vec3 v, Vec3 axis, double angle)
{
    return camera_blend(v, cos(angle), cross(axis, v), sin(angle), axis, dot(axis, v) * (1 - cos(angle)));
}

/* POV: from -90 degrees to 270; only camera normals see the difference. */
static double angle_around(double p, double q, double r)
{
    if (r == 0)
        return 0;
    double a = asin(fmin(1, fmax(-1, q / r)));
    return p < 0 ? PI - a : a;
}

/* theta off the view axis, phi around it. */
static Vec3 off_axis(const Camera *c, double phi, double theta)
{
    return camera_blend(c->right, cos(phi) * sin(theta), c->up, sin(phi) * sin(theta), c->direction, cos(theta));
}

static bool fisheye(const Camera *c, double u, double v, CameraRay *out)
{
    double p = 2 * u * c->right_length, q = 2 * v * c->up_length;
    double r = sqrt(p * p + q * q);
    if (r > 1)
        return false;
    out->work = (Vec2){ angle_around(p, q, r), r * c->angle / 2 };
    out->d = off_axis(c, out->work.u, out->work.v);
    return true;
}

/* The lens of a dome theatre's projector: a polynomial in the distance from the centre, cut below the floor. */
static bool omnimax(const Camera *c, double u, double v, CameraRay *out)
{
    double p = 2 * u, q = 2 * v;
    const double k = 1.283458;
    double s = c->right_length / c->up_length;
    if (s > k) {
        p *= s / k;
        q = (q - 1) / k + 1;
    } else if (s > 1) {
        q = (q - 1) / s + 1;
    } else {
        q /= s;
    }
    double r = sqrt(p * p + q * q);
    if (r > 1)
        return false;
    double phi = angle_around(p, q, r);
    double theta = 1.411269 * r - 0.09439 * r * r * r + 0.25674 * r * r * r * r * r;
    out->work = (Vec2){ phi, theta };
    out->d = off_axis(c, phi, theta);
    return sin(phi) * sin(theta) >= -cos(theta);
}

static void panoramic(const Camera *c, double u, double v, CameraRay *out)
{
    double a = PI * (0.5 - u), b = PI * v;
    double steep = fabs(PI / 2 - fabs(b)) < 1e-10 ? (b > 0 ? 2e10 : -2e10) : tan(b);
    out->work = (Vec2){ a, b };
    out->d = camera_blend(c->def->right, cos(a), c->def->up, steep, c->def->direction, sin(a));
}

static void cylindrical(const Camera *c, double u, double v, CameraRay *out)
{
    CameraKind kind = c->def->kind;
    bool upright = kind == CAMERA_CYLINDER_1 || kind == CAMERA_CYLINDER_3;
    double angle = (upright ? u : v) * c->angle;
    double along = upright ? v * c->up_length : u * c->right_length;
    Vec3 axis = upright ? c->up : c->right;
    Vec3 around = upright ? c->right : c->up;
    out->work = upright ? (Vec2){ angle, along } : (Vec2){ along, angle };
    out->d = add(scaled(around, sin(angle)), scaled(c->direction, cos(angle)));
    if (kind == CAMERA_CYLINDER_1 || kind == CAMERA_CYLINDER_2)
        out->d = add(out->d, scaled(axis, along));
    else
        out->o = add(out->o, scaled(axis, along));
}

bool camera_bent_ray(const Camera *c, double u, double v, CameraRay *out)
{
    const CameraDef *def = c->def;
    switch (def->kind) {
    case CAMERA_ORTHOGRAPHIC:
        out->o = camera_parallel_origin(c, u, v);
        out->d = def->direction;
        return true;
    case CAMERA_FISHEYE:
        return fisheye(c, u, v, out);
    case CAMERA_ULTRA_WIDE_ANGLE:
        out->work = (Vec2){ u * c->angle, v * c->angle * c->up_length / c->right_length };
        out->d = camera_blend(c->right, sin(out->work.u), c->up, sin(out->work.v), c->direction, cos(out->work.u) * cos(out->work.v));
        return true;
    case CAMERA_OMNIMAX:
        return omnimax(c, u, v, out);
    case CAMERA_PANORAMIC:
        panoramic(c, u, v, out);
        return true;
    case CAMERA_SPHERICAL:
        out->work = (Vec2){ u * c->angle, v * c->v_angle };
        out->d = turned(turned(def->direction, c->right, -out->work.v), c->up, out->work.u);
        return true;
    case CAMERA_CYLINDER_1:
    case CAMERA_CYLINDER_2:
    case CAMERA_CYLINDER_3:
    case CAMERA_CYLINDER_4:
        cylindrical(c, u, v, out);
        return true;
    case CAMERA_PERSPECTIVE:
    case CAMERA_MESH:
        break;
    }
    return false;
}
