/* builtin_math.c - functions of numbers and vectors in expressions (01-language, sections 6 to 8). */
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

#include "image/image.h"
#include "math/noise.h"
#include "scene/image_map.h"
#include "sdl/blocks.h"
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

/* Functions of one float. False if it is none, or one that has something to say about this argument. */
bool math_of_one(int keyword, double v, double *out)
{
    switch (keyword) {
    case KW_ABS: *out = fabs(v); return true;
    case KW_ACOS: *out = acos(v); return !(fabs(v) > 1);
    case KW_ACOSH: *out = acosh(v); return true;
    case KW_ASIN: *out = asin(v); return !(fabs(v) > 1);
    case KW_ASINH: *out = asinh(v); return true;
    case KW_ATAN: *out = atan(v); return true;
    case KW_ATANH: *out = atanh(v); return true;
    case KW_CEIL: *out = ceil(v); return true;
    case KW_COS: *out = cos(v); return true;
    case KW_COSH: *out = cosh(v); return true;
    case KW_DEGREES: *out = v / DEGREE; return true;
    case KW_EXP: *out = exp(v); return true;
    case KW_FLOOR: *out = floor(v); return true;
    case KW_INT: *out = int32(v); return true;
    case KW_LN: *out = log(v); return !(v <= 0);
    case KW_LOG: *out = log10(v); return !(v <= 0);
    case KW_RADIANS: *out = v * DEGREE; return true;
    case KW_SIN: *out = sin(v); return true;
    case KW_SINH: *out = sinh(v); return true;
    case KW_SQRT: *out = sqrt(v); return !(v < 0);
    case KW_TAN: *out = tan(v); return true;
    case KW_TANH: *out = tanh(v); return true;
    default: return false;
    }
}

static bool is_of_one(int keyword)
{
    switch (keyword) {
    case KW_ABS: case KW_ACOS: case KW_ACOSH: case KW_ASIN: case KW_ASINH: case KW_ATAN: case KW_ATANH: case KW_CEIL:
    case KW_COS: case KW_COSH: case KW_DEGREES: case KW_EXP: case KW_FLOOR: case KW_INT: case KW_LN: case KW_LOG:
    case KW_RADIANS: case KW_SIN: case KW_SINH: case KW_SQRT: case KW_TAN: case KW_TANH:
        return true;
    default:
        return false;
    }
}

/* asin and acos go on with the nearest value that has one. */
static double out_of_domain(Parser *p, Loc loc, int keyword, double v)
{
    static const char fails[] = "%s of negative number %f";
    switch (keyword) {
    case KW_ACOS: warn(p->diag, loc, "Domain error in acos."); return acos(v > 1 ? 1 : -1);
    case KW_ASIN: warn(p->diag, loc, "Domain error in asin."); return asin(v > 1 ? 1 : -1);
    case KW_LN: fail(p->diag, loc, fails, "ln", v);
    case KW_LOG: fail(p->diag, loc, fails, "log", v);
    default: fail(p->diag, loc, fails, "sqrt", v);
    }
}

static double of_one(Parser *p, int keyword)
{
    Loc loc = p->token.loc;
    double v = one(p), out;
    return math_of_one(keyword, v, &out) ? out : out_of_domain(p, loc, keyword, v);
}

/* The same of two floats. */
bool math_of_two(int keyword, double a, double b, double *out)
{
    switch (keyword) {
    case KW_ATAN2: *out = atan2(a, b); return !(a == 0 && b == 0);
    case KW_DIV: *out = int32(a / b); return true;
    case KW_MOD: *out = fmod(a, b); return true;
    case KW_POW: *out = pow(a, b); return !(a == 0 && b == 0);
    case KW_MIN: *out = b < a ? b : a; return true;
    case KW_MAX: *out = b > a ? b : a; return true;
    default: return false;
    }
}

