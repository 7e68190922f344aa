/* Patterns of the matrices of a model. */
#ifndef BEAMWORK_MODEL_ASSEMBLE_H
#define BEAMWORK_MODEL_ASSEMBLE_H

#include "harness/model/model.h"

/* Those of one model that have been asked for. */
typedef struct assemble_patterns assemble_patterns;
status assemble_patterns_alloc(assemble_patterns **, fault *);
void assemble_patterns_free(assemble_patterns *);

/* Patterns. `with_driven` 0: free x free; 1: all coordinates. Made at the first call and kept
 * there; matrices on it come from sparse_alloc_like. Symmetric: of the undeformed state. */
status assemble_pattern(const model *, assemble_patterns *, int with_driven, const sparse **out,
                        fault *f);
/* Of any state: stored whole where a load may make tangents unsymmetric, and then symmetric by its
 * numbers. */
status assemble_pattern_of_states(const model *, assemble_patterns *, int with_driven,
                                  const sparse **out, fault *f);
/* 0: a load or a support may make tangents unsymmetric. */
int assemble_symmetric(const model *);
/* Free x free and never symmetric: of motions, whose turning masses are not. */
status assemble_pattern_in_time(const model *, assemble_patterns *, const sparse **out, fault *f);

#endif
