/* global.c - global_settings, with radiosity, photons and subsurface in it (01-language, section 20). */
#include "sdl/blocks.h"

#include "sdl/parser.h"

static float number(Parser *p)
{
    return (float)parse_float(p);
}

static float positive(Parser *p, const char *what)
{
    float v = number(p);
    if (!(v > 0))
        parse_fail(p, "Radiosity %s must be a positive number.", what);
    return v;
}

static bool yes(Parser *p)
{
    return (int)parse_float(p) != 0;           /* POV: the integer part counts */
}

/* ---- radiosity ---- */

static const RadiosityDef RADIOSITY_DEFAULT = {
    .adc_bailout = 0.01f, .brightness = 1, .error_bound = 1.8f, .low_error_factor = 0.5f, .maximum_reuse = 0.2f,
    .minimum_reuse = 0.015f, .max_sample = -1, .pretrace_start = 0.08f, .pretrace_end = 0.04f, .count = 35,
    .count_bank = 1600, .nearest_count = 5, .recursion_limit = 2,
};

typedef struct Reuse { bool minimum, maximum; } Reuse;

static void radiosity_count(Parser *p, RadiosityDef *r)
{
    r->count = parse_int(p);
    if (r->count <= 0)
        parse_fail(p, "Radiosity count must be a positive number.");
    r->count_bank = r->count > 1600 ? r->count : 1600;
    parse_comma(p);
    if (parse_at_number(p))
        r->count_bank = parse_int(p);
    if (r->count_bank < r->count)
        parse_fail(p, "Radiosity count can not be more than direction pool size (count 2nd value).");
}

static void nearest_count(Parser *p, RadiosityDef *r)
{
    r->nearest_count = parse_int(p);
    if (r->nearest_count < 1 || r->nearest_count > 20)
        parse_fail(p, "Radiosity nearest count must be a value from 1 to 20.");
    parse_comma(p);
    if (parse_at_number(p)) {
        r->nearest_count_adaptive = parse_int(p);
        if (r->nearest_count_adaptive < 0 || r->nearest_count_adaptive >= r->nearest_count)
            parse_fail(p, "Radiosity nearest count 2nd value must be from 0 to the first value less 1.");
    }
}

static float fraction(Parser *p, const char *word)
{
    float v = number(p);
    if (!(v > 0 && v <= 1))
        parse_fail(p, "Radiosity %s must be greater than 0 and no higher than 1.", word);
    return v;
}

static bool radiosity_item(Parser *p, RadiosityDef *r, Reuse *reuse)
{
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_ADC_BAILOUT: parse_skip(p); r->adc_bailout = positive(p, "adc bailout"); break;
    case KW_ALWAYS_SAMPLE: parse_skip(p); r->always_sample = yes(p); break;
    case KW_BRIGHTNESS: parse_skip(p); r->brightness = positive(p, "brightness"); break;
    case KW_COUNT: parse_skip(p); radiosity_count(p, r); break;
    case KW_ERROR_BOUND: parse_skip(p); r->error_bound = positive(p, "error bound"); break;
    case KW_GRAY_THRESHOLD:
        parse_skip(p);
        r->gray_threshold = number(p);
        if (!(r->gray_threshold >= 0 && r->gray_threshold <= 1))
            parse_fail(p, "Radiosity gray threshold must be from 0.0 to 1.0.");
        break;
    case KW_LOW_ERROR_FACTOR: parse_skip(p); r->low_error_factor = positive(p, "low error factor"); break;
    case KW_MAX_SAMPLE: parse_skip(p); r->max_sample = number(p); break;
    case KW_MAXIMUM_REUSE:
        parse_skip(p);
        r->maximum_reuse = positive(p, "maximum reuse");
        reuse->maximum = true;
        break;
    case KW_MINIMUM_REUSE:
        parse_skip(p);
        r->minimum_reuse = number(p);
        reuse->minimum = true;
        if (r->minimum_reuse < 0)
            parse_fail(p, "Radiosity minimum reuse can not be a negative number.");
        break;
    case KW_NEAREST_COUNT: parse_skip(p); nearest_count(p, r); break;
    case KW_PRETRACE_START: parse_skip(p); r->pretrace_start = fraction(p, "pretrace start"); break;
    case KW_PRETRACE_END: parse_skip(p); r->pretrace_end = fraction(p, "pretrace end"); break;
    case KW_RECURSION_LIMIT:
        parse_skip(p);
        r->recursion_limit = parse_int(p);
        if (r->recursion_limit < 1 || r->recursion_limit > 20)
            parse_fail(p, "Radiosity recursion limit must be in the range 1 to 20.");
        break;
    case KW_NORMAL: parse_skip(p); r->normal = yes(p); break;
    case KW_MEDIA: parse_skip(p); r->media = yes(p); break;
    case KW_SUBSURFACE: parse_skip(p); r->subsurface = yes(p); break;
    case KW_LOAD_FILE: case KW_SAVE_FILE:
        parse_skip(p);
        (void)parse_file_name(p);
        parse_warn(p, "load_file and save_file of radiosity are set by the command line; ignored here.");
        break;
    default: return false;
    }
    return true;
}

