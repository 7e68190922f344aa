#include "cases/scene/omission.h"

#include <stddef.h>
#include <stdio.h>

const scene_omission scene_omissions[] = {{FEATURE_SHEAR, "shear"},
                                          {FEATURE_TRAPEZE, "trapeze"},
                                          {FEATURE_WAGNER_MOMENTS, "wagner_moments"},
                                          {FEATURE_WAGNER_TORQUE, "wagner_torque"},
                                          {FEATURE_ROTARY_INERTIA, "rotary_inertia"},
                                          {FEATURE_WARPING, "warping"},
                                          {0, NULL}};

void scene_omission_words(unsigned omits, char words[SCENE_OMISSION_WORDS])
{
    int used = 0;
    words[0] = '\0';
    for (const scene_omission *o = scene_omissions; o->word != NULL; o++)
        if (omits & o->feature)
            used += snprintf(words + used, (size_t)(SCENE_OMISSION_WORDS - used), "%s%s",
                             used > 0 ? ", " : "", o->word);
}

const char *scene_shear_word(scene_shear theory)
{
    static const char *const word[] = {[SCENE_SHEAR_HARINGX] = "haringx",
                                       [SCENE_SHEAR_ENGESSER] = "engesser",
                                       [SCENE_SHEAR_OWN] = "own"};
    return word[theory];
}
