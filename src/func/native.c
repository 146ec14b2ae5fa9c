/* native.c - fractal noise and tubes: built-in functions whose number of terms depends on a parameter (01-language, section 18).
 *
 * Musgrave's fractals, after Ebert et al., Texturing and Modeling. Arguments: x, y, z, P0, P1... */
#include "func/native.h"

#include <math.h>

#include "math/noise.h"

enum { MAX_TERMS = 10000 };                    /* octaves or tubes: beyond, nobody waits */

static int generator_of(double number)
{
    return number > -1e9 && number < 1e9 ? (int)number & 3 : 0;
}

static int terms_of(double number)
{
    return number > 0 ? number < MAX_TERMS ? (int)number : MAX_TERMS : 0;
}

static double signed_noise(int generator, Vec3 p)
{
    return 2 * noise_value(generator, &p) - 1;
}

static double hetero_mf(const double *a)
{
    Vec3 p = vec3(a[0], a[1], a[2]);
    double H = a[3], lacunarity = a[4], octaves = a[5], offset = a[6];
    int times = terms_of(a[7]), generator = generator_of(a[8]);
    double v = signed_noise(generator, p) + offset, f = pow(lacunarity, -H), e = f;
    p = scaled(p, lacunarity);
    for (int i = 1; i < octaves && i < MAX_TERMS; i++) {
        double d = (signed_noise(generator, p) + offset) * e;
        for (int k = 0; k < times; k++)
            d *= v;
        v += d;
        p = scaled(p, lacunarity);
        e *= f;
    }
    double rest = octaves - floor(octaves);
    if (rest != 0)
        v += rest * (signed_noise(generator, p) + offset) * e * v;
    return v;
}

static double ridge(const double *a)
{
    Vec3 p = vec3(a[0], a[1], a[2]);
    double lambda = a[3], octaves = a[4], omega = a[5], offset = a[6], middle = a[7];
    int generator = generator_of(a[8]);
    double depth = fmax(middle, 1 - middle), sum = 0, weights = 0, weight = 1, scale = 1;
    int whole = terms_of(octaves);
    for (int i = 0; i <= whole; i++) {
        double share = i < whole ? 1 : octaves - floor(octaves);
        if (share != 0) {
            Vec3 q = scaled(p, scale);
            double t = fabs(noise_value(generator, &q) - middle) / depth - offset;
            sum += share * weight * t;
            weights += share * weight;
        }
        weight *= omega;
        scale *= lambda;
    }
    return sum / weights / fmax(offset, 1 - offset);
}

/* POV: the powers of the first call ever are kept for all others; here every call has its own. */
static double ridged_mf(const double *a)
{
    Vec3 p = vec3(a[0], a[1], a[2]);
    double H = a[3], lacunarity = a[4], octaves = a[5], offset = a[6], gain = a[7];
    int generator = generator_of(a[8]);
    double signal = offset - fabs(signed_noise(generator, p)), f = pow(lacunarity, -H), e = 1;
    signal *= signal;
    double v = signal;
    for (int i = 1; i < octaves && i < MAX_TERMS; i++) {
        p = scaled(p, lacunarity);
        e *= f;
        double weight = signal * gain, next = offset - fabs(signed_noise(generator, p));
        weight = weight < 0 ? 0 : weight > 1 ? 1 : weight;
        signal = weight * (next * next);
        v += signal * e;
    }
    return v;
}

static double polytubes(const double *a)
{
    double x = a[0], y = a[1], z = a[2], nearest = 10000;
    int n = terms_of(a[3]);
    double radius = a[4] + y * (a[5] + y * (a[6] + y * (a[7] + y * a[8])));
    for (int i = 0; i < n; i++) {
        double angle = 2 * PI * i / a[3];
        double dx = x - radius * sin(angle), dz = z - radius * cos(angle);
        nearest = fmin(nearest, sqrt(dx * dx + dz * dz));
    }
    return nearest;
}

static double noise_generator(const double *a)
{
    return noise_value(generator_of(a[3]), &(Vec3){ a[0], a[1], a[2] });
}

FuncNative *const native_hetero_mf = hetero_mf, *const native_ridge = ridge, *const native_ridged_mf = ridged_mf,
    *const native_polytubes = polytubes, *const native_noise_generator = noise_generator;
