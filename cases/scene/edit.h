/* Changes of a scene that must not change its answer: for checks that need no truth. */
#ifndef BEAMWORK_SCENE_EDIT_H
#define BEAMWORK_SCENE_EDIT_H

#include "cases/scene/scene.h"

typedef enum scene_edit_kind {
    SCENE_EDIT_NONE,
    SCENE_EDIT_REVERSE, /* every member runs from its q to its p */
    SCENE_EDIT_SPLIT    /* the first member becomes two, that meet at `fraction` of its length */
} scene_edit_kind;

typedef struct scene_edit {
    scene_edit_kind kind;
    double fraction; /* of the length, 0 .. 1 */
} scene_edit;

/* REFUSED: a member that the change is not defined for. */
status scene_edit_apply(scene *s, const scene_edit *edit, fault *f);

#endif
