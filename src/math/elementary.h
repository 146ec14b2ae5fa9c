/* elementary.h - sine, cosine, arc tangent, exponential and logarithm without branches, so that loops over them become vector code.
 *
 * Reduction and polynomials are those of fdlibm (Sun Microsystems, 1993); errors stay below one unit in the last place. Each is
 * good for the arguments its _holds() accepts; for others ask the C library. Only plain operations: all instruction sets and widths
 * give the same bits. */
#ifndef MATH_ELEMENTARY_H
#define MATH_ELEMENTARY_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static inline double elementary_of_bits(uint64_t bits)
{
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static inline uint64_t elementary_bits(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

static inline bool elementary_angle_holds(double x) { return fabs(x) < 0x1p19; }
static inline bool elementary_exp_holds(double x) { return fabs(x) < 700; }
static inline bool elementary_ln_holds(double x) { return x >= 0x1p-1000 && x < 0x1p1000; }

/* sin(x + quarter turns * pi/2) */
static inline double elementary_wave(double x, uint64_t quarters)
{
    const double MAGIC = 0x1.8p52;             /* added and taken away, it rounds to a whole number, which stands in the low bits */
    double shifted = x * 6.36619772367581382433e-01 + MAGIC, k = shifted - MAGIC;
    uint64_t quadrant = elementary_bits(shifted) + quarters;
    /* y + low = x - k pi/2, pi/2 in pieces of 33 bits, so that the products are exact. */
    double r = x - k * 1.57079632673412561417e+00, w = k * 6.07710050630396597660e-11, t = r;
    r = t - w;
    w = k * 2.02226624879595063154e-21 - ((t - r) - w);
    double y = r - w, low = (r - y) - w, z = y * y;
    double s = 8.33333333332248946124e-03
             + z * (-1.98412698298579493134e-04
                    + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    double v = z * y;
    double sine = y - ((z * (0.5 * low - v * s) - low) - v * -1.66666666666666324348e-01);
    double c = z * (4.16666666666666019037e-02
                    + z * (-1.38888888888741095749e-03
                           + z * (2.48015872894767294178e-05
                                  + z * (-2.75573143513906633035e-07
                                         + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    double half = 0.5 * z, one = 1 - half;
    double cosine = one + (((1 - one) - half) + (z * c - y * low));
    uint64_t use_cosine = 0 - (quadrant & 1), sign = (quadrant & 2) << 62;
    uint64_t bits = (elementary_bits(cosine) & use_cosine) | (elementary_bits(sine) & ~use_cosine);
    return elementary_of_bits(bits ^ sign);
}

static inline double elementary_sin(double x) { return elementary_wave(x, 0); }
static inline double elementary_cos(double x) { return elementary_wave(x, 1); }

static inline double elementary_exp(double x)
{
    const double MAGIC = 0x1.8p52;
    double shifted = x * 1.44269504088896338700e+00 + MAGIC, k = shifted - MAGIC;
    double high = x - k * 6.93147180369123816490e-01, low = k * 1.90821492927058770002e-10, r = high - low, t = r * r;
    double c = r - t * (1.66666666666666019037e-01
                        + t * (-2.77777777770155933842e-03
                               + t * (6.61375632143793436117e-05 + t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
    double y = 1 - ((low - (r * c) / (2 - c)) - high);
    return elementary_of_bits(elementary_bits(y) + (elementary_bits(shifted) << 52));
}

static inline double elementary_ln(double x)
{
    /* x = 2^k (1 + f), 1 + f from sqrt(1/2) to sqrt(2) */
    uint64_t bits = elementary_bits(x), up = bits + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu);
    double k = elementary_of_bits((up >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
    double f = elementary_of_bits((up & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu) - 1;
    double s = f / (2 + f), z = s * s, w = z * z;
    double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    double odd = z * (6.666666666666735130e-01
                      + w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    double half = 0.5 * f * f;
    return k * 6.93147180369123816490e-01 - ((half - (s * (half + (odd + even)) + k * 1.90821492927058770002e-10)) - f);
}

static inline bool elementary_atan2_holds(double y, double x)
{
    double large = fabs(x) + fabs(y);
    return (large > 0x1p-500) & (large < 0x1p500);
}

static inline double elementary_atan2(double y, double x)
{
    double u = fabs(x), v = fabs(y), low = u < v ? u : v, high = u < v ? v : u;
    /* atan(low / high) = atan(c) + atan((low - c high) / (high + c low)), c = 0, 1/2 or 1 */
    double some = low > 0.4375 * high ? 1.0 : 0.0, more = low > 0.6875 * high ? 1.0 : 0.0;
    double c = 0.5 * some + 0.5 * more;
    double angle = 4.63647609000806093515e-01 * some + 3.21750554396642193401e-01 * more;
    double angle_rest = 2.26987774529616870924e-17 * some + 7.9173925017e-18 * more;
    double t = (low - c * high) / (high + c * low), z = t * t, w = z * z;
    double odd = z * (3.33333333333329318027e-01
                      + w * (1.42857142725034663711e-01
                             + w * (9.09088713343650656196e-02
                                    + w * (6.66107313738753120669e-02
                                           + w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
    double even = w * (-1.99999999998764832476e-01
                       + w * (-1.11111104054623557880e-01
                              + w * (-7.69187620504482999495e-02
                                     + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
    double part = t - t * (odd + even);
    /* From the nearer axis on: turned by whole quarters, to and fro. */
    double swapped = u < v ? 1.0 : 0.0, behind = x < 0 ? 1.0 : 0.0;
    double sign = (1 - 2 * swapped) * (1 - 2 * behind), quarters = swapped + 2 * behind * (1 - swapped);
    double base = quarters * 1.57079632679489655800e+00, rest = quarters * 6.12323399573676603587e-17 + sign * angle_rest;
    double turned = base + sign * angle, lost = (base - turned) + sign * angle;
    return copysign(turned + (rest + lost + sign * part), y);
}

#endif
