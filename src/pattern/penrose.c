/* penrose.c - Penrose's tilings by deflation: the plane is shrunk until the point lies in one tile at the origin, then the tile
 * is divided again and again, following the part with the point (06-noise-and-patterns, section 7.1). */
#include "pattern/penrose.h"

#include <stdbool.h>

#include "math/vec.h"

static const double GOLDEN = 1.61803398874989484820;
static const double APART = 1e-6;              /* keeps the values of different classes of tiles apart */

static double degrees(double a) { return a * PI / 180; }
static double sine(double a) { return sin(degrees(a)); }
static double cosine(double a) { return cos(degrees(a)); }
static double tangent(double a) { return tan(degrees(a)); }

typedef struct Point { double x, z; } Point;

static Point turned(Point p, double angle)
{
    double c = cosine(angle), s = sine(angle);
    return (Point){ p.x * c - p.z * s, p.x * s + p.z * c };
}

static Point moved(Point p, double x, double z)
{
    return (Point){ p.x + x, p.z + z };
}

static Point upper(Point p)
{
    return (Point){ p.x, fabs(p.z) };
}

/* Into the tenth of the plane about the positive x axis. */
static Point folded(Point p)
{
    p = upper(p);
    double r = sqrt(p.x * p.x + p.z * p.z);
    if (p.x < r * cosine(36))
        p = turned(p, p.x < r * cosine(108) ? -144 : -72);
    return upper(p);
}

/* Distance to the line through (x0, 0) at this angle. */
static double line(Point p, double angle, double x0)
{
    return fabs(sine(angle) * (p.x - x0) - cosine(angle) * p.z);
}

static double low(double d1, double d2)
{
    return fmin(fmax(fmax(0.5 - d1 / 2, 0.5 - d2 / 2), 0), 0.5 - APART);
}

static double high(double d1, double d2)
{
    return fmax(fmax(1 - d1 / 2, 1 - d2 / 2), 0.5 + APART);
}

static double two_tiles_value(int number, bool dart, Point p)
{
    if (number == 26)
        return dart ? high(4.46 * p.z, 4.46 * line(p, 144, 1)) : low(4.46 * line(p, 36, 0), 4.46 * line(p, 108, 1));
    if (dart)
        return low(5.55 * line(p, 36, 0), 5.55 * line(p, 144, 1));
    if (p.z < (p.x - 1 / GOLDEN) * tangent(72))
        return high(5.55 * line(p, 72, 1 / GOLDEN), 5.55 * line(p, 108, 1));
    return low(5.55 * p.z, 5.55 * line(p, 72, 1 / GOLDEN));
}

static int depth_of(double size, double base)
{
    double n = ceil(log(size) / log(base));
    return n > 0 && n < 1000 ? (int)n : 0;
}

/* Kites and darts (26), rhombs (27). */
static double two_tiles(int number, Point p)
{
    p = folded(p);
    if (number == 27)
        p = (Point){ p.x / GOLDEN, p.z / GOLDEN };
    int n = depth_of(line(p, 108, 0) / cosine(18), GOLDEN * GOLDEN);
    double shrink = pow(GOLDEN, -2.0 * n);
    p = (Point){ p.x * shrink, p.z * shrink };
    if (n % 2)
        p = turned(p, -36);
    bool dart = false;
    for (int k = 2 * n; ; k--) {
        p = upper(p);
        if (k == 0)
            return two_tiles_value(number, dart, p);
        if (!dart) {
            if (p.z < (p.x - 1 / GOLDEN) * tangent(144))
                dart = true;
            else
                p = turned(moved(p, -cosine(36), -sine(36)), 108);
        } else if (p.z < (p.x - 1 / GOLDEN) * tangent(108)) {
            p = turned(p, -36);
            dart = false;
        } else {
            p = turned(moved(p, -1, 0), -144);
        }
        p = (Point){ p.x * GOLDEN, p.z * GOLDEN };
    }
}

/* The states of the tiling of pentagons, stars, boats and diamonds; `flag` is what the text calls q, g or the kind b. */
typedef enum State { P1, P2, P3, STAR, BOAT, DIAMOND } State;

typedef struct Pentagon { State state; bool flag; Point p; } Pentagon;

static double pentagon_edge(double c, double d)
{
    return (c + 1) / 6 - d / 6;
}

