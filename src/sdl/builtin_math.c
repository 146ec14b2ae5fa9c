/* builtin_math.c - functions of numbers and vectors in expressions (01-language, sections 6 to 8). */
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

#include "image/image.h"
#include "math/noise.h"
#include "scene/image_map.h"
#include "sdl/parser.h"

#define DEGREE (PI / 180)

static void set(Num *out, double v)
{
    out->v[0] = v;
    out->terms = 1;
}

static void set_vec3(Num *out, Vec3 v)
{
    out->v[0] = v.x;
    out->v[1] = v.y;
    out->v[2] = v.z;
    out->terms = 3;
}

/* Truncated toward zero; what does not fit, and NaN, becomes the smallest. */
static int32_t int32(double v)
{
    return v > -2147483649.0 && v < 2147483648.0 ? (int32_t)v : INT32_MIN;
}

/* One argument: the only kind that reads a full expression. */
static double one(Parser *p)
{
    parse_expect(p, TOK_LPAREN);
    double v = expr_full_float(p);
    parse_expect(p, TOK_RPAREN);
    return v;
}

static void floats(Parser *p, int n, double *out)
{
    parse_expect(p, TOK_LPAREN);
    for (int i = 0; i < n; i++) {
        out[i] = expr_float(p);
        if (i + 1 < n)
            parse_comma(p);
    }
    parse_expect(p, TOK_RPAREN);
}

static Vec3 vector(Parser *p)
{
    Num n;
    expr_sum(p, &n);
    return num_vec3(p, &n);
}

static double checked(Parser *p, Loc loc, bool fine, double v, const char *what)
{
    if (!fine)
        fail(p->diag, loc, "%s of negative number %f", what, v);
    return v;
}

/* asin and acos go on with the nearest value that has one. */
static double in_domain(Parser *p, Loc loc, double v, const char *name)
{
    if (fabs(v) > 1)
        warn(p->diag, loc, "Domain error in %s.", name);
    return v > 1 ? 1 : v < -1 ? -1 : v;
}

static bool of_one(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    double v;
    switch (keyword) {
    case KW_ABS: v = fabs(one(p)); break;
    case KW_ACOS: v = acos(in_domain(p, loc, one(p), "acos")); break;
    case KW_ACOSH: v = acosh(one(p)); break;
    case KW_ASIN: v = asin(in_domain(p, loc, one(p), "asin")); break;
    case KW_ASINH: v = asinh(one(p)); break;
    case KW_ATAN: v = atan(one(p)); break;
    case KW_ATANH: v = atanh(one(p)); break;
    case KW_CEIL: v = ceil(one(p)); break;
    case KW_COS: v = cos(one(p)); break;
    case KW_COSH: v = cosh(one(p)); break;
    case KW_DEGREES: v = one(p) / DEGREE; break;
    case KW_EXP: v = exp(one(p)); break;
    case KW_FLOOR: v = floor(one(p)); break;
    case KW_INT: v = int32(one(p)); break;
    case KW_LN: v = one(p); v = log(checked(p, loc, !(v <= 0), v, "ln")); break;
    case KW_LOG: v = one(p); v = log10(checked(p, loc, !(v <= 0), v, "log")); break;
    case KW_RADIANS: v = one(p) * DEGREE; break;
    case KW_SIN: v = sin(one(p)); break;
    case KW_SINH: v = sinh(one(p)); break;
    case KW_SQRT: v = one(p); v = sqrt(checked(p, loc, !(v < 0), v, "sqrt")); break;
    case KW_TAN: v = tan(one(p)); break;
    case KW_TANH: v = tanh(one(p)); break;
    default: return false;
    }
    set(out, v);
    return true;
}

/* min, max, bitwise_*: one argument or more. */
static double of_many(Parser *p, int keyword)
{
    parse_expect(p, TOK_LPAREN);
    double v = expr_float(p);
    bool bits = keyword != KW_MIN && keyword != KW_MAX;
    int32_t b = bits ? int32(v) : 0;
    while (!parse_accept(p, TOK_RPAREN)) {
        if (!parse_accept(p, TOK_COMMA))
            parse_mend(p, "A comma is missing");
        double w = expr_float(p);
        switch (keyword) {
        case KW_MIN: v = w < v ? w : v; break;
        case KW_MAX: v = w > v ? w : v; break;
        case KW_BITWISE_AND: b &= int32(w); break;
        case KW_BITWISE_OR: b |= int32(w); break;
        default: b ^= int32(w); break;
        }
    }
    return bits ? b : v;
}

