/* internal.c - the built-in functions f_* (01-language, section 18), written as formulas in a language of their own.
 *
 * A formula is read into a FuncBuilder as scenes are, so the built-in functions dissolve into their callers, run in lanes and have
 * ranges like any other. X, Y, Z, P0... are the parameters; `name = value;` names a value or gives a name a new one; the last
 * expression is the result. The few with loops are C (native.c). */
#include <assert.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "func/native.h"

typedef struct Formula {
    const char *name;
    int parameters;                            /* beyond x, y, z */
    const char *text;                          /* NULL: native */
    FuncNative *const *native;
} Formula;

#define AXIS "X = ifzero(X, ifzero(Z, 0.000001, X), X);"       /* POV: off the y axis, where angles have no value */
#define SQUARES "A = P1^2; B = P2^2;"
#define BELLS "e = exp(-P1*(P0*X^2+P0*Y^2+Z^2)); f = exp(-P1*(P0*X^2+Y^2+P0*Z^2)); g = exp(-P1*(X^2+P0*Y^2+P0*Z^2));"
#define HEXAGON                                                                                                        \
    "h = sqrt(3)/2; a = abs(mod(abs(X),sqrt(3))-h); b = abs(mod(abs(Y),3)-1.5);"                                        \
    "d = (h-a)^2+(1.5-b)^2-(a^2+b^2); e = ifneg(d,h-a,a); f = ifneg(d,1.5-b,b);"
#define CUSHION "c(P0*(Z^2*X^2-Z^4-2*Z*X^2+2*Z^3+X^2-Z^2-(X^2-Z)^2-Y^4-2*X^2*Y^2-Y^2*Z^2+2*Y^2*Z+Y^2))"
#define ROUND(u, v, how) "ifzero(" how "-1, sqrt(" u "^2+" v "^2), ifzero(" how ", max(abs(" u "),abs(" v ")), "

