/* affine.c - elementary transforms and their composition (08-shapes, section 2). */
#include "math/affine.h"

#include <string.h>

Affine affine_identity(void)
{
    return (Affine){ .m = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, .inv = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
                     .identity = true };
}

Affine affine_translate(Vec3 by)
{
    Affine a = affine_identity();
    a.identity = by.x == 0 && by.y == 0 && by.z == 0;
    for (int i = 0; i < 3; i++) {
        a.m[3][i] = vec3_at(by, i);
        a.inv[3][i] = -vec3_at(by, i);
    }
    return a;
}

Affine affine_scale(Vec3 by)
{
    Affine a = affine_identity();
    a.identity = by.x == 1 && by.y == 1 && by.z == 1;
    for (int i = 0; i < 3; i++) {
        a.m[i][i] = vec3_at(by, i);
        a.inv[i][i] = 1 / vec3_at(by, i);
    }
    return a;
}

/* A rotation's inverse is its transpose. */
static Affine rotation(const double m[3][3])
{
    Affine a = affine_identity();
    a.identity = false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a.m[i][j] = m[i][j];
            a.inv[i][j] = m[j][i];
        }
    return a;
}

/* Quarter turns are exact: sin and cos of a multiple of 90 degrees are -1, 0 or 1. */
static void sin_cos_degrees(double degrees, double *s, double *c)
{
    double quarter = degrees / 90;
    if (quarter == floor(quarter) && fabs(quarter) < 1e15) {
        static const double sines[4] = { 0, 1, 0, -1 };
        int q = (int)(quarter - 4 * floor(quarter / 4));
        *s = sines[q & 3];
        *c = sines[(q + 1) & 3];
        return;
    }
    *s = sin(degrees * PI / 180);
    *c = cos(degrees * PI / 180);
}

Affine affine_rotate(Vec3 degrees)
{
    Affine all = affine_identity();
    double s, c;
    if (degrees.x != 0) {
        sin_cos_degrees(degrees.x, &s, &c);
        Affine r = rotation((const double[3][3]){ { 1, 0, 0 }, { 0, c, s }, { 0, -s, c } });
        all = affine_then(all, r);
    }
    if (degrees.y != 0) {
        sin_cos_degrees(degrees.y, &s, &c);
        Affine r = rotation((const double[3][3]){ { c, 0, -s }, { 0, 1, 0 }, { s, 0, c } });
        all = affine_then(all, r);
    }
    if (degrees.z != 0) {
        sin_cos_degrees(degrees.z, &s, &c);
        Affine r = rotation((const double[3][3]){ { c, s, 0 }, { -s, c, 0 }, { 0, 0, 1 } });
        all = affine_then(all, r);
    }
    return all;
}

static Vec3 row(const double m[4][3], int i)
{
    return vec3(m[i][0], m[i][1], m[i][2]);
}

Affine affine_matrix(const double rows[12])
{
    Affine a = { 0 };
    memcpy(a.m, rows, sizeof a.m);
    /* A vanishing column gets a 1 on the diagonal, relative to nothing: POV-Ray's rule, with zero for its 1e-10. */
    for (int j = 0; j < 3; j++)
        if (a.m[0][j] == 0 && a.m[1][j] == 0 && a.m[2][j] == 0)
            a.m[j][j] = 1;
    Vec3 r0 = row(a.m, 0), r1 = row(a.m, 1), r2 = row(a.m, 2);
    Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
    double det = dot(r0, c0);
    if (det == 0 || !isfinite(det))
        det = 1;
    for (int i = 0; i < 3; i++) {
        a.inv[i][0] = vec3_at(c0, i) / det;
        a.inv[i][1] = vec3_at(c1, i) / det;
        a.inv[i][2] = vec3_at(c2, i) / det;
    }
    Vec3 back = affine_apply_linear(a.inv, row(a.m, 3));
    a.inv[3][0] = -back.x;
    a.inv[3][1] = -back.y;
    a.inv[3][2] = -back.z;
    Affine unit = affine_identity();
    a.identity = memcmp(a.m, unit.m, sizeof a.m) == 0;
    return a;
}

Affine affine_frame(Vec3 origin, Vec3 axis, double radius, double length_)
{
    Vec3 a = normalized(axis);
    Affine scale = affine_scale(vec3(radius, radius, length_));
    /* Turn z onto a about (-a.y, a.x, 0); for a near +-z that axis vanishes, and x serves. */
    double sine = sqrt(a.x * a.x + a.y * a.y);
    Vec3 about = sine > 0 ? vec3(-a.y / sine, a.x / sine, 0) : vec3(1, 0, 0);
    Affine turn = affine_identity();
    if (sine > 0 || a.z < 0) {
        double k = 1 - a.z, c = a.z;
        turn = rotation((const double[3][3]){ { about.x * about.x * k + c, about.x * about.y * k, -about.y * sine },
                                              { about.x * about.y * k, about.y * about.y * k + c, about.x * sine },
                                              { about.y * sine, -about.x * sine, c } });
    }
    return affine_then(affine_then(scale, turn), affine_translate(origin));
}

typedef double Pair __attribute__((vector_size(16)));
typedef double PairInMemory __attribute__((vector_size(16), aligned(8), may_alias));

/* Two columns are lanes, the third stands alone. Rows but the last add 0, which turns -0 into 0. */
static void compose(double out[4][3], const double a[4][3], const double b[4][3])
{
    Pair xy[5] = { [4] = { 0 } };
    double z[5] = { [4] = 0 };
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        xy[i] = *(const PairInMemory *)b[i];
        z[i] = b[i][2];
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        int last = i == 3 ? 3 : 4;
        *(PairInMemory *)out[i] = a[i][0] * xy[0] + a[i][1] * xy[1] + a[i][2] * xy[2] + xy[last];
        out[i][2] = a[i][0] * z[0] + a[i][1] * z[1] + a[i][2] * z[2] + z[last];
    }
}

static bool is_unit(const double m[4][3])
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            if (m[i][j] != (i == j))
                return false;
    return true;
}

Affine affine_then(Affine first, Affine second)
{
    if (first.identity)
        return second;
    if (second.identity)
        return first;
    Affine a = { .identity = false };
    compose(a.m, first.m, second.m);
    compose(a.inv, second.inv, first.inv);
    a.identity = is_unit(a.m) && is_unit(a.inv);       /* a scale and its undoing meet often: units of shapes and of the World */
    return a;
}

Affine affine_inverse(Affine a)
{
    Affine out = { .identity = a.identity };
    memcpy(out.m, a.inv, sizeof out.m);
    memcpy(out.inv, a.m, sizeof out.inv);
    return out;
}
