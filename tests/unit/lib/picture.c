/* picture.c - see picture.h. */
#include "lib/picture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void show(void *user, const WhitMessage *message)
{
    (void)user;
    if (message->kind == WHIT_ERROR)
        fprintf(stderr, "%s\n", message->text);
}

Picture picture_of(const WhitOptions *options, const char *const *pieces)
{
    static char text[65536];
    size_t n = 0;
    for (; *pieces != NULL; pieces++) {
        assert_true(n + strlen(*pieces) + 2 < sizeof text);
        n += (size_t)sprintf(text + n, "%s\n", *pieces);
    }
    Picture p = { .whit = whit_new(options) };
    whit_show(p.whit, show, NULL);
    if (!whit_load_text(p.whit, "test.pov", text, n) || !whit_render(p.whit, NULL, NULL))
        fail_msg("cannot render:\n%s", text);
    p.image = whit_image(p.whit);
    return p;
}

void picture_free(Picture *p)
{
    whit_free(p->whit);
    p->whit = NULL;
}

bool picture_has(const Picture *p, int x, int y, const double rgb[3], double tolerance)
{
    const float *found = picture_pixel(p, x, y);
    for (int i = 0; i < 3; i++)
        if (!(fabs((double)found[i] - rgb[i]) <= tolerance)) {
            fprintf(stderr, "pixel %d %d is %.5f %.5f %.5f, not %.5f %.5f %.5f\n", x, y, (double)found[0], (double)found[1],
                    (double)found[2], rgb[0], rgb[1], rgb[2]);
            return false;
        }
    return true;
}
