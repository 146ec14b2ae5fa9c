/* contrast.c - see contrast.h.
 *
 * Colours are compared after a power, which would cost more than many a ray. As most neighbours are much alike or far apart, a
 * table of chords says nearly enough: only a distance within its error of the threshold asks for the powers themselves. */
#include "render/contrast.h"

#include "base/bits.h"
#include "image/gamma.h"

/* A chord spans 1/16 of a power of two: from the bits of the float 2^-24 to those of 2^4. */
enum { CHORD_BITS = 19, CHORD_FIRST = (127 - 24) << 4, CHORDS = 28 << 4 };

/* x^p lies above its chord by at most |p (p - 1)| / (8 * 16^2) of itself, and somewhat less than 1/8 more at the chord's far end;
 * sRGB's curve is such a power in places and a straight line in others. */
#define CHORD_POWER_MAX 1.2
#define CHORD_ERROR (0.25 / (8 * 16 * 16) * 1.25)

struct Contrast {
    double threshold;
    Transfer working;                          /* of the colours that are compared */
    double exponent;                           /* then this power */
    bool chords;                               /* is the table filled? */
    double chord[CHORDS + 1];                  /* its ends */
};

static double exact_light(const Contrast *c, float value)
{
    if (value <= 0)
        return 0;
    double v = (double)value;
    if (c->working.kind == TRANSFER_SRGB)
        v = transfer_decode(c->working, v);
    return c->exponent == 1 ? v : pow(v, c->exponent);
}

Contrast *contrast_new(Arena *arena, const World *w, const RenderOptions *options)
{
    Contrast *c = arena_new(arena, Contrast);
    c->threshold = options->threshold;
    double gamma = options->antialias_gamma, steepest = 1;
    c->exponent = gamma <= 0 || fabs(gamma - 1) <= 0.01 ? 1 : 1 / gamma;
    c->working = (Transfer){ TRANSFER_NONE, 1 };
    if (w->globals.assumed_gamma == GAMMA_SRGB) {
        c->working = (Transfer){ TRANSFER_SRGB, 1 };
        steepest = 2.4;
    } else if (w->globals.assumed_gamma == GAMMA_POWER && fabs(w->globals.assumed_gamma_value - 1) > 0.01) {
        c->exponent *= w->globals.assumed_gamma_value;         /* two powers are one */
    }
    c->chords = c->exponent * steepest <= CHORD_POWER_MAX && (c->exponent != 1 || steepest > 1);
    for (uint32_t i = 0; c->chords && i <= CHORDS; i++)
        c->chord[i] = exact_light(c, float_of_bits((CHORD_FIRST + i) << CHORD_BITS));
    return c;
}

static inline double near_light(const Contrast *c, float value)
{
    uint32_t bits = float_bits(value), i = (bits >> CHORD_BITS) - CHORD_FIRST;
    if (i >= CHORDS)                           /* also all that is negative or no number */
        return exact_light(c, value);
    double along = (int)(bits & ((1u << CHORD_BITS) - 1)) * (1.0 / (1u << CHORD_BITS));
    return c->chord[i] + along * (c->chord[i + 1] - c->chord[i]);
}

static inline void set_light(Seen *s, double r, double g, double b)
{
    s->light[0] = r;
    s->light[1] = g;
    s->light[2] = b;
    s->sum = r + g + b;
}

__attribute__((noinline)) static void look_exactly(const Contrast *c, Seen *s)         /* a power each: greys need one */
{
    float r = s->colour.r, g = s->colour.g, b = s->colour.b;
    double red = exact_light(c, r), green = g == r ? red : exact_light(c, g);
    set_light(s, red, green, b == g ? green : exact_light(c, b));
    s->exact = true;
}

void contrast_see(const Contrast *c, Seen *s)
{
    if (!c->chords) {
        look_exactly(c, s);
        return;
    }
    set_light(s, near_light(c, s->colour.r), near_light(c, s->colour.g), near_light(c, s->colour.b));
    s->exact = false;
}

static double distance(const Seen *a, const Seen *b)
{
    return fabs(a->light[0] - b->light[0]) + fabs(a->light[1] - b->light[1]) + fabs(a->light[2] - b->light[2]) +
           fabs((double)a->colour.t - (double)b->colour.t);
}

bool contrast_differ(const Contrast *c, Seen *a, Seen *b)
{
    double over = distance(a, b) - c->threshold, doubt = CHORD_ERROR * (a->sum + b->sum);
    if (over > doubt)
        return true;
    if (over < -doubt)
        return false;
    if (!a->exact)                             /* or not a number */
        look_exactly(c, a);
    if (!b->exact)
        look_exactly(c, b);
    return distance(a, b) >= c->threshold;
}
