/* dispersion.c - the colours of the spectrum (04-shading, section 8.2): three overlapping humps, kept as cumulative tables. */
#include "trace/path.h"

static const double HUE_FIRST = 375, HUE_STEP = 5;

static double hump(double centre, double top, double slope, double h)
{
    double x = slope * (h - centre);
    double y = top - x * x;
    if (y < 0 && centre > 0.7)                 /* red has a second, small hump in the violet */
        y = 0.12 - 16 * (h - 0.12) * (h - 0.12);
    return fmax(0, y);
}

void hue_fill(float hue[3][HUES])
{
    static const double shape[3][3] = { { 0.75, 1.15, 5 }, { 0.57, 1.1, 4.5 }, { 0.28, 1, 4 } };
    for (int c = 0; c < 3; c++) {
        double sum[HUES], total = 0;
        for (int i = 0; i < HUES; i++) {
            double h = 0.03 + 0.934 * (HUE_STEP * i) / 365;
            total += hump(shape[c][0], shape[c][1], shape[c][2], h);
            sum[i] = total;
        }
        for (int i = 0; i < HUES; i++)
            hue[c][i] = (float)(round(sum[i] / total * 1e4) / 1e4);
    }
}

static double cumulative(const float table[HUES], double wavelength)
{
    double x = (wavelength - HUE_FIRST) / HUE_STEP;
    if (x <= 0)
        return (double)table[0];
    if (x >= HUES - 1)
        return (double)table[HUES - 1];
    int i = (int)x;
    double f = x - i;
    return (double)table[i] + f * ((double)table[i + 1] - (double)table[i]);
}

Rgb hue_of_band(const Tracing *tracing, double wavelength, double width)
{
    float hue[3];
    for (int c = 0; c < 3; c++)
        hue[c] = (float)(350 / width * (cumulative(tracing->hue[c], wavelength + width / 2) -
                                        cumulative(tracing->hue[c], wavelength - width / 2)));
    return rgb(hue[0], hue[1], hue[2]);
}
