/* Returns 1 for scenes with transient analyses only. The structure may be unsupported, and then it
 * has no static state. */
#ifndef BEAMWORK_TEST_MOVES_H
#define BEAMWORK_TEST_MOVES_H

#include "cases/scene/scene.h"

static inline int moves_only(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind != SCENE_MOTION)
            return 0;
    return s->analyses > 0;
}

#endif
