/* A scene -> a scene file that reads back as the same scene, bit for bit. */
#ifndef BEAMWORK_SCENE_WRITE_H
#define BEAMWORK_SCENE_WRITE_H

#include <stdio.h>

#include "cases/scene/scene.h"

typedef struct write_head {
    const char *name, *summary, *source;
} write_head;

/* Loops and expressions are written out, numbers with as many digits as they need. REFUSED: the
 * scene has something that no file can say. */
status write_scene(FILE *to, const scene *s, const write_head *head, fault *f);
/* The same in memory, which the caller frees; "" where there is no scene (NULL) or no file can say
 * it. NULL: out of memory. */
char *write_scene_text(const scene *s, const write_head *head);

#endif