static double select_of(Parser *p)
{
    double v[4];
    parse_expect(p, TOK_LPAREN);
    for (int i = 0; i < 3; i++) {
        v[i] = expr_float(p);
        parse_comma(p);
    }
    bool four = parse_peek(p) != TOK_RPAREN;
    v[3] = four ? expr_float(p) : v[2];
    parse_expect(p, TOK_RPAREN);
    return v[0] < 0 ? v[1] : v[0] == 0 ? v[2] : v[3];
}

/* Numbers from a stream, made by seed, numbered from 0. */
static double random_of(Parser *p, Loc loc)
{
    double k = one(p);
    if (!(k >= 0 && k < p->random.n))
        fail(p->diag, loc, "Illegal random number generator.");
    return random_next(&p->random.data[(uint32_t)k]);
}

static double seed_of(Parser *p)
{
    double v = one(p);
    array_push(p->arena, &p->random, (uint32_t)int32(v));
    return p->random.n - 1;
}

/* Days since 2000-01-01, UTC. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return ((double)t.tv_sec - 946684800.0 + (double)t.tv_nsec * 1e-9) / 86400;
}

static ValueArray *array_argument(Parser *p)
{
    parse_peek(p);
    if (p->token.kind != TOK_NAME || !p->value || p->value->kind != VALUE_ARRAY)
        parse_expected(p, "array identifier");
    p->have = false;
    return p->value->array;
}

static const Object *object_argument(Parser *p)
{
    const Object *o = parse_take_block(p, BLOCK_OBJECT);
    if (!o)
        fail(p->diag, parse_loc(p), "Object identifier expected.");
    return o;
}

static double dimension_size(Parser *p)
{
    parse_expect(p, TOK_LPAREN);
    ValueArray a = *array_argument(p);
    parse_comma(p);
    double i = expr_float(p);
    parse_expect(p, TOK_RPAREN);
    return i >= 1 && i <= a.n_dimensions ? a.size[(int)i - 1] : 0;
}

static double dimensions(Parser *p)
{
    parse_expect(p, TOK_LPAREN);
    double n = array_argument(p)->n_dimensions;
    parse_expect(p, TOK_RPAREN);
    return n;
}

static double inside(Parser *p, Loc loc)
{
    parse_expect(p, TOK_LPAREN);
    const Object *o = object_argument(p);
    parse_comma(p);
    Vec3 at = vector(p);
    parse_expect(p, TOK_RPAREN);
    if (o->kind == OBJECT_LIGHT || (o->kind == OBJECT_SHAPE && (o->ops->flags & SHAPE_PATCH)))
        fail(p->diag, loc, "Solid object identifier expected.");
    return p->host->inside(p->host->user, o, at);
}

static bool of_several(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    double v[2];
    switch (keyword) {
    case KW_ATAN2:
        floats(p, 2, v);
        if (v[0] == 0 && v[1] == 0)
            fail(p->diag, loc, "Domain error in atan2!");
        set(out, atan2(v[0], v[1]));
        return true;
    case KW_DIV:
        floats(p, 2, v);
        set(out, int32(v[0] / v[1]));
        return true;
    case KW_MOD:
        floats(p, 2, v);
        set(out, fmod(v[0], v[1]));
        return true;
    case KW_POW:
        floats(p, 2, v);
        if (v[0] == 0 && v[1] == 0)
            fail(p->diag, loc, "Domain error.");
        set(out, pow(v[0], v[1]));
        return true;
    case KW_MIN: case KW_MAX: case KW_BITWISE_AND: case KW_BITWISE_OR: case KW_BITWISE_XOR:
        set(out, of_many(p, keyword));
        return true;
    case KW_SELECT: set(out, select_of(p)); return true;
    case KW_RAND: set(out, random_of(p, loc)); return true;
    case KW_SEED: set(out, seed_of(p)); return true;
    case KW_NOW: set(out, now()); return true;
    case KW_DEFINED: set(out, flow_is_defined(p)); return true;
    case KW_DIMENSIONS: set(out, dimensions(p)); return true;
    case KW_DIMENSION_SIZE: set(out, dimension_size(p)); return true;
    case KW_INSIDE: set(out, inside(p, loc)); return true;
    case KW_VLENGTH:
        parse_expect(p, TOK_LPAREN);
        set(out, length(vector(p)));
        parse_expect(p, TOK_RPAREN);
        return true;
    default: return false;
    }
}

static Vec3 rotated(Vec3 v, Vec3 degrees)
{
    double c = cos(degrees.x * DEGREE), s = sin(degrees.x * DEGREE);
    v = vec3(v.x, v.y * c - v.z * s, v.y * s + v.z * c);
    c = cos(degrees.y * DEGREE);
    s = sin(degrees.y * DEGREE);
    v = vec3(v.x * c + v.z * s, v.y, -v.x * s + v.z * c);
    c = cos(degrees.z * DEGREE);
    s = sin(degrees.z * DEGREE);
    return vec3(v.x * c - v.y * s, v.x * s + v.y * c, v.z);
}

static Vec3 axis_rotated(Vec3 v, Vec3 axis, double degrees)
{
    double n = length(axis), a = degrees * DEGREE, c = cos(a), s = sin(a);
    Vec3 u = vec3(axis.x / n, axis.y / n, axis.z / n);         /* a zero axis gives NaN */
    double p = u.x, q = u.y, r = u.z;
    return vec3(v.x * (p * p + c * (1 - p * p)) + v.y * (p * q * (1 - c) - r * s) + v.z * (p * r * (1 - c) + q * s),
                v.x * (p * q * (1 - c) + r * s) + v.y * (q * q + c * (1 - q * q)) + v.z * (q * r * (1 - c) - p * s),
                v.x * (p * r * (1 - c) - q * s) + v.y * (q * r * (1 - c) + p * s) + v.z * (r * r + c * (1 - r * r)));
}

