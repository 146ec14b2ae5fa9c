/* block.h - identifiers that hold blocks: what the core of the language and the block grammars give each other.
 *
 * A block value is a kind and a pointer to an immutable struct in the scene arena, so copying one is copying two words. */
#ifndef SDL_BLOCK_H
#define SDL_BLOCK_H

#include "sdl/parse.h"

typedef enum BlockKind {
    BLOCK_NONE,
    BLOCK_PIGMENT, BLOCK_NORMAL, BLOCK_FINISH, BLOCK_TEXTURE, BLOCK_MATERIAL,  /* Pigment ... Texture (top layer), Material */
    BLOCK_INTERIOR, BLOCK_MEDIA, BLOCK_DENSITY,                                /* Interior, Media, Pigment */
    BLOCK_COLOUR_MAP, BLOCK_PIGMENT_MAP, BLOCK_NORMAL_MAP, BLOCK_SLOPE_MAP, BLOCK_TEXTURE_MAP, BLOCK_DENSITY_MAP,  /* BlendMap */
    BLOCK_TRANSFORM, BLOCK_CAMERA,                                             /* Affine, CameraDef */
    BLOCK_FOG, BLOCK_RAINBOW, BLOCK_SKY_SPHERE, BLOCK_OBJECT                   /* FogDef, RainbowDef, SkySphere, Object */
} BlockKind;

/* Of the block grammars (block.c), for #declare, macro arguments and array elements: at a token that begins a block, reads
 * it whole (`texture {} texture {}` as one) and returns its value; BLOCK_NONE and NULL, with nothing read, elsewhere.
 * Identifiers are not looked at: those are the caller's to copy. */
const void *block_parse(Parser *p, BlockKind *kind);

/* For #default, at its brace, and after each #version. */
void block_default(Parser *p);
void block_version(Parser *p);

/* Of the core (symbols): the kind of the block held by the identifier, macro parameter or array element that comes next;
 * BLOCK_NONE when something else comes. Nothing is taken. */
BlockKind parse_peek_block(Parser *p);

/* Takes it if it is of this kind; NULL, with nothing taken, if not. */
const void *parse_take_block(Parser *p, BlockKind kind);

/* Is the next token a colour word (color, rgb, red...) or an identifier that holds a colour? (01-language, section 5) */
bool parse_at_colour(Parser *p);

void block_open(Parser *p, const char *word);  /* the brace after `word`, or "Missing { after 'word', ... found instead" */
void block_close(Parser *p, const char *word); /* the closing brace, or "No matching } in 'word', ... found instead" */

/* The next token as it stands in the text; no directive runs, no macro is called. TOK_END where a file, a loop or a macro ends. */
int parse_peek_raw(Parser *p);

/* "Expected 'what', ... found instead", with the next token described as 01-language section 33 says. */
_Noreturn void parse_expected(Parser *p, const char *what);

#endif