static double pentagon_clip(double c, double v)
{
    return fmin(fmax(v, c == 0 ? 0 : c / 6 + APART), (c + 1) / 6 - APART);
}

static double pentagon_value(const Pentagon *s)
{
    const double R = 1 / (2 * sine(36)), A = 1 / (2 * tangent(36)), w = 5.55 / GOLDEN;
    Point p = s->p;
    switch (s->state) {
    case P1: case P2: case P3: {
        double c = s->state;
        p = folded(p);
        return pentagon_clip(c, pentagon_edge(c, w * fabs(p.x - A)));
    }
    case STAR: return pentagon_clip(3, pentagon_edge(3, w * line(p, 162, GOLDEN * R)));
    case BOAT: {
        double d1 = w * fabs(p.x - R * cosine(72) / GOLDEN);
        double d2 = w * line(folded((Point){ -p.x, p.z }), 162, GOLDEN * R);
        return pentagon_clip(4, fmax(pentagon_edge(4, d1), pentagon_edge(4, d2)));
    }
    case DIAMOND: break;
    }
    return pentagon_clip(5, pentagon_edge(5, w * line(p, 18, -R / GOLDEN)));
}

static Pentagon to(State state, bool flag, double x, double z)
{
    return (Pentagon){ state, flag, { x, z } };
}

static Pentagon to_point(State state, bool flag, Point p)
{
    return (Pentagon){ state, flag, p };
}

static Pentagon divided(Pentagon s)
{
    const double R = 1 / (2 * sine(36)), A = 1 / (2 * tangent(36)), f = GOLDEN;
    Point p = s.p;
    switch (s.state) {
    case P1:
        p = folded(p);
        if (p.z < (p.x - A) * tangent(54) + 0.5)
            return to(P2, false, p.x - A - R * cosine(72) / f, p.z);
        return to_point(STAR, false, turned(p, -36));
    case P2:
        if (s.flag) {
            if (p.z < (p.x - R / (f * f)) * tangent(54))
                return to(P1, false, p.x - R, p.z);
            if (p.z < (p.x - R / (f * f)) * tangent(162))
                return to(DIAMOND, false, -p.x, p.z);
            p = turned(p, 108);
            return to(P2, true, p.x + R / f, p.z);
        }
        if (p.z < (p.x + R) * tangent(18))
            return to(DIAMOND, true, p.x + R - R / (f * f), p.z);
        p = turned(p, -36);
        return to(P3, false, -p.x - R * cosine(72), p.z - R * sine(72));
    case P3:
        if (s.flag) {
            if (p.x > R * cosine(72) / (f * f))
                return to(P2, true, -(p.x - R * cosine(72) / (f * f) - A / f), p.z);
        } else if (p.x < R * cosine(108)) {
            p = turned(p, -144);
            return to(P2, false, p.x - R, p.z);
        } else if (p.z > (p.x - R / (f * f)) * tangent(126)) {
            p = turned(p, 36);
            return to(P3, false, -p.x - R * cosine(72), p.z - R * sine(72));
        }
        return to_point(BOAT, s.flag, p);
    case STAR:
        return p.x < A / f ? to_point(P1, false, p) : to(P3, true, -(p.x - 2 * A / f), p.z);
    case BOAT:
        if (s.flag && p.x > f * R * cosine(108))
            return to(P1, false, -p.x, p.z);
        if (!s.flag)
            p = turned(p, 72);
        return to(P3, true, p.x + R, p.z);
    case DIAMOND: break;
    }
    return to_point(s.flag ? P3 : P1, s.flag, p);
}

static double pentagons(Point p)
{
    p = folded(p);
    int n = depth_of(2 * p.x * tangent(36), pow(GOLDEN, 4));
    double shrink = pow(GOLDEN, -4.0 * n);
    Pentagon s = to(P1, false, p.x * shrink, p.z * shrink);
    for (int k = 4 * n; ; k--) {
        s.p = upper(s.p);
        if (k == 0)
            return pentagon_value(&s);
        s = divided(s);
        s.p = (Point){ s.p.x * GOLDEN, s.p.z * GOLDEN };
    }
}

double penrose_value(int number, double x, double z)
{
    if (!(sqrt(x * x + z * z) > 1e-10) || !isfinite(x * z))
        return 1;
    return number == 25 ? pentagons((Point){ x, z }) : two_tiles(number, (Point){ x, z });
}