/* min, max, bitwise_*: one argument or more. */
static double of_many(Parser *p, int keyword)
{
    parse_expect(p, TOK_LPAREN);
    double v = expr_float(p);
    bool bits = keyword != KW_MIN && keyword != KW_MAX;
    int32_t b = bits ? int32(v) : 0;
    while (!parse_accept(p, TOK_RPAREN)) {
        parse_due_comma(p);
        double w = expr_float(p);
        switch (keyword) {
        case KW_MIN: case KW_MAX: math_of_two(keyword, v, w, &v); break;
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
    if (object_is_patch(o))
        fail(p->diag, loc, "Solid object identifier expected.");
    return p->host->inside(p->host->user, o, at);
}

static double of_two(Parser *p, int keyword)
{
    Loc loc = p->token.loc;
    double v[2], out;
    floats(p, 2, v);
    if (!math_of_two(keyword, v[0], v[1], &out))
        fail(p->diag, loc, keyword == KW_ATAN2 ? "Domain error in atan2!" : "Domain error.");
    return out;
}

static bool of_several(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    switch (keyword) {
    case KW_ATAN2: case KW_DIV: case KW_MOD: case KW_POW: set(out, of_two(p, keyword)); return true;
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

/* Functions of vectors and, last, a float. False if it is none, or one that has something to say about its arguments. */
bool math_of_vectors(int keyword, Vec3 a, Vec3 b, double angle, Num *out)
{
    switch (keyword) {
    case KW_VLENGTH: set(out, length(a)); return true;
    case KW_VDOT: set(out, dot(a, b)); return true;
    case KW_VNORMALIZE: set_vec3(out, normalized(a)); return length2(a) != 0;
    case KW_VCROSS: set_vec3(out, cross(a, b)); return true;
    case KW_VROTATE: set_vec3(out, rotated(a, b)); return true;
    case KW_VAXIS_ROTATE: set_vec3(out, axis_rotated(a, b, angle)); return true;
    default: return false;
    }
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
    return noise_vector_turbulence(&at, octaves < 1 ? 1 : octaves > 10 ? 10 : octaves, omega, lambda);
}

/* Where a ray meets the object and the normal there; both 0 if it does not. */
Vec3 math_trace(Parser *p, const Object *o, Vec3 from, Vec3 direction, Vec3 *normal)
{
    Vec3 point = vec3(0, 0, 0);
    *normal = vec3(0, 0, 0);
    if (!p->host->trace(p->host->user, o, from, normalized(direction), &point, normal))
        point = *normal = vec3(0, 0, 0);
    return point;
}

/* trace(Object, from, direction [, N]): N is a vector that exists and takes the normal. */
static Vec3 trace(Parser *p)
{
    const Object *o = object_argument(p);
    parse_comma(p);
    Vec3 from = vector(p);
    parse_comma(p);
    Vec3 direction = vector(p);
    Value *target = NULL;
    if (parse_accept(p, TOK_COMMA)) {
        parse_peek(p);
        target = p->token.kind == TOK_NAME ? p->value : NULL;
        if (!target || target->kind != VALUE_NUMBER || target->terms != 3)
            parse_expected(p, "vector identifier");
        p->have = false;
    }
    Vec3 normal, point = math_trace(p, o, from, direction, &normal);
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

static void of_vectors(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    parse_expect(p, TOK_LPAREN);
    Vec3 a = vector(p), b = a;
    double angle = 0;
    if (keyword != KW_VLENGTH && keyword != KW_VNORMALIZE) {
        parse_comma(p);
        b = vector(p);
    }
    if (keyword == KW_VAXIS_ROTATE) {
        parse_comma(p);
        angle = expr_float(p);
    }
    if (!math_of_vectors(keyword, a, b, angle, out))
        warn(p->diag, loc, "Normalizing zero-length vector.");
    parse_expect(p, TOK_RPAREN);
}

bool builtin_number(Parser *p, int keyword, Num *out)
{
    if (is_of_one(keyword)) {
        set(out, of_one(p, keyword));
        return true;
    }
    switch (keyword) {
    case KW_VLENGTH: case KW_VDOT: case KW_VNORMALIZE: case KW_VCROSS: case KW_VROTATE: case KW_VAXIS_ROTATE:
        of_vectors(p, keyword, out);
        return true;
    case KW_VTURBULENCE: case KW_TRACE: case KW_MIN_EXTENT: case KW_MAX_EXTENT:
        parse_expect(p, TOK_LPAREN);
        set_vec3(out, keyword == KW_VTURBULENCE ? turbulence(p) : keyword == KW_TRACE ? trace(p) : extent(p, keyword == KW_MAX_EXTENT));
        parse_expect(p, TOK_RPAREN);
        return true;
    default:
        return of_several(p, keyword, out);
    }
}
