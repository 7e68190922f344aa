/* Identifies scenes that have only transient analyses. Such a structure may be free, and then has
 * no static state. */
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
