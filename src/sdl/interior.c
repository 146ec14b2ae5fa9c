/* interior.c - interior, media and material blocks (01-language, section 31). */
#include "sdl/blocks.h"

static const Interior INTERIOR_DEFAULT = { .ior = 1, .dispersion = 1, .old_refraction = 1, .dispersion_samples = 7 };

static Media media_default(const Parser *p)
{
    Media m = {
        .method = 3, .intervals = 1, .samples_min = 10, .samples_max = 10, .aa_level = 3, .ratio = 0.9f,
        .confidence = 0.9f, .variance = 1.0f / 128, .aa_threshold = 0.1f, .collect = true, .scattering.extinction = 1,
    };
    if (parse_version(p) < 350) {
        m.method = 1;
        m.intervals = 10;
        m.samples_min = m.samples_max = 1;
    }
    return m;
}

static float number(Parser *p)
{
    return (float)parse_float(p);
}

static void scattering(Parser *p, Scattering *s)
{
    block_open(p, "scattering");
    s->type = parse_int(p);
    if (s->type < 1 || s->type > 5)
        parse_warn(p, "Scattering type %d is not one of 1 to 5.", s->type);
    parse_comma(p);
    s->colour = parse_rgb(p);
    s->extinction = 1;
    s->eccentricity = 0;
    for (;;) {
        if (parse_accept(p, KW_ECCENTRICITY)) {
            if (s->type != 5)
                parse_fail(p, "Eccentricity cannot be used with this scattering type.");
            s->eccentricity = number(p);
        } else if (parse_accept(p, KW_EXTINCTION)) {
            s->extinction = number(p);
        } else {
            break;
        }
    }
    block_close(p, "scattering");
}

static void samples(Parser *p, Media *m)
{
    m->samples_min = parse_int(p);
    m->samples_max = m->samples_min;
    parse_comma(p);
    if (parse_at_number(p))
        m->samples_max = parse_int(p);
    if (m->samples_min < 1)
        parse_fail(p, "At least one sample per interval is needed in media.");
    if (m->samples_max < m->samples_min)
        parse_fail(p, "Maximum number of samples per interval smaller than minimum number.");
}

static void add_density(Parser *p, Media *m, const Pigment *density)
{
    if (m->n_density == MAX_MEDIA)
        parse_fail(p, "a media has at most %d densities", MAX_MEDIA);
    const Pigment **all = arena_array(parse_arena(p), const Pigment *, m->n_density + 1);
    for (uint32_t i = 0; i < m->n_density; i++)
        all[i] = m->density[i];
    all[m->n_density++] = density;
    m->density = all;
}

static void move_densities(Parser *p, Media *m, const Moves *moves)
{
    const Pigment **all = arena_array(parse_arena(p), const Pigment *, m->n_density);
    for (uint32_t i = 0; i < m->n_density; i++)
        all[i] = pigment_moved(p, m->density[i], moves);
    m->density = all;
}

const Pigment *density_block(Parser *p)
{
    parse_expect(p, KW_DENSITY);
    block_open(p, "density");
    const Pigment *density = pigment_body(p, &PIGMENT_EMPTY, USE_DENSITY);
    block_close(p, "density");
    return density;
}

static bool media_item(Parser *p, Media *m)
{
    int keyword = parse_peek(p);
    Moves moves;
    switch (keyword) {
    case KW_METHOD:
        parse_skip(p);
        m->method = parse_int(p);
        if (m->method < 1 || m->method > 3)
            parse_fail(p, "Sample method choices are 1, 2, or 3.");
        break;
    case KW_INTERVALS:
        parse_skip(p);
        m->intervals = parse_int(p);
        if (m->intervals < 1)
            parse_fail(p, "At least one interval is needed in media.");
        break;
    case KW_SAMPLES: parse_skip(p); samples(p, m); break;
    case KW_RATIO: parse_skip(p); m->ratio = number(p); break;
    case KW_CONFIDENCE:
        parse_skip(p);
        m->confidence = number(p);
        if (!(m->confidence >= 0 && m->confidence < 1))
            parse_fail(p, "Illegal confidence value in media.");
        break;
    case KW_VARIANCE: parse_skip(p); m->variance = number(p); break;
    case KW_AA_THRESHOLD:
        parse_skip(p);
        m->aa_threshold = number(p);
        if (!(m->aa_threshold > 0))
            parse_fail(p, "aa_threshold in media must be greater than zero.");
        break;
    case KW_AA_LEVEL:
        parse_skip(p);
        m->aa_level = parse_int(p);
        if (m->aa_level < 1)
            parse_fail(p, "aa_level in media must be at least one.");
        break;
    case KW_JITTER: parse_skip(p); m->jitter = number(p); break;
    case KW_ABSORPTION: parse_skip(p); m->absorption = parse_rgb(p); break;
    case KW_EMISSION: parse_skip(p); m->emission = parse_rgb(p); break;
    case KW_SCATTERING: parse_skip(p); scattering(p, &m->scattering); break;
    case KW_COLLECT: parse_skip(p); m->collect = parse_optional_bool(p, true); break;
    case KW_DENSITY: add_density(p, m, density_block(p)); break;
    default:
        if (!parse_move(p, &moves.move[0]))
            return false;
        moves.n = 1;
        move_densities(p, m, &moves);
    }
    return true;
}

