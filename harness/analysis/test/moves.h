/* Returns 1 for scenes with transient analyses only, and for frequencies of structures of which no
 * node is supported. These structures may have no static state. */
#ifndef BEAMWORK_TEST_MOVES_H
#define BEAMWORK_TEST_MOVES_H

#include "cases/scene/scene.h"

static inline int has_free_nodes_only(const scene *s)
{
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (s->node[i].translation[k] != SCENE_FREE)
                return 0;
    return 1;
}

static inline int moves_only(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind != SCENE_MOTION &&
            (s->analysis[i].kind != SCENE_MODAL || !has_free_nodes_only(s)))
            return 0;
    return s->analyses > 0;
}

#endif
