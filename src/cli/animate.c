/* animate.c - which frames, and the clock of each (02-command-line, section 7). */
#include <math.h>

#include "cli/settings.h"

static int digits(int n)
{
    int d = 1;
    while (n >= 10) {
        n /= 10;
        d++;
    }
    return d;
}

static int whole(double v)
{
    return v > 1e9 ? 1000000000 : v < -1e9 ? -1000000000 : (int)v;
}

Frames frames_of(const Settings *s)
{
    int i = s->has_initial_frame ? whole(s->initial_frame) : 0, f = s->has_final_frame ? whole(s->final_frame) : 0;
    if ((i == 0 && f == 0) || (i == 1 && f == 1))
        return (Frames){ .first = 0, .last = 0, .step = 1 };
    Frames out = { .animated = true, .step = s->frame_step >= 1 ? whole(s->frame_step) : 1 };
    out.initial = s->has_initial_frame ? i : 1;
    out.final = s->has_final_frame ? f : 1;
    out.initial_clock = s->initial_clock;
    out.final_clock = s->has_final_clock ? s->final_clock : 1;
    int span = out.final - out.initial + (s->cyclic ? 1 : 0), count = out.final - out.initial + 1;
    /* POV: divides by zero for a single frame and gives a NaN clock; one frame has the initial clock. */
    out.delta = span > 0 ? (out.final_clock - out.initial_clock) / span : 0;
    out.first = out.initial;
    out.last = out.final;
    if (s->has_subset_start)
        out.first = s->subset_start < 1 ? out.initial + whole(count * s->subset_start) : whole(s->subset_start);
    if (s->has_subset_end)
        out.last = s->subset_end < 1 ? out.initial + whole(count * s->subset_end) : whole(s->subset_end);
    if (out.first < out.initial)
        out.first = out.initial;
    if (out.last > out.final)
        out.last = out.final;
    out.digits = digits(out.final + (s->cyclic ? 1 : 0));
    if (s->cyclic)
        out.final++;
    return out;
}

double frame_clock(const Frames *f, const Settings *s, int frame)
{
    if (!f->animated)
        return (double)(float)s->clock;
    return (double)(float)(f->initial_clock + f->delta * (frame - f->initial));
}