const Media *media_block(Parser *p)
{
    Loc loc = parse_loc(p);
    block_open(p, "media");
    const Media *known = parse_take_block(p, BLOCK_MEDIA);
    Media m = known != NULL ? *known : media_default(p);
    m.loc = loc;
    while (media_item(p, &m))
        ;
    block_close(p, "media");
    return arena_copy(parse_arena(p), &m, sizeof m);
}

static void add_media(Parser *p, Interior *i, const Media *media)
{
    if (i->n_media == MAX_MEDIA)
        parse_fail(p, "an interior has at most %d media", MAX_MEDIA);
    Media *all = arena_array(parse_arena(p), Media, i->n_media + 1);
    for (uint32_t k = 0; k < i->n_media; k++)
        all[k] = i->media[k];
    all[i->n_media++] = *media;
    i->media = all;
}

const Interior *interior_block(Parser *p, const Interior *base)
{
    Loc loc = parse_loc(p);
    block_open(p, "interior");
    const Interior *known = parse_take_block(p, BLOCK_INTERIOR);
    Interior i = known != NULL ? *known : base != NULL ? *base : INTERIOR_DEFAULT;
    i.loc = loc;
    bool more = true;
    while (more) {
        switch (parse_peek(p)) {
        case KW_IOR: parse_skip(p); i.ior = number(p); break;
        case KW_DISPERSION: parse_skip(p); i.dispersion = number(p); break;
        case KW_DISPERSION_SAMPLES:
            parse_skip(p);
            i.dispersion_samples = parse_int(p);
            if (i.dispersion_samples < 2) {
                parse_warn(p, "Dispersion samples must be at least 2. Changed to 2.");
                i.dispersion_samples = 2;
            }
            break;
        case KW_CAUSTICS: parse_skip(p); i.caustics = 45 * number(p); break;     /* POV: 45 here, as it is in a finish */
        case KW_FADE_DISTANCE: parse_skip(p); i.fade_distance = parse_float(p); break;
        case KW_FADE_POWER: parse_skip(p); i.fade_power = number(p); break;
        case KW_FADE_COLOR: parse_skip(p); i.fade_colour = parse_rgb(p); break;
        case KW_MEDIA: parse_skip(p); add_media(p, &i, media_block(p)); break;
        case KW_REFRACTION:
            parse_skip(p);
            parse_warn(p, "Use of 'refraction' in an interior is unnecessary and has no effect.");
            (void)parse_float(p);
            break;
        default: more = false;
        }
    }
    block_close(p, "interior");
    return arena_copy(parse_arena(p), &i, sizeof i);
}

const Interior *parse_interior(Parser *p)
{
    parse_expect(p, KW_INTERIOR);
    return interior_block(p, NULL);
}

/* Old finishes carry what is the interior's; it wins over what the interior says. */
const Interior *interior_with_finish(Parser *p, const Interior *base, const Finish *f)
{
    Interior i = base != NULL ? *base : INTERIOR_DEFAULT;
    if (f->has_ior)
        i.ior = f->ior;
    if (f->has_caustics)
        i.caustics = f->caustics;
    if (f->has_refraction)
        i.old_refraction = f->refraction;
    return arena_copy(parse_arena(p), &i, sizeof i);
}

const Interior *interior_moved(Parser *p, const Interior *interior, const Moves *moves)
{
    if (interior == NULL || interior->n_media == 0)
        return interior;
    Interior *i = arena_copy(parse_arena(p), interior, sizeof *interior);
    Media *all = arena_copy(parse_arena(p), i->media, i->n_media * sizeof *all);
    for (uint32_t k = 0; k < i->n_media; k++)
        if (all[k].n_density > 0)
            move_densities(p, &all[k], moves);
    i->media = all;
    return i;
}

const Material *material_block(Parser *p)
{
    block_open(p, "material");
    const Material *known = parse_take_block(p, BLOCK_MATERIAL);
    Material m = known != NULL ? *known : (Material){ 0 };
    for (;;) {
        Moves moves;
        int keyword = parse_peek(p);
        if (keyword == KW_TEXTURE) {
            m.texture = texture_layered(p, m.texture, parse_texture(p));
        } else if (keyword == KW_INTERIOR_TEXTURE) {
            m.interior_texture = texture_layered(p, m.interior_texture, parse_texture(p));
        } else if (keyword == KW_INTERIOR) {
            parse_skip(p);
            m.interior = interior_block(p, m.interior);
        } else if (parse_move(p, &moves.move[0])) {
            moves.n = 1;                       /* POV: the interior_texture stays where it is */
            m.texture = texture_moved(p, m.texture, &moves);
            m.interior = interior_moved(p, m.interior, &moves);
        } else {
            break;
        }
    }
    block_close(p, "material");
    return arena_copy(parse_arena(p), &m, sizeof m);
}
