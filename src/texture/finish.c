/* finish.c - the parts of a finish that are formulas of their own (04-shading, sections 5.6 and 5.7). */
#include "math/noise.h"
#include "texture/texture.h"

Rgb finish_iridescence(const Finish *finish, Vec3 p, double cos_light, double cos_ray, Rgb wavelength, const TextureContext *at)
{
    double thickness = (double)finish->irid_thickness;
    if (finish->irid_turbulence != 0) {
        int generator = at != NULL && at->noise_generator != 0 ? at->noise_generator : 2;
        thickness *= 1 + (2 * noise_turbulence(generator, p, 5, 0.5, 2) - 1) * (double)finish->irid_turbulence;
    }
    double phase = 2 * PI * thickness * (fabs(cos_light) + fabs(cos_ray)), irid = (double)finish->irid;
    return rgb((float)(1 + irid * cos(phase / (double)wavelength[0])), (float)(1 + irid * cos(phase / (double)wavelength[1])),
               (float)(1 + irid * cos(phase / (double)wavelength[2])));
}

double finish_metallic_fresnel(double cosine)
{
    double x = acos(fmax(-1, fmin(1, cosine))) / (PI / 2);
    double f = 0.014567225 / ((x - 1.12) * (x - 1.12)) - 0.011612903;
    return fmax(0, fmin(1, f));
}
