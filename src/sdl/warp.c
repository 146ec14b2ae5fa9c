/* warp.c - warp { ... }: what bends the space of a pattern (07-textures, section 3). */
#include "sdl/blocks.h"

static Vec3 direction(Parser *p)
{
    return normalized(parse_vec3(p));
}

static void repeat(Parser *p, Warp *w)
{
    Vec3 v = parse_vec3(p);
    double width = 0;
    w->kind = WARP_REPEAT;
    w->repeat.flip = vec3(1, 1, 1);
    w->repeat.axis = -1;
    for (int axis = 0; axis < 3; axis++) {
        if (fabs(vec3_at(v, axis)) <= 1e-10)
            continue;
        if (w->repeat.axis >= 0)
            parse_fail(p, "Can only repeat along 1 axis.");
        w->repeat.axis = axis;
        width = vec3_at(v, axis);
    }
    if (w->repeat.axis < 0)
        parse_fail(p, "No axis specified in repeat.");
    w->repeat.width = (float)width;
    for (;;) {
        if (parse_accept(p, KW_FLIP)) {
            Vec3 f = parse_vec3(p);
            for (int axis = 0; axis < 3; axis++)
                vec3_set(&w->repeat.flip, axis, vec3_at(f, axis) != 0 ? -1 : 1);
        } else if (parse_accept(p, KW_OFFSET)) {
            w->repeat.offset = parse_vec3(p);
        } else {
            return;
        }
    }
}

/* POV: a cell too small for the sphere in it is made larger, in the order of reading. */
static void fit_cells(Parser *p, Warp *w)
{
    bool changed = false;
    for (int axis = 0; axis < 3; axis++) {
        double r = vec3_at(w->hole.repeat, axis), c = vec3_at(w->hole.centre, axis);
        if (r <= 0)
            continue;
        if (c < w->hole.radius) {
            vec3_set(&w->hole.centre, axis, c = w->hole.radius);
            changed = true;
        }
        double least = c + w->hole.radius + vec3_at(w->hole.jitter, axis);
        if (r < least) {
            vec3_set(&w->hole.repeat, axis, least);
            changed = true;
        }
    }
    if (changed)
        parse_warn(p, "The black_hole does not fit its repeat; centre or repeat made larger.");
}

static void black_hole(Parser *p, Warp *w)
{
    w->kind = WARP_BLACK_HOLE;
    w->hole.centre = parse_vec3(p);
    w->hole.radius = parse_next_float(p);
    w->hole.strength = 1;
    w->hole.falloff = 2;
    for (;;) {
        switch (parse_peek(p)) {
        case KW_STRENGTH: parse_skip(p); w->hole.strength = parse_float(p); break;
        case KW_FALLOFF: parse_skip(p); w->hole.falloff = parse_float(p); break;
        case KW_INVERSE: parse_skip(p); w->hole.inverse = true; break;
        case KW_TYPE: parse_skip(p); w->hole.type = parse_int(p); break;
        case KW_REPEAT:
            parse_skip(p);
            w->hole.repeat = parse_vec3(p);
            w->hole.repeats = true;
            fit_cells(p, w);
            break;
        case KW_TURBULENCE:
            parse_skip(p);
            w->hole.jitter = parse_vec3(p);
            w->hole.jitters = true;
            if (w->hole.repeats)
                fit_cells(p, w);
            break;
        default: return;
        }
    }
}

static void mapped(Parser *p, Warp *w, WarpKind kind)
{
    w->kind = kind;
    w->mapped.orientation = vec3(0, 0, 1);
    w->mapped.major_radius = 1;
    if (kind == WARP_PLANAR) {
        if (parse_at_number(p)) {
            w->mapped.orientation = direction(p);
            w->mapped.distance = parse_next_float(p);
        }
        return;
    }
    for (;;) {
        if (parse_accept(p, KW_ORIENTATION))
            w->mapped.orientation = direction(p);
        else if (parse_accept(p, KW_DIST_EXP))
            w->mapped.dist_exp = parse_float(p);
        else if (kind == WARP_TOROIDAL && parse_accept(p, KW_MAJOR_RADIUS))
            w->mapped.major_radius = parse_float(p);
        else
            return;
    }
}

Warp parse_warp(Parser *p)
{
    Warp w = { 0 };
    parse_expect(p, KW_WARP);
    block_open(p, "warp");
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_TURBULENCE: case KW_OCTAVES: case KW_OMEGA: case KW_LAMBDA:
        w.kind = WARP_TURBULENCE;
        w.turbulence = TURBULENCE_DEFAULT;
        while (parse_skip(p), parse_turbulence_item(p, keyword, &w.turbulence)) {
            keyword = parse_peek(p);
            if (keyword != KW_TURBULENCE && keyword != KW_OCTAVES && keyword != KW_OMEGA && keyword != KW_LAMBDA)
                break;
        }
        break;
    case KW_REPEAT: parse_skip(p); repeat(p, &w); break;
    case KW_BLACK_HOLE: parse_skip(p); black_hole(p, &w); break;
    case KW_PLANAR: parse_skip(p); mapped(p, &w, WARP_PLANAR); break;
    case KW_CYLINDRICAL: parse_skip(p); mapped(p, &w, WARP_CYLINDRICAL); break;
    case KW_SPHERICAL: parse_skip(p); mapped(p, &w, WARP_SPHERICAL); break;
    case KW_TOROIDAL: parse_skip(p); mapped(p, &w, WARP_TOROIDAL); break;
    case KW_CUBIC: parse_skip(p); w.kind = WARP_CUBIC; break;
    default: parse_expected(p, "warp type");
    }
    block_close(p, "warp");
    return w;
}
