/* Inside of a model, for harness/model alone. */
#ifndef BEAMWORK_MODEL_IMPL_H
#define BEAMWORK_MODEL_IMPL_H

#include "harness/model/division.h"
#include "harness/model/eliminate.h"
#include "harness/model/entries.h"
#include "harness/model/features.h"
#include "harness/model/kinematics.h"
#include "harness/model/mesh.h"
#include "harness/model/state.h"

/* What has a rotation vector that is followed: a node's frame against another's, NONE: against the
 * fixed one. */
typedef struct mesh_turn {
    int from, node;
} mesh_turn;

struct model {
    model_mesh mesh; /* what others read: the first, by which they find it */
    const scene *scene;
    const element_type *given; /* as its file has it */
    element_type completed;    /* what mesh.type is where that leaves something out */
    double options[ELEMENT_MAX_OPTIONS];
    int keep_all;
    unsigned features, omits; /* what it has, and what it has not of what the scene has */
    section *section;  /* of the scene; behind them of members whose section changes: profile.h */
    int *profile;      /* [members] section of the first element */
    mesh_triad *triad; /* [triads], room for those of all nodes of all elements */
    int triads;
    int *kind_of_section; /* [sections] the first, or NONE */
    mesh_turn *turn;      /* [turns] in the order of turns.h */
    double size;          /* length of the longest member [m] */
    int asked;            /* elements of a piece of a member */
    division division;    /* of the members into elements */
    model_state *rest;    /* undeformed */
    int lines;
    char **line; /* what was left out */
};
_Static_assert(offsetof(struct model, mesh) == 0, "model_mesh_of finds it by the model's address");

/* mesh.c */
status mesh_build(model *m, fault *f);

/* coordinates.c */
status coordinates_number(model *m, fault *f);
status coordinates_note_left_out(model *m, fault *f, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* assemble.c */

#endif