static void radiosity(Parser *p, Scene *scene)
{
    RadiosityDef *r = &scene->globals.radiosity;
    Reuse reuse = { false, false };
    block_open(p, "radiosity");
    r->on = true;
    while (radiosity_item(p, r, &reuse))
        ;
    block_close(p, "radiosity");
    if (r->pretrace_end > r->pretrace_start)
        parse_fail(p, "Radiosity pretrace end must be smaller than or equal to pretrace start.");
    if (reuse.minimum && reuse.maximum && r->minimum_reuse >= r->maximum_reuse)
        parse_fail(p, "Radiosity maximum_reuse must be larger than minimum_reuse.");
    if (r->minimum_reuse > r->maximum_reuse / 2) {
        if (reuse.maximum && !reuse.minimum)
            r->minimum_reuse = r->maximum_reuse / 2;
        else if (reuse.minimum && !reuse.maximum)
            r->maximum_reuse = r->minimum_reuse * 2;
    }
    if (parse_version(p) < 350)
        parse_warn(p, "In POV-Ray v3.5 and later a radiosity block in global_settings switches radiosity on.");
}

/* ---- photons ---- */

static const PhotonsDef PHOTONS_DEFAULT = {
    .spacing = 1, .adc_bailout = -1, .autostop = 0.5f, .expand_increase = 0.2f, .expand_min = 35, .jitter = 0.4f,
    .media_factor = 1, .radius = -1, .gather_min = 20, .gather_max = 100, .max_trace_level = -1,
};

static void photons_gather(Parser *p, PhotonsDef *f)
{
    f->gather_min = parse_int(p);
    parse_comma(p);
    f->gather_max = parse_int(p);
    if (f->gather_min < 0)
        parse_fail(p, "min_gather_count cannot be negative.");
    if (f->gather_max < 0)
        parse_fail(p, "max_gather_count cannot be negative.");
    if (f->gather_min > f->gather_max && f->gather_max != 0)
        parse_fail(p, "min_gather_count must be less than max_gather_count.");
}

static void photons_media(Parser *p, PhotonsDef *f)
{
    f->media_max_steps = parse_int(p);
    if (f->media_max_steps < 0)
        parse_fail(p, "max media steps must be non-negative.");
    parse_comma(p);
    if (parse_at_number(p)) {
        f->media_factor = number(p);
        if (!(f->media_factor > 0))
            parse_fail(p, "media spacing factor must be greater than zero.");
    }
    f->media = f->media_max_steps > 0;
}

static void photons_thresholds(Parser *p, PhotonsDef *f)
{
    f->expand_increase = number(p);
    parse_comma(p);
    f->expand_min = parse_int(p);
    if (f->expand_increase < 0) {
        parse_warn(p, "expand_thresholds: a negative increase is taken as 0.");
        f->expand_increase = 0;
    }
    if (f->expand_min < 0) {
        parse_warn(p, "expand_thresholds: a negative minimum is taken as 0.");
        f->expand_min = 0;
    }
}

