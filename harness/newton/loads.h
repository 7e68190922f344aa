/* Loads and drivers along a path. */
#ifndef BEAMWORK_MODEL_LOADS_H
#define BEAMWORK_MODEL_LOADS_H

#include "harness/newton/run_state.h"

/* Of an analysis: in a motion the path parameter is the time, of which loads and drivers are
 * functions; what has none is whole. Axes turn as its own do, or those of the analysis whose states
 * it is about. */
loading loading_of(const model *, int analysis);
/* Of a known driver [m or rad]. */
double loads_driver_value(const equations *, const scene_driver *d, double path);
/* In time, also its first two derivatives; at the end of a piece: of the next one. What has no
 * function of time stays at its last value; of a load it is whole. */
void loads_driver_rates(const equations *, const scene_driver *d, double path, double out[3]);
/* out[free + driven] += the load times `scale` in a state. */
void loads_add_one(const equations *, const model_state *, const scene_load *, double scale,
                   double out[]);
/* Derivative of the loads by the path parameter in a state, out[free + driven]. */
void loads_rate(const equations *, const model_state *, double path, double out[]);
/* Loads of the undeformed state at `path`, f[free + driven]. */
void loads_reference(const equations *, double path, double f[]);
/* Is there a load, or a coordinate moved, at path 0? */
int loads_begin(const equations *);

/* Increments of the driven coordinates (dx[free .. free+driven)) that take the state to `path`; the
 * rest of dx untouched. */
void loads_drive(const equations *, const model_state *, double path, double dx[]);

/* An unknown driver: the driven coordinate `unknown` moves by what makes the free one `coordinate`
 * move by `increment`. The force on that coordinate stays free of reactions, the one on the driver
 * is whatever it takes. */
enum { MODEL_MAX_CONDITIONS = 4 };
typedef struct model_condition {
    int unknown, coordinate;
    double increment;
} model_condition;
int loads_conditions(const equations *, const model_state *, double path,
                     model_condition out[MODEL_MAX_CONDITIONS]);

/* K of a node turned by a sequence of angles, when the moment M that the angles' prescription
 * exerts becomes a load that is conservative in the exponential chart: the angles' own second
 * derivatives no longer belong to it. */
void loads_release_moment(const model *, const model_state *, int node, const double M[3],
                          sparse *K);
/* Force and spatial moment of the loads at `path` on a node's frame: F[6] [N, N m]. */
void loads_at_node(const equations *, const model_state *, double path, int node, double F[6]);

#endif