static const Formula formulas[] = {
    { "algbr_cyl1", 5, "R(2,3,4); X = abs(X); v = -P0*(X^3-X^2+Y^2); -min(max(v,-P1),P1)", NULL },
    { "algbr_cyl2", 5, "R(2,3,4); limit(-P0*(2*X^4-3*X^2*Y+Y^2-2*Y^3+Y^4),P1)", NULL },
    { "algbr_cyl3", 5, "R(2,3,4); limit(-P0*(X^4+X^2*Y^2-2*X^2*Y-X*Y^2+Y^2),P1)", NULL },
    { "algbr_cyl4", 5, "R(2,3,4); limit(-P0*(X^4+Y^4+2*X^2*Y^2+3*X^2*Y-Y^3),P1)", NULL },
    { "bicorn", 2, "A = P1^2; q = X^2+Z^2+2*P1*Y-A; c(P0*(Y^2*(A-X^2-Z^2)-q^2))", NULL },
    { "bifolia", 2, "c(-P0*(s^2-P1*(X^2+Z^2)*Y))", NULL },
    { "blob", 5, "h = P0/2; a = min(1,((X+h)^2+Y^2+Z^2)*P2^2); b = min(1,((X-h)^2+Y^2+Z^2)*P4^2); -(P1*(1-a)^2+P3*(1-b)^2)", NULL },
    { "blob2", 4, "P3-P2*(exp(-P1*s)+exp(-P1*((X-P0)^2+Y^2+Z^2)))", NULL },
    { "boy_surface", 2,
      "w = 1-Z; h = X^2+Y^2; r = sqrt(2); c(P0*P1*(64*w^3*Z^3-48*w^2*Z^2*(3*h+2*Z^2)"
      "+12*w*Z*(27*h^2-24*Z^2*h+36*r*Y*Z*(Y^2-3*X^2)+4*Z^4)+(9*h-2*Z^2)*(-81*h^2-72*Z^2*h+108*r*X*Z*(X^2-3*Y^2)+4*Z^4)))", NULL },
    { "comma", 1,
      "X = ifzero(X, ifzero(Z, 0.0001, X), X); r = sqrt((X+P0/4)^2+Z^2);"
      "t = min(Z, cos(atan2(Z,X)/2)*P0/2-sqrt((r-0.75*P0)^2+Y^2)); -max(t, P0/2-sqrt((X-P0/2)^2+Y^2+Z^2))", NULL },
    { "cross_ellipsoids", 4, BELLS "P3-P2*max(max(e,f),g)", NULL },
    { "crossed_trough", 1, "c(P0*(X^2*Z^2-Y))", NULL },
    { "cubic_saddle", 1, "c(-P0*(X^3-Y^3-Z))", NULL },
    { "cushion", 1, CUSHION, NULL },
    { "devils_curve", 1, "c(-P0*(X^4+2*X^2*Z^2-0.36*X^2-Y^4+0.25*Y^2+Z^4))", NULL },
    { "devils_curve_2d", 6, SQUARES "R(3,4,5); c(-P0*(X^2*(X^2-A)-Y^2*(Y^2-B)))", NULL },
    { "dupin_cyclid", 6,
      "g = P5^2; a = P2^2; b = P4^2; p = a-b-(P3+P1)^2; q = a-b-(P3-P1)^2;"
      "c(-P0*(p*q*s^2+2*g*((-b-P3^2+a+P1^2)*(2*P3*X+2*P4*Y-g)-4*P4*a*Y)*s"
      "+4*g^2*(P3*X+P4*Y)*(P3*X+P4*Y-g)+4*g^2*P1^2*Y^2+g^4))", NULL },
    { "ellipsoid", 3, "sqrt(P0^2*X^2+P1^2*Y^2+P2^2*Z^2)", NULL },
    { "enneper", 1,
      "q = Z^2; Z = ifneg(abs(Z)-0.2, 0.2, Z); a = (Y^2-X^2)/(2*Z)+2*q/9; b = (Y^2-X^2)/(4*Z); c(-P0*(a^3-6*b^2))", NULL },
    { "flange_cover", 4, BELLS "P3-P2*(e+f+g)", NULL },
    { "folium_surface", 3, "c(P0*((Y^2+Z^2)*(1+(P2-4*P1)*X)+X^2*(1+P2)))", NULL },
    { "folium_surface_2d", 6, "R(3,4,5); c(-P0*(Y^2*(1+(P2-4*P1)*X)+X^2*(1+P2)))", NULL },
    { "glob", 1, "c(P0*(0.5*X^5+0.5*X^4-Y^2-Z^2))", NULL },
    { "heart", 1, "u = 2*X^2+Y^2+Z^2-1; c(-P0*(u^3-0.1*X^2*Z^3-Y^2*Z^3))", NULL },
    { "helical_torus", 10,
      "w = sqrt(X^2+Z^2);" AXIS "p = atan2(X,Z); t = atan2(w-P0,Y); r = sqrt((w-P0)^2+Y^2); u = turn(p*P1+t*P2)-pi;"
      "k = cos(P7*atan2(u*P8,r-P5)+p*P9)*P3+P4; -max(P4+P5-P0-w, k-min(sqrt((r-P5)^2+u^2*P6),r+P5))", NULL },
    { "helix1", 7,
      "w = sqrt(X^2+Z^2);" AXIS "u = turn(P0*atan2(Z,X)+P0*P1*Y); Z = (u-pi)/P4/(P0*P1); X = w-P3; e = 2/P5;"
      "a = P6*pi/180; x = X*cos(a)-Z*sin(a); z = X*sin(a)+Z*cos(a);"
      "q = ifzero(P5-1, sqrt(X^2+Z^2), ifzero(P5, max(abs(x),abs(z)), pow(pow(abs(x),e)+pow(abs(z),e),P5/2))); min(P3+w,q)-P2",
      NULL },
    { "helix2", 7,
      "a = P1*Y; X = X-P3*cos(a); Z = Z-P3*sin(a); x = X*cos(a)+Z*sin(a); z = Z*cos(a)-X*sin(a); e = 2/P5;"
      ROUND("x", "z", "P5") "pow(pow(abs(x),e)+pow(abs(z),e),P5/2)))-P2", NULL },
    { "hex_x", 1, HEXAGON "ifneg(atan2(f,e)-pi/6, e, e/2+f*h)", NULL },
    { "hex_y", 1, HEXAGON "ifneg(atan2(f,e)-pi/6, f, abs(f/2-e*h))", NULL },
    { "hetero_mf", 6, NULL, &native_hetero_mf },
    { "hunt_surface", 1, "c(-P0*(4*(s-13)^3+27*(3*X^2+Y^2-4*Z^2-12)^2))", NULL },
    { "hyperbolic_torus", 3,
      SQUARES "c(-P0*(X^4+2*X^2*Y^2-2*X^2*Z^2-2*(A+B)*X^2+Y^4-2*Y^2*Z^2+2*(A-B)*Y^2+Z^4+2*(A+B)*Z^2+(A-B)^2))", NULL },
    { "isect_ellipsoids", 4, BELLS "P3-P2*min(min(e,f),g)", NULL },
    { "kampyle_of_eudoxus", 3, SQUARES "c(-P0*(Y^2+Z^2-B*X^4+A*B*X^2))", NULL },
    { "kampyle_of_eudoxus_2d", 6, SQUARES "R(3,4,5); c(-P0*(Y^2-B*X^4+P1*P2^3*X^2))", NULL },
    { "klein_bottle", 1, "c(-P0*((s+2*Y-1)*((s-2*Y-1)^2-8*Z^2)+16*X*Z*(s-2*Y-1)))", NULL },
    { "kummer_surface_v1", 1, "c(-P0*(X^4+Y^4+Z^4-s-X^2*Y^2-X^2*Z^2-Y^2*Z^2+1))", NULL },
    { "kummer_surface_v2", 4, "c(-P0*(X^4+Y^4+Z^4+P1*s+P2*(X^2*Y^2+X^2*Z^2+Y^2*Z^2)+P3*X*Y*Z-1))", NULL },
    { "lemniscate_of_gerono", 1, "c(-P0*(X^4-X^2+Y^2+Z^2))", NULL },
    { "lemniscate_of_gerono_2d", 6, SQUARES "R(3,4,5); c(-P0*(Y^2-A*B*X^2+B*X^4))", NULL },
    { "mesh1", 5,
      "k = P3*cos(pi*Z/P1); l = P3*cos(pi*X/P0);"
      "sqrt(min(min((P2*saw(X,P0))^2+(P4*(Y-k))^2, (P2*saw(X-P0,P0))^2+(P4*(Y+k))^2),"
      "min((P2*saw(Z,P1))^2+(P4*(Y+l))^2, (P2*saw(Z-P1,P1))^2+(P4*(Y-l))^2)))", NULL },
    { "mitre", 1, "c(-P0*(4*X^2*s-Y^2*(1-Y^2-Z^2)))", NULL },
    { "nodal_cubic", 1, "c(-P0*(Y^3+Z^3-6*Y*Z))", NULL },
    { "odd", 1, CUSHION, NULL },
    { "ovals_of_cassini", 4, SQUARES "c(-P0*((s+A)^2-P3*A*(X^2+Z^2)-B))", NULL },
    { "paraboloid", 1, "c(-P0*(X^2-Y+Z^2))", NULL },
    { "parabolic_torus", 3,
      SQUARES "c(-P0*(X^4+2*X^2*Y^2-2*X^2*Z-(A+B)*X^2+Y^4-2*Y^2*Z+(A-B)*Y^2+Z^2+(A+B)*Z+(A-B)^2))", NULL },
    { "ph", 0, "atan2(sqrt(X^2+Z^2),Y)", NULL },
    { "pillow", 1, "c(P0*(X^4+Y^4+Z^4-s))", NULL },
    { "piriform", 1, "-c(-P0*(X^4-X^3+Y^2+Z^2))", NULL },
    { "piriform_2d", 7, "R(4,5,6); c(-P0*(Y^2-P1*P3^2*X^3-P2*P3^2*X^4))", NULL },
    { "poly4", 5, "sqrt(X^2+Z^2)-max(-5, P0+P1*Y+P2*Y^2+P3*Y^3+P4*Y^4)", NULL },
    { "polytubes", 6, NULL, &native_polytubes },
    { "quantum", 1,
      AXIS "k = cos(atan2(sqrt(X^2+Z^2),Y)); r = 2*sqrt(X^2+Y^2+Z^2); t = r^2*exp(-0.33333333*r)*(3*k^2-1); -0.1*(t^2-12)", NULL },
    { "quartic_paraboloid", 1, "c(-P0*(X^4+Z^4-Y))", NULL },
    { "quartic_saddle", 1, "c(-P0*(X^4-Z^4-Y))", NULL },
    { "quartic_cylinder", 3, SQUARES "c(-P0*((X^2+Z^2)*(Y^2+B)-A*B))", NULL },
    { "r", 0, "sqrt(s)", NULL },
    { "ridge", 6, NULL, &native_ridge },
    { "ridged_mf", 6, NULL, &native_ridged_mf },
    { "rounded_box", 4,
      "sqrt(max(abs(X)-(P1-P0),0)^2+max(abs(Y)-(P2-P0),0)^2+max(abs(Z)-(P3-P0),0)^2)-P0-0.000001", NULL },
    { "sphere", 1, "sqrt(s)-P0", NULL },
    { "spikes", 5, BELLS "-P2*(P4*exp(-P3*s)-e-f-g)", NULL },
    { "spikes_2d", 4, "Y-P0*cos(P1*X)*cos(P2*Z)*exp(-P3*(X^2+Z^2))", NULL },
    { "spiral", 6,
      "r = sqrt(s); w = sqrt(X^2+Z^2);" AXIS "q = mod(w+P0*atan2(Z,X)/(2*pi),P0)-P0/2; e = 2/P5;"
      "q = " ROUND("q", "Y", "P5") "pow(pow(abs(q),e)+pow(abs(Y),e),1/e))); -min(P2-r, P1-min(q,r))", NULL },
    { "steiners_roman", 1, "c(-P0*(X^2*Y^2+X^2*Z^2+Y^2*Z^2+X*Y*Z))", NULL },
    { "strophoid", 4, "g = P3^2; c(-P0*((P2-X)*(Y^2+Z^2)-g*P1*X^2-g*X^3))", NULL },
    { "strophoid_2d", 7, "g = P3^2; R(4,5,6); c(-P0*((P2-X)*Y^2-g*P1*X^2-g*X^3))", NULL },
    { "superellipsoid", 2, "p = 2/P0; 1-pow(pow(pow(abs(X),p)+pow(abs(Y),p),P0/P1)+pow(abs(Z),2/P1),P1/2)", NULL },
    { "th", 0, "atan2(X,Z)", NULL },
    { "torus", 2, "sqrt((sqrt(X^2+Z^2)-P0)^2+Y^2)-P1", NULL },
    { "torus2", 3, SQUARES "c(-P0*(s^2-2*(A+B)*X^2+2*(A-B)*Y^2-2*(A+B)*Z^2+(A-B)^2))", NULL },
    { "torus_gumdrop", 1, "c(-P0*(4*(X^4+(Y^2+Z^2)^2)+17*X^2*(Y^2+Z^2)-20*s+17))", NULL },
    { "umbrella", 1, "c(-P0*(X^2-Y*Z^2))", NULL },
    { "witch_of_agnesi", 2, "c(-P0*(P1*(Y-1)+(X^2+Z^2)*Y))", NULL },
    { "witch_of_agnesi_2d", 6, "R(3,4,5); A = P1^2; c(-P0*(A*Y+X^2*Y-P2))", NULL },
    { "noise3d", 0, NULL, NULL },
    { "pattern", 0, "0", NULL },
    { "noise_generator", 1, NULL, &native_noise_generator },
};

