/* image_map.c - points to image positions, and interpolation between pixels.
 *
 * Mapping and weights are those of 07-textures, sections 6.2 and 6.3: pixel (i,j) covers [i,i+1) x [j,j+1), and blends
 * work on the image's stored form, all five components at once. */
#include "texture/sample.h"

#include "image/image.h"

/* POV: added to every position, so that points on the edge between two pixels fall on one side. */
static const double NUDGE = 1e-10;

static double angle_about_y(double x, double z)
{
    if (z == 0)
        return x > 0 ? 0 : PI;
    double angle = acos(fmax(-1, fmin(1, x / sqrt(x * x + z * z))));
    return z < 0 ? 2 * PI - angle : angle;
}

/* fmod, which is a call and seldom needed. */
static double remainder_of(double v, double size)
{
    return fabs(v) < size ? v : fmod(v, size);
}

/* (u,v) in pixels, v upwards, before the offset. */
static bool project(const ImageMap *map, Vec3 p, double width, double height, double *u, double *v)
{
    double around = sqrt(p.x * p.x + p.z * p.z);
    switch (map->map_type) {
    case 1: {
        double r = length(p);
        if (r == 0)
            return false;
        *u = around == 0 ? 0 : angle_about_y(p.x, p.z) / (2 * PI) * width;
        *v = (0.5 + asin(fmax(-1, fmin(1, p.y / r))) / PI) * height;
        return true;
    }
    case 2:
        if (around == 0 || (map->once && (p.y < 0 || p.y > 1)))
            return false;
        *u = angle_about_y(p.x, p.z) / (2 * PI) * width;
        *v = remainder_of(p.y * height, height);
        return true;
    case 5: {
        if (around == 0)
            return false;
        double out = around - 1, m = sqrt(out * out + p.y * p.y);
        double phi = m == 0 ? 0 : acos(fmax(-1, fmin(1, -out / m)));
        *u = angle_about_y(p.x, p.z) / (2 * PI) * width;
        *v = (p.y > 0 ? 2 * PI - phi : phi) / (2 * PI) * height;
        return true;
    }
    default:
        if (map->once && (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1))
            return false;
        *u = remainder_of(p.x * width, width);
        *v = remainder_of(p.y * height, height);
        return true;
    }
}

/* Into [0, size). */
static double wrapped(double v, double size)
{
    if (v >= 0 && v < size)
        return v;
    v = fmod(v, size);
    if (v < 0)
        v += size;
    return v < size ? v : 0;                   /* a tiny negative remainder rounds up to size */
}

bool image_spot(const ImageMap *map, Vec3 p, ImageSpot *out)
{
    double width = map->image->width, height = map->image->height, u, v;
    if (!vec3_finite(p) || !project(map, p, width * map->repeat.u, height * map->repeat.v, &u, &v))
        return false;
    u += -width * map->offset.u + NUDGE;
    v += -height * map->offset.v + NUDGE;
    if (map->once && (u >= width || v >= height || u < 0 || v < 0))
        return false;
    *out = (ImageSpot){ wrapped(u, width), wrapped(-v, height) };
    return true;
}

/* ---- pixels ---- */

/* Sums of five components, or of palette numbers in the first. */
typedef struct Sum { double c[5]; } Sum;

static int wrapped_index(int i, int size, bool clamps)
{
    if (i >= 0 && i < size)
        return i;
    if (clamps)
        return i < 0 ? 0 : size - 1;
    i %= size;
    return i < 0 ? i + size : i;
}

/* The colour with the map's filter and transmit (section 6.5). */
static Colour pixel(const ImageMap *map, int x, int y)
{
    const Image *im = map->image;
    Colour c = image_pixel(im, x, y);
    if (!im->indexed) {
        c.f += map->filter_all;
        c.t += map->transmit_all;
        return c;
    }
    int i = image_index(im, x, y);
    if (map->palette_filter != NULL)
        c.f = map->palette_filter[i];
    if (map->palette_transmit != NULL)
        c.t = map->palette_transmit[i];
    return c;
}

static void add_colour(const ImageMap *map, int x, int y, double weight, Sum *sum)
{
    Colour c = pixel(map, x, y);
    sum->c[0] += (double)c.r * weight;
    sum->c[1] += (double)c.g * weight;
    sum->c[2] += (double)c.b * weight;
    sum->c[3] += (double)c.f * weight;
    sum->c[4] += (double)c.t * weight;
}