static void photons(Parser *p, Scene *scene)
{
    PhotonsDef *f = &scene->globals.photons;
    bool load = false, save = false, more = true;
    *f = PHOTONS_DEFAULT;
    block_open(p, "photons");
    while (more) {
        switch (parse_peek(p)) {
        case KW_COUNT: parse_skip(p); f->count = parse_int(p); break;
        case KW_SPACING: parse_skip(p); f->spacing = number(p); break;
        case KW_GATHER: parse_skip(p); photons_gather(p, f); break;
        case KW_MEDIA: parse_skip(p); photons_media(p, f); break;
        case KW_JITTER: parse_skip(p); f->jitter = number(p); break;
        case KW_MAX_TRACE_LEVEL: parse_skip(p); f->max_trace_level = parse_int(p); break;
        case KW_ADC_BAILOUT: parse_skip(p); f->adc_bailout = number(p); break;
        case KW_AUTOSTOP: parse_skip(p); f->autostop = number(p); break;
        case KW_EXPAND_THRESHOLDS: parse_skip(p); photons_thresholds(p, f); break;
        case KW_RADIUS:
            parse_skip(p);
            f->radius = parse_at_number(p) ? number(p) : -1;
            for (int i = 0; i < 3; i++)
                (void)parse_optional_float(p, 0);
            break;
        case KW_LOAD_FILE: parse_skip(p); (void)parse_file_name(p); load = true; break;
        case KW_SAVE_FILE: parse_skip(p); (void)parse_file_name(p); save = true; break;
        default: more = false;
        }
    }
    block_close(p, "photons");
    if (load && save)
        parse_warn(p, "Cannot both load and save a photon map.");
    f->on = f->gather_max > 0;
    if (!f->on)
        parse_warn(p, "Photons turned off: gather has a maximum of 0.");
    if (f->on)
        scene->unmodelled |= SCENE_HAS_PHOTONS;
}

/* ---- global_settings ---- */

void globals_init(Parser *p, Globals *g)
{
    *g = (Globals){
        .adc_bailout = 1.0 / 255, .max_trace_level = 5, .ambient_light = { 1, 1, 1 },
        .irid_wavelength = { 0.70f, 0.52f, 0.48f }, .mm_per_unit = 10, .number_of_waves = 10,
        .noise_generator = parse_version(p) < 350 ? 1 : 2, .radiosity = RADIOSITY_DEFAULT, .photons = PHOTONS_DEFAULT,
        .subsurface_samples_diffuse = 50, .subsurface_samples_single = 50,
    };
}

static void assumed_gamma(Parser *p, Globals *g)
{
    GammaMode mode = GAMMA_POWER;
    double value = 1;
    if (parse_accept(p, KW_SRGB)) {
        mode = GAMMA_SRGB;
        value = 2.2;
    } else {
        value = parse_float(p);
        if (value <= 0)
            parse_fail(p, "gamma value must be positive.");
        if (value < 1)
            parse_warn(p, "Suspicious value for assumed_gamma: %g. Values below 1 are hardly ever meant.", value);
    }
    if (g->has_assumed_gamma) {
        parse_warn(p, "New instance of assumed_gamma ignored");
        return;
    }
    g->has_assumed_gamma = true;
    g->assumed_gamma = mode;
    g->assumed_gamma_value = value;
    p->has_gamma = true;
    p->gamma_mode = mode;
    p->gamma = value;
}

static void charset(Parser *p)
{
    switch (parse_peek(p)) {
    case KW_ASCII: p->charset = CHARSET_ASCII; break;
    case KW_UTF8: p->charset = CHARSET_UTF8; break;
    case KW_SYS: p->charset = CHARSET_SYS; break;
    default: parse_expected(p, "charset type");
    }
    parse_skip(p);
}

