/* What entries of a scene are called: as the user named them, or by their number. */
#ifndef BEAMWORK_SCENE_NAMES_H
#define BEAMWORK_SCENE_NAMES_H

#include "cases/scene/scene.h"

typedef enum scene_list {
    SCENE_SECTIONS,
    SCENE_NODES,
    SCENE_MEMBERS,
    SCENE_SPRINGS,
    SCENE_DRIVERS,
    SCENE_LOADS,
    SCENE_ANALYSES,
    SCENE_QUANTITIES
} scene_list;
enum { SCENE_LISTS = SCENE_QUANTITIES + 1 };

typedef struct scene_words {
    char text[SCENE_NAME + 16];
} scene_words;

/* How many entries the list has; "node". */
int scene_count(const scene *s, scene_list list);
const char *scene_list_word(scene_list list);
/* A longer name is cut off; where there is no such entry nothing is done. */
void scene_set_name(scene *s, scene_list list, int index, const char *name);
/* "" where it has none, or is no entry. */
const char *scene_own_name(const scene *s, scene_list list, int index);
/* "node_3", which no other entry of the list is called. */
scene_words scene_numbered(const scene *s, scene_list list, int index);
/* "tip"; without a name by its number. */
scene_words scene_name(const scene *s, scene_list list, int index);
/* For messages: "node tip", without a name "node 3". */
scene_words scene_called(const scene *s, scene_list list, int index);

#endif