static void add_index(const ImageMap *map, int x, int y, double weight, Sum *sum)
{
    sum->c[0] += image_index(map->image, x, y) * weight;
}

typedef void AddPixel(const ImageMap *map, int x, int y, double weight, Sum *sum);

/* The pixels of columns i - back ... and rows j - back ..., n each way; weights by row, then column. */
static void add_block(const ImageMap *map, int i, int j, int back, int n, const double *weight, AddPixel *add_pixel, Sum *sum)
{
    int x[4], y[4];
    for (int k = 0; k < n; k++) {
        x[k] = wrapped_index(i - back + k, map->image->width, map->once);
        y[k] = wrapped_index(j - back + k, map->image->height, map->once);
    }
    for (int l = 0; l < n; l++)
        for (int k = 0; k < n; k++)
            add_pixel(map, x[k], y[l], weight[n * l + k], sum);
}

static void bilinear_weights(double p, double q, double out[4])
{
    out[0] = (1 - p) * (1 - q);
    out[1] = p * (1 - q);
    out[2] = (1 - p) * q;
    out[3] = p * q;
}

/* Nearer pixels count more; exactly at the centre of one, it counts alone. */
static void distance_weights(double p, double q, double out[4])
{
    const double d[4] = { p * p + q * q, (1 - p) * (1 - p) + q * q, p * p + (1 - q) * (1 - q),
                          (1 - p) * (1 - p) + (1 - q) * (1 - q) };
    double total = 0;
    for (int k = 0; k < 4; k++)
        total += out[k] = 1 / fmax(d[k], 1e-300);
    for (int k = 0; k < 4; k++)
        out[k] /= total;
}

static void cubic_weights(double p, double out[4])
{
    double r = 1 - p;
    out[0] = -p * r * r / 2;
    out[1] = r * (r * (3 * p + 1) + 1) / 2;
    out[2] = p * (p * (3 * r + 1) + 1) / 2;
    out[3] = -r * p * p / 2;
}

static Sum interpolated(const ImageMap *map, ImageSpot at, AddPixel *add_pixel)
{
    double x = at.x + 0.5, y = at.y + 0.5, weight[16];
    int i = (int)x, j = (int)y;
    double p = x - i, q = y - j;
    Sum sum = { { 0 } };
    if (map->interpolate == 3) {
        double wx[4], wy[4];
        cubic_weights(p, wx);
        cubic_weights(q, wy);
        for (int k = 0; k < 16; k++)
            weight[k] = wx[k % 4] * wy[k / 4];
        add_block(map, i, j, 2, 4, weight, add_pixel, &sum);
    } else {
        (map->interpolate == 2 ? bilinear_weights : distance_weights)(p, q, weight);
        add_block(map, i, j, 1, 2, weight, add_pixel, &sum);
    }
    return sum;
}

static ImageSpot inside_image(const Image *im, ImageSpot at)
{
    return (ImageSpot){ wrapped(at.x, im->width), wrapped(at.y, im->height) };
}

Colour image_sample(const ImageMap *map, ImageSpot at)
{
    at = inside_image(map->image, at);
    Colour c;
    if (map->interpolate == 0) {
        c = pixel(map, (int)at.x, (int)at.y);
    } else {
        Sum v = interpolated(map, at, add_colour);
        c = (Colour){ (float)v.c[0], (float)v.c[1], (float)v.c[2], (float)v.c[3], (float)v.c[4] };
    }
    float alpha = 1 - c.t;
    if (map->premultiplied && alpha > 1e-10f) {
        c.r /= alpha;
        c.g /= alpha;
        c.b /= alpha;
    }
    return c;
}

double image_sample_index(const ImageMap *map, ImageSpot at)
{
    at = inside_image(map->image, at);
    return map->interpolate == 0 ? image_index(map->image, (int)at.x, (int)at.y) : interpolated(map, at, add_index).c[0];
}

int image_spot_index(const ImageMap *map, ImageSpot at)
{
    at = inside_image(map->image, at);
    return image_index(map->image, (int)at.x, (int)at.y);
}
