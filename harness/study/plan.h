/* Which cells a verification consists of. */
#ifndef BEAMWORK_PLAN_H
#define BEAMWORK_PLAN_H

#include "harness/study/sweep.h"

/* Points: the defaults and every parameter point of a truth. */
status plan_sweep(const sweep_request *request, const truths *t, sweep *out, fault *f);
/* One point, the given formulations and meshes. */
status plan_one(const case_type *type, const double value[], const formulation those[], int count,
                const int mesh[], int meshes, sweep *out, fault *f);
/* A further point of a sweep that is planned by hand, its scene changed by the edit (NULL: not);
 * its steps and condition may be set before the run. */
status plan_add(sweep *s, const case_type *type, const double value[], const scene_edit *edit,
                const int mesh[], int meshes, fault *f);
/* Series of the last point, on its scene's meshes. */
status plan_extend(sweep *s, const formulation those[], int count, fault *f);
/* Finds again what the series of a point leave out, when its quantities have changed. */
void plan_omissions(sweep *s, int point_index);
#endif
