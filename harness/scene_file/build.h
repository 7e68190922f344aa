/* A checked tree and values of its parameters -> a scene. */
#ifndef BEAMWORK_SCENE_BUILD_H
#define BEAMWORK_SCENE_BUILD_H

#include "cases/scene/scene.h"
#include "harness/language/scope.h"

/* names: the parameters. The scene is valid where no mistake was found. The caller frees it in any
 * case. */
void build_scene(const document_node *root, const scope *names, arena *a, mistakes *m, scene *out);

/* Sections only, and their constants as names, into a builder with root and names. */
struct builder;
void build_sections(struct builder *b);

#endif
