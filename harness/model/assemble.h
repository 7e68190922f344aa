/* Patterns of the matrices of a model. */
#ifndef BEAMWORK_MODEL_ASSEMBLE_H
#define BEAMWORK_MODEL_ASSEMBLE_H

#include "harness/model/model.h"

/* Patterns. `with_driven` 0: free x free; 1: all coordinates. Made at the first call and owned by
 * the model; matrices on it come from sparse_alloc_like. Symmetric: of the undeformed state. */
status assemble_pattern(model *, int with_driven, const sparse **out, fault *f);
/* Of any state: stored whole where a load may make tangents unsymmetric, and then symmetric by its
 * numbers. */
status assemble_pattern_of_states(model *, int with_driven, const sparse **out, fault *f);
/* 0: a load or a support may make tangents unsymmetric. */
int assemble_symmetric(const model *);
/* Free x free and never symmetric: of motions, whose turning masses are not. */
status assemble_pattern_in_time(model *, const sparse **out, fault *f);

#endif
