/* A frame that turns steadily. */
#ifndef BEAMWORK_MODEL_ROTATING_FRAME_H
#define BEAMWORK_MODEL_ROTATING_FRAME_H

#include "harness/newton/run_state.h"

/* Mass matrix on the pattern of M about a state (NULL: undeformed); G: gyroscopic matrix of a
 * rotating frame, of which a symmetric pattern stores the upper triangle, or NULL: not wanted. */
status rotating_frame_inertia(const equations *, const model_state *, double path, sparse *M,
                              sparse *G, fault *);

/* 1: mass is at nodes, as the scene says or a motion that starts there has it. */
int rotating_frame_lumps(const equations *);

/* x^T B x of the undeformed structure, x[free + driven]: what the mass inside of elements adds to a
 * mode, k = lambda m + lambda^2 b (field/field_mass.h). */
double rotating_frame_inner(const model *, const double x[]);
/* B itself, with the pattern of a symmetric K. 0: no element has it, and it is zero. */
int rotating_frame_inner_matrix(const equations *, sparse *out);

/* What loads on offsets and moments add to K. */
void rotating_frame_load_stiffness(const equations *, const model_state *, double path,
                                   sparse *out);

#endif
