/* Words of the physics that a scene may leave out, as scene files have them. */
#ifndef BEAMWORK_SCENE_OMISSION_H
#define BEAMWORK_SCENE_OMISSION_H

#include "cases/scene/scene.h"

typedef struct scene_omission {
    unsigned feature; /* a bit of SCENE_OMITTABLE */
    const char *word;
} scene_omission;

/* All of them, in the order in which they are written, up to a word of NULL. */
extern const scene_omission scene_omissions[];

enum { SCENE_OMISSION_WORDS = 100 };
/* "shear, trapeze"; empty where there are none. */
void scene_omission_words(unsigned omits, char words[SCENE_OMISSION_WORDS]);

/* "haringx" */
const char *scene_shear_word(scene_shear theory);

#endif