enum { N_FORMULAS = sizeof formulas / sizeof *formulas, NOISE3D = 76, MAX_NAMES = 32 };

typedef struct Reader {
    FuncBuilder *b;
    const char *at;
    int n_names;
    struct { char text[4]; FuncNode node; } name[MAX_NAMES];
} Reader;

static FuncNode expression(Reader *r);

static bool accept(Reader *r, char c)
{
    while (*r->at == ' ')
        r->at++;
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

static void set(Reader *r, const char *text, FuncNode node)
{
    int i = 0;
    while (i < r->n_names && strcmp(r->name[i].text, text) != 0)
        i++;
    assert(i < MAX_NAMES && strlen(text) < sizeof r->name[i].text);
    strcpy(r->name[i].text, text);
    r->name[i].node = node;
    if (i == r->n_names)
        r->n_names++;
}

static FuncNode get(const Reader *r, const char *text)
{
    for (int i = 0; i < r->n_names; i++)
        if (strcmp(r->name[i].text, text) == 0)
            return r->name[i].node;
    assert(0 && "an unknown name in a formula");
    return 0;
}

static void word(Reader *r, char out[12])
{
    size_t n = 0;
    while (*r->at == ' ')
        r->at++;
    for (; isalnum((unsigned char)*r->at) && n < 11; r->at++)
        out[n++] = *r->at;
    out[n] = 0;
}

static FuncNode sub_of(FuncBuilder *b, FuncNode x, FuncNode y) { return func_binary(b, FUNC_SUB, x, y); }
static FuncNode add_of(FuncBuilder *b, FuncNode x, FuncNode y) { return func_binary(b, FUNC_ADD, x, y); }
static FuncNode mul_of(FuncBuilder *b, FuncNode x, FuncNode y) { return func_binary(b, FUNC_MUL, x, y); }

/* x modulo n, not negative. */
static FuncNode wrapped(FuncBuilder *b, FuncNode x, FuncNode n)
{
    FuncNode m = func_binary(b, FUNC_MOD, x, n);
    return func_choice(b, FUNC_IF_NEGATIVE, m, add_of(b, m, n), m);
}

static FuncNode limited(FuncBuilder *b, FuncNode v, FuncNode limit)
{
    return func_binary(b, FUNC_MIN, func_binary(b, FUNC_MAX, v, func_unary(b, FUNC_NEG, limit)), limit);
}

static FuncNode call(Reader *r, const char *name)
{
    static const struct { const char *name; FuncOp op; } plain[] = {
        { "sqrt", FUNC_SQRT }, { "abs", FUNC_ABS }, { "exp", FUNC_EXP }, { "cos", FUNC_COS }, { "sin", FUNC_SIN },
        { "min", FUNC_MIN }, { "max", FUNC_MAX }, { "pow", FUNC_POW }, { "mod", FUNC_MOD }, { "atan2", FUNC_ATAN2 },
        { "ifneg", FUNC_IF_NEGATIVE }, { "ifzero", FUNC_IF_ZERO },
    };
    FuncBuilder *b = r->b;
    FuncNode a[3] = { 0 };
    int n = 0;
    do
        a[n++] = expression(r);
    while (accept(r, ',') && n < 3);
    accept(r, ')');
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (strcmp(plain[i].name, name) == 0)
            return n == 1 ? func_unary(b, plain[i].op, a[0]) : n == 2 ? func_binary(b, plain[i].op, a[0], a[1])
                                                                       : func_choice(b, plain[i].op, a[0], a[1], a[2]);
    if (strcmp(name, "c") == 0)
        return func_binary(b, FUNC_MIN, func_number(b, 10), func_binary(b, FUNC_MAX, a[0], func_number(b, -10)));
    if (strcmp(name, "limit") == 0)
        return limited(b, a[0], a[1]);
    if (strcmp(name, "turn") == 0)
        return wrapped(b, a[0], func_number(b, 2 * PI));
    assert(strcmp(name, "saw") == 0);          /* saw(u, d): a triangle wave of period 2 d */
    return func_unary(b, FUNC_ABS, sub_of(b, wrapped(b, a[0], mul_of(b, a[1], func_number(b, 2))), a[1]));
}

static FuncNode primary(Reader *r)
{
    if (accept(r, '('))  {
        FuncNode v = expression(r);
        accept(r, ')');
        return v;
    }
    if (isdigit((unsigned char)*r->at))
        return func_number(r->b, strtod(r->at, (char **)&r->at));
    char name[12];
    word(r, name);
    if (strcmp(name, "pi") == 0)
        return func_number(r->b, PI);
    return accept(r, '(') ? call(r, name) : get(r, name);
}

static FuncNode factor(Reader *r)
{
    FuncNode v = primary(r);
    if (accept(r, '^'))
        v = func_binary(r->b, FUNC_POW, v, func_number(r->b, strtod(r->at, (char **)&r->at)));
    return v;
}

static FuncNode product(Reader *r)
{
    FuncNode v = factor(r);
    for (;;) {
        if (accept(r, '*'))
            v = mul_of(r->b, v, factor(r));
        else if (accept(r, '/'))
            v = func_binary(r->b, FUNC_DIV, v, factor(r));
        else
            return v;
    }
}

static FuncNode expression(Reader *r)
{
    FuncNode v = accept(r, '-') ? func_unary(r->b, FUNC_NEG, product(r)) : product(r);
    for (;;) {
        if (accept(r, '+'))
            v = add_of(r->b, v, product(r));
        else if (accept(r, '-'))
            v = sub_of(r->b, v, product(r));
        else
            return v;
    }
}

/* R(i,j,k): if Pi > 0, X becomes the distance from the y axis less Pj, and (X, Y) turns by Pk degrees. */
static void revolve(Reader *r)
{
    static const char *const names[] = { "P0", "P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8", "P9" };
    FuncNode p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = get(r, names[*r->at - '0']);
        r->at += 2;
    }
    FuncBuilder *b = r->b;
    FuncNode x = get(r, "X"), y = get(r, "Y"), z = get(r, "Z"), off = func_unary(b, FUNC_NEG, p[0]);
    FuncNode radius = sub_of(b, func_unary(b, FUNC_SQRT, add_of(b, mul_of(b, x, x), mul_of(b, z, z))), p[1]);
    FuncNode angle = mul_of(b, p[2], func_number(b, PI / 180));
    FuncNode c = func_unary(b, FUNC_COS, angle), s = func_unary(b, FUNC_SIN, angle);
    FuncNode turned_x = sub_of(b, mul_of(b, radius, c), mul_of(b, y, s));
    FuncNode turned_y = add_of(b, mul_of(b, radius, s), mul_of(b, y, c));
    set(r, "X", func_choice(b, FUNC_IF_NEGATIVE, off, turned_x, x));
    set(r, "Y", func_choice(b, FUNC_IF_NEGATIVE, off, turned_y, y));
}

