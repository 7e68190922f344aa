/* How far apart two states are. */
#ifndef BEAMWORK_MODEL_METRIC_H
#define BEAMWORK_MODEL_METRIC_H

#include "harness/model/model.h"

/* Weights [free + driven] of the square of an increment, (displacement/size)^2 + rotation^2 in the
 * mean over the bodies. */
void metric_of(const model *, double weight[]);
/* What the displacements of the nodes have of an increment [free + driven], measured so. */
double metric_shift_part(const model *, const double dx[]);
/* The same distance between two states; light[9 x (2 i + block)], row-major: projections of what
 * vertex i moved (block 0) and turned in its own axes (block 1) that do not count; NULL: all does.
 */
double metric_distance(const model *, const model_state *, const model_state *,
                       const double light[]);
/* The largest angle [rad] between the orientations of a node in two states. */
double metric_turn_between(const model *, const model_state *, const model_state *);

#endif
