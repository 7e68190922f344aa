/* A scene meshed with one formulation.
 *
 * Coordinates.  Every vertex of the mesh has a frame (position r, orientation q)
 * and every element end a warping amplitude.  Scalars that can change are the
 * model's coordinates, in this order:
 *   [0, free)                          unknowns
 *   [free, free + driven)              prescribed along the path by drivers
 * What is held or depends on other coordinates (rigid offsets, rotation
 * sequences, shared angles) has no coordinate: it was left out.  An unknown
 * driver is a driven coordinate whose increment is found with the free ones; the coordinate its
 * condition names is free.
 *
 * Increments of coordinates are additive for translations, warping and angles,
 * and spatial rotation increments (exponential chart) for free rotations.
 * All second derivatives (offsets, sequences) are included in the tangent. */
#ifndef BEAMWORK_MODEL_H
#define BEAMWORK_MODEL_H

#include "cases/scene/scene.h"
#include "elements/element.h"
#include "harness/numerics/numerics.h"

typedef struct model model;

typedef struct model_request {
    const scene *scene;
    const element_type *type;
    const double *options; /* of the formulation; NULL: defaults */
    int elements;          /* per member */
    int keep_all;          /* 1: leave nothing out (same answer, more work) */
    unsigned omit; /* physics of the scene to be left out besides what the type does not offer */
} model_request;

/* What the formulation does not offer of the scene's physics is left out, and model_left_out says
 * so; REFUSED (with the reason) where that leaves nothing to solve: see harness/model/missing.h. */
status model_alloc(const model_request *, model **, fault *);
void model_free(model *);

typedef struct model_size {
    int elements, vertices, free, driven, strains, inner; /* per element for the last two */
    int kinds; /* of elements, each prepared once; identical ones share it */
    unsigned features;
} model_size;
model_size model_sizes(const model *);
/* 1: in this motion elements spread their mass along themselves. */
int model_spreads(const model *, int analysis);
/* The same with one element per member. */
status model_coarse(const model *, model **, fault *);
/* The same with twice as many elements. */
status model_halved(const model *, model **, fault *);
const scene *model_scene(const model *);
int model_keeps_all(const model *); /* model_request.keep_all */
/* The vertex that moves this one rigidly; itself: it has coordinates of its own. */
int model_body(const model *, int vertex);
/* 1: it is the vertex of a released end, behind those of nodes. */
int model_is_released(const model *, int vertex);
/* Longest member [m]: displacements are small or large beside it. */
double model_length(const model *);

/* Physics of the scene that it does not have: FEATURE_* and OMIT_* bits (missing.h). */
unsigned model_omits(const model *);
/* What it has of that: FEATURE_* bits. */
unsigned model_features(const model *);
/* What was left out, one line each ("warping coordinates of 12 ends: nothing warps there"). */
int model_left_out(const model *, const char *const **lines);

/* Why nothing that was evaluated counts: what the formulation says of itself
 * (element_type.trouble), once; NULL: nothing is wrong. */
const char *model_trouble(const model *);

/* Everything that changes along a path. A copy undoes a rejected step. */
typedef struct model_state model_state;

const char *model_formulation(const model *);
const double *model_options(const model *); /* of it, all of them */
unsigned model_limits(const model *);       /* LIMIT_* of its formulation */
unsigned model_leaves(const model *);       /* LEAVES_* of it */
/* Shape of a mode or state for identification and pictures: displacement (3), rotation (3) and
 * warping of every vertex in order along the members; returns vertices. u[vertices x 7],
 * position[vertices x 3] (undeformed). */
int model_shape(const model *, const double x[], double *u, double *position);
int model_member_vertices(const model *, int member,
                          int vertex[]); /* n + 1 in order; vertex NULL: count only */

/* Numbers that stresses of all elements and springs are: elements x strains, then six per spring.
 */
int model_stresses(const model *);
/* Section constants the model uses for a section of the scene. */
const section *model_section(const model *, int index);

#endif