/* POV: lambda and omega are kept in single precision. */
static Vec3 turbulence(Parser *p)
{
    double lambda = (double)(float)expr_float(p);
    parse_comma(p);
    double omega = (double)(float)expr_float(p);
    parse_comma(p);
    int octaves = int32(expr_float(p));
    parse_comma(p);
    Vec3 at = vector(p);
    return noise_vector_turbulence(at, octaves < 1 ? 1 : octaves > 10 ? 10 : octaves, omega, lambda);
}

/* trace(Object, from, direction [, N]): N is a vector that exists and takes the normal. */
static Vec3 trace(Parser *p)
{
    const Object *o = object_argument(p);
    parse_comma(p);
    Vec3 from = vector(p);
    parse_comma(p);
    Vec3 direction = normalized(vector(p));
    Value *target = NULL;
    if (parse_accept(p, TOK_COMMA)) {
        parse_peek(p);
        target = p->token.kind == TOK_NAME ? p->value : NULL;
        if (!target || target->kind != VALUE_NUMBER || target->terms != 3)
            parse_expected(p, "vector identifier");
        p->have = false;
    }
    Vec3 point = vec3(0, 0, 0), normal = vec3(0, 0, 0);
    if (!p->host->trace(p->host->user, o, from, direction, &point, &normal))
        point = normal = vec3(0, 0, 0);
    if (target)
        value_set_number(p, target, &(Num){ { normal.x, normal.y, normal.z }, 3 });
    return point;
}

static Vec3 extent(Parser *p, bool max)
{
    const Pigment *pigment = parse_take_block(p, BLOCK_PIGMENT);
    if (pigment) {
        if (!max || pigment->kind != PIGMENT_IMAGE)
            fail(p->diag, parse_loc(p), "A pigment parameter to %s_extent must be one image_map.", max ? "max" : "min");
        return vec3(pigment->image->image->width, pigment->image->image->height, 0);
    }
    Bounds b = p->host->extent(p->host->user, object_argument(p));
    return max ? b.hi : b.lo;
}

static Vec3 of_vectors(Parser *p, int keyword, Loc loc)
{
    if (keyword == KW_VTURBULENCE)
        return turbulence(p);
    if (keyword == KW_TRACE)
        return trace(p);
    if (keyword == KW_MIN_EXTENT || keyword == KW_MAX_EXTENT)
        return extent(p, keyword == KW_MAX_EXTENT);
    Vec3 a = vector(p);
    if (keyword == KW_VNORMALIZE) {
        if (length2(a) == 0)
            warn(p->diag, loc, "Normalizing zero-length vector.");
        return normalized(a);
    }
    parse_comma(p);
    Vec3 b = vector(p);
    if (keyword == KW_VCROSS)
        return cross(a, b);
    if (keyword == KW_VROTATE)
        return rotated(a, b);
    parse_comma(p);
    return axis_rotated(a, b, expr_float(p));
}

bool builtin_number(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    if (of_one(p, keyword, out) || of_several(p, keyword, out))
        return true;
    switch (keyword) {
    case KW_VDOT: {
        parse_expect(p, TOK_LPAREN);
        Vec3 a = vector(p);
        parse_comma(p);
        set(out, dot(a, vector(p)));
        parse_expect(p, TOK_RPAREN);
        return true;
    }
    case KW_VTURBULENCE: case KW_TRACE: case KW_MIN_EXTENT: case KW_MAX_EXTENT: case KW_VNORMALIZE: case KW_VCROSS:
    case KW_VROTATE: case KW_VAXIS_ROTATE: {
        parse_expect(p, TOK_LPAREN);
        Vec3 v = of_vectors(p, keyword, loc);
        parse_expect(p, TOK_RPAREN);
        set_vec3(out, v);
        return true;
    }
    default: return false;
    }
}
