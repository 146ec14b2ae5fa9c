/* scene_text.h - a scene from its text to its World, for tests that ask rays. Images are found in tests/vectors/inputs. */
#ifndef LIB_SCENE_TEXT_H
#define LIB_SCENE_TEXT_H

#include "compile/compile.h"
#include "world/prim.h"

typedef struct SceneText {
    Arena arena;
    Diag *diag;
    Query *query;
    Scene scene;
    World world;
    const char *accel;                         /* set before; NULL: the best */
    char messages[4096];                       /* warnings and errors */
} SceneText;

/* False: see messages. Either way scene_text_end follows. */
bool scene_text(SceneText *s, const char *text);
void scene_text_end(SceneText *s);

/* As trace() answers for the first object: the point, and the unit normal not turned to the ray. */
bool scene_text_trace(const SceneText *s, Vec3 o, Vec3 d, Vec3 *point, Vec3 *normal);

#endif
