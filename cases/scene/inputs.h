/* What of a scene has part in which analysis: the one place that says it, by which analyses are
 * refused, `beamwork explain inputs` is printed, and a test walks all cells. */
#ifndef BEAMWORK_SCENE_INPUTS_H
#define BEAMWORK_SCENE_INPUTS_H

#include "cases/scene/scene.h"

/* As which an analysis counts: eigenvalues and compliances about a loaded state are others than
 * those about the undeformed one. */
typedef enum scene_column {
    SCENE_OF_LINEAR,
    SCENE_OF_STATIC,
    SCENE_OF_CONTINUATION,
    SCENE_OF_BUCKLING,
    SCENE_OF_BUCKLING_ABOUT,
    SCENE_OF_MODAL,
    SCENE_OF_MODAL_LINEAR,
    SCENE_OF_MODAL_ABOUT,
    SCENE_OF_COMPLIANCE,
    SCENE_OF_COMPLIANCE_ABOUT,
    SCENE_OF_ROTATION,
    SCENE_OF_MOTION,
    SCENE_COLUMNS
} scene_column;

typedef enum scene_part {
    SCENE_PART_USED = 'u',
    SCENE_PART_STATE = 's', /* used; refused in a state where the tangent is not symmetric */
    /* used in axes that turn, and about a path where the tangent is not symmetric, so that what is
     * in motion decides about stability; else it has no part */
    SCENE_PART_INERTIA = 'i',
    SCENE_PART_NONE = '-',   /* by what the analysis is: the answer is the same without */
    SCENE_PART_REFUSED = 'x' /* by name, that analysis alone */
} scene_part;

typedef struct scene_input {
    const char *name;                   /* "loads that follow" */
    const char part[SCENE_COLUMNS + 1]; /* scene_part */
    const char *why;                    /* it is refused, and what helps; NULL: it is nowhere */
    /* 1: the scene, or that analysis, has it; who: "load p". */
    int (*stands)(const scene *, int analysis, char *who, int size);
} scene_input;

/* The table; one without a name ends it. */
extern const scene_input scene_inputs[];
/* "buckling about a path" */
extern const char *const scene_column_name[SCENE_COLUMNS];

scene_column scene_column_of(const scene *, int analysis);
/* 1: it is about a state, and the scene has something that makes the tangent of some states not
 * symmetric: then masses decide about stability. */
int scene_inputs_flutter(const scene *, int analysis);
/* REFUSED: the analysis cannot have something that the scene has; the others may. */
status scene_inputs_check(const scene *, int analysis, fault *);

#endif