static void subsurface(Parser *p, Globals *g)
{
    block_open(p, "subsurface");
    g->subsurface = true;
    for (;;) {
        if (parse_accept(p, KW_SAMPLES)) {
            g->subsurface_samples_diffuse = parse_int(p);
            parse_comma(p);
            g->subsurface_samples_single = parse_int(p);
        } else if (parse_accept(p, KW_RADIOSITY)) {
            g->subsurface_radiosity = yes(p);
        } else {
            break;
        }
    }
    block_close(p, "subsurface");
}

static void max_trace_level(Parser *p, Globals *g)
{
    int n = parse_int(p);
    if (n > 256)
        parse_warn(p, "Maximum max_trace_level is 256 but %d was specified.", n);
    g->max_trace_level = n < 1 ? 1 : n > 256 ? 256 : n;
}

static void max_intersections(Parser *p)
{
    (void)parse_float(p);
    if (parse_version(p) >= 370)
        parse_warn(p, "'max_intersections' is no longer needed and has no effect in POV-Ray v3.7 or later.");
}

static void noise_generator(Parser *p, Globals *g)
{
    int n = parse_int(p);
    if (n < 1 || n > 3)
        parse_fail(p, "Value for noise_generator in global_settings must be 1, 2, or 3.");
    g->noise_generator = n;
    parse_blocks(p)->has_noise_generator = true;
}

static bool globals_item(Parser *p, Scene *scene)
{
    Globals *g = &scene->globals;
    switch (parse_peek(p)) {
    case KW_ADC_BAILOUT: parse_skip(p); g->adc_bailout = parse_float(p); break;
    case KW_AMBIENT_LIGHT: parse_skip(p); g->ambient_light = parse_rgb(p); break;
    case KW_ASSUMED_GAMMA: parse_skip(p); assumed_gamma(p, g); break;
    case KW_CHARSET: parse_skip(p); charset(p); break;
    case KW_HF_GRAY_16:
        parse_skip(p);
        g->hf_gray_16 = parse_optional_bool(p, true);
        parse_warn(p, "hf_gray_16 deprecated; use the option Grayscale_Output instead.");
        break;
    case KW_IRID_WAVELENGTH: parse_skip(p); g->irid_wavelength = parse_rgb(p); break;
    case KW_MAX_INTERSECTIONS: parse_skip(p); max_intersections(p); break;
    case KW_MAX_TRACE_LEVEL: parse_skip(p); max_trace_level(p, g); break;
    case KW_MM_PER_UNIT: parse_skip(p); g->mm_per_unit = parse_float(p); break;
    case KW_NOISE_GENERATOR: parse_skip(p); noise_generator(p, g); break;
    case KW_NUMBER_OF_WAVES:
        parse_skip(p);
        g->number_of_waves = parse_int(p);
        if (g->number_of_waves <= 0) {
            parse_warn(p, "Illegal Value: number_of_waves must be greater than 0. Changed to 1.");
            g->number_of_waves = 1;
        }
        break;
    case KW_PHOTONS: parse_skip(p); photons(p, scene); break;
    case KW_RADIOSITY: parse_skip(p); radiosity(p, scene); break;
    case KW_SUBSURFACE: parse_skip(p); subsurface(p, g); break;
    default: return false;
    }
    return true;
}

void globals_block(Parser *p)
{
    block_open(p, "global_settings");
    while (globals_item(p, parse_blocks(p)->scene))
        ;
    block_close(p, "global_settings");
}

/* At scene level, for old scenes. */
bool globals_old_item(Parser *p)
{
    Globals *g = &parse_blocks(p)->scene->globals;
    if (parse_accept(p, KW_MAX_TRACE_LEVEL)) {
        parse_warn(p, "'max_trace_level' should be in global_settings block.");
        max_trace_level(p, g);
        return true;
    }
    if (parse_accept(p, KW_MAX_INTERSECTIONS)) {
        parse_warn(p, "'max_intersections' should be in global_settings block.");
        max_intersections(p);
        return true;
    }
    return false;
}
