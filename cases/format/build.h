/* A checked tree and values of its parameters -> a scene. */
#ifndef BEAMWORK_SCENE_BUILD_H
#define BEAMWORK_SCENE_BUILD_H

#include "cases/format/scope.h"
#include "cases/scene/scene.h"

/* Ends of members that say nothing of their warping: as their supports say, or all free, as earlier
 * versions had them. */
typedef enum build_ends { BUILD_BY_SUPPORTS, BUILD_FREE } build_ends;

/* names: the parameters. The scene is valid where no mistake was found. The caller frees it in any
 * case. */
void build_scene(const document_node *root, const scope *names, build_ends ends, arena *a,
                 mistakes *m, scene *out);

/* Sections only, and their constants as names, into a builder with root and names. */
struct builder;
void build_sections(struct builder *b);

#endif