static FuncNode formula(Reader *r)
{
    for (;;) {
        const char *start = r->at;
        char name[12];
        word(r, name);
        if (strcmp(name, "R") == 0 && accept(r, '(')) {
            revolve(r);
        } else if (name[0] != 0 && accept(r, '=')) {
            set(r, name, expression(r));
        } else {
            r->at = start;
            return expression(r);
        }
        accept(r, ';');
    }
}

static FuncNode read_formula(FuncBuilder *b, const Formula *f)
{
    static const char *const names[] = { "X", "Y", "Z", "P0", "P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8", "P9" };
    Reader r = { .b = b, .at = f->text };
    for (int i = 0; i < 3 + f->parameters; i++)
        set(&r, names[i], func_parameter(b, i));
    FuncNode x = func_parameter(b, 0), y = func_parameter(b, 1), z = func_parameter(b, 2);
    set(&r, "s", add_of(b, add_of(b, mul_of(b, x, x), mul_of(b, y, y)), mul_of(b, z, z)));
    return formula(&r);
}

const Function *func_internal(Arena *arena, int number, const int *noise_generator)
{
    if (number < 0 || number >= N_FORMULAS)
        return NULL;
    const Formula *f = &formulas[number];
    FuncBuilder *b = func_builder(arena, 3 + f->parameters);
    if (f->text != NULL)
        return func_finish(b, read_formula(b, f));
    FuncNode list[16];
    for (int i = 0; i < 3 + f->parameters; i++)
        list[i] = func_parameter(b, i);
    if (number == NOISE3D)
        return func_finish(b, build_call(b, FUNC_NOISE, noise_generator, list, 3));
    return func_finish(b, build_call(b, FUNC_NATIVE, f->native, list, 3 + f->parameters));
}
