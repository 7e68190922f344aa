/* Changes of a scene that must not change its answer: for checks that need no truth. */
#ifndef BEAMWORK_SCENE_EDIT_H
#define BEAMWORK_SCENE_EDIT_H

#include "cases/scene/scene.h"

typedef enum scene_edit_kind {
    SCENE_EDIT_NONE,
    SCENE_EDIT_REVERSE, /* every member runs from its q to its p */
    SCENE_EDIT_SPLIT,   /* the first member becomes two, that meet at `amount` of its length */
    SCENE_EDIT_UNIT /* all lengths in another unit, `amount` of them to the metre; quantities are
                       still reported in metres */
} scene_edit_kind;

typedef struct scene_edit {
    scene_edit_kind kind;
    double amount; /* fraction of the length, 0 .. 1; or units in 1 m */
} scene_edit;

/* REFUSED: a member that the change is not defined for. */
status scene_edit_apply(scene *s, const scene_edit *edit, fault *f);

#endif
