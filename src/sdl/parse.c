/* parse.c - a scene from its first token to its last, and #default. */
#include <string.h>

#include "sdl/blocks.h"
#include "sdl/parser.h"

/* ---- #default ---- */

static void default_texture(Parser *p, Blocks *b)
{
    const Texture *t = parse_texture(p);
    if (t->kind != TEXTURE_PLAIN)
        parse_fail(p, "Default texture cannot be material map or tiles.");
    if (t->below != NULL)
        parse_fail(p, "Default texture cannot be layered.");
    b->default_texture = t;
}

void block_default(Parser *p)
{
    Blocks *b = parse_blocks(p);
    block_open(p, "default");
    for (;;) {
        switch (parse_peek(p)) {
        case KW_TEXTURE: default_texture(p, b); break;
        case KW_PIGMENT: case KW_NORMAL: case KW_FINISH:
            b->default_texture = texture_part(p, b->default_texture);
            break;
        case KW_CAMERA:
            parse_skip(p);
            b->default_camera = camera_block(p);
            break;
        case KW_RADIOSITY: importance_block(p); break;
        default: block_close(p, "default"); return;
        }
    }
}

void block_version(Parser *p)
{
    Blocks *b = parse_blocks(p);
    if (b != NULL && !b->has_noise_generator)
        b->scene->globals.noise_generator = parse_version(p) < 350 ? 1 : 2;
}

/* ---- the scene ---- */

static void camera(Parser *p, Scene *scene)
{
    parse_skip(p);
    if (scene->has_camera && parse_version(p) >= 350)
        parse_warn(p, "More than one camera: the last one counts.");
    scene->camera = camera_block(p);
    scene->has_camera = true;
}

static void sky_sphere(Parser *p, Scene *scene)
{
    parse_skip(p);
    if (scene->sky_sphere != NULL)
        parse_warn(p, "Only one sky-sphere allowed (last one will be used).");
    scene->sky_sphere = sky_sphere_block(p);
}

static bool statement(Parser *p, Blocks *b)
{
    switch (parse_peek(p)) {
    case TOK_END: return false;
    case KW_CAMERA: camera(p, b->scene); return true;
    case KW_GLOBAL_SETTINGS: parse_skip(p); globals_block(p); return true;
    case KW_BACKGROUND: parse_skip(p); background_block(p); return true;
    case KW_FOG: parse_skip(p); array_push(p->arena, &b->fog, fog_block(p)); return true;
    case KW_RAINBOW: parse_skip(p); array_push(p->arena, &b->rainbow, rainbow_block(p)); return true;
    case KW_SKY_SPHERE: sky_sphere(p, b->scene); return true;
    case KW_MEDIA:
        parse_skip(p);
        array_push(p->arena, &b->media, media_block(p));
        return true;
    default:
        if (!scene_object(p) && !globals_old_item(p) && !parse_bare_directive(p))
            parse_expected(p, "object or directive");
        return true;
    }
}

/* What the end of the file decides: gamma, versions, noise. */
static void settle(Parser *p, Blocks *b)
{
    Globals *g = &b->scene->globals;
    g->version = p->version_given ? p->version : 362;      /* POV: a scene that says nothing is of 3.62 */
    if (!g->has_assumed_gamma && g->version >= 370) {
        parse_warn(p, "assumed_gamma not specified, so gamma_correction is turned on with assumed_gamma 1.0.");
        g->assumed_gamma = GAMMA_POWER;
        g->assumed_gamma_value = 1;
    }
    for (uint32_t i = 0; i < b->scene_noise.n; i++)
        b->scene_noise.data[i]->noise_generator = (uint8_t)g->noise_generator;
}

static void finish(Parser *p, Blocks *b)
{
    Scene *s = b->scene;
    settle(p, b);
    s->object = b->object.data;
    s->n_objects = b->object.n;
    s->fog = b->fog.data;
    s->n_fog = b->fog.n;
    s->rainbow = b->rainbow.data;
    s->n_rainbow = b->rainbow.n;
    s->media = b->media.data;
    s->n_media = b->media.n;
    s->default_texture = b->default_texture;
    if (s->n_objects == 0)
        parse_warn(p, "No objects in scene.");
    if (!s->has_camera)
        s->camera = b->default_camera;
}

void sdl_parse(Arena *scene_arena, Diag *diag, const SdlHost *host, const SdlOptions *options, Str path, Str text, Scene *out)
{
    Parser *volatile p = parser_new(scene_arena, diag, host, options, path, text);
    jmp_buf callers;
    memcpy(&callers, diag_landing(diag), sizeof callers);
    if (setjmp(*diag_landing(diag)) != 0) {    /* a mistake: open files and temporary memory go, then on to the caller */
        parser_free(p);
        memcpy(diag_landing(diag), &callers, sizeof callers);
        longjmp(*diag_landing(diag), 1);
    }
    *out = (Scene){ 0 };
    p->blocks = blocks_new(p, out);
    globals_init(p, &out->globals);
    while (statement(p, p->blocks))
        ;
    parser_end(p);
    finish(p, p->blocks);
    parser_free(p);
    memcpy(diag_landing(diag), &callers, sizeof callers);
}
