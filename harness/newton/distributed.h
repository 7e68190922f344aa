/* Loads along members as they act between vertices: their work on the displacements within elements
 * (elements/field), or what an element makes of them in its own equilibrium, and what goes through
 * sections. */
#ifndef BEAMWORK_MODEL_DISTRIBUTED_H
#define BEAMWORK_MODEL_DISTRIBUTED_H

#include "harness/newton/run_state.h"
#include "harness/section_forces/section_forces.h"

/* Of one element, at a path parameter. */
typedef struct distributed_loads {
    const equations *eq;
    const model *m;
    int element;
    double path;
} distributed_loads;

/* Does the load do its work within elements? Else halves of it go to their ends (applied.h). */
int distributed_spreads(const equations *, const scene_load *);

/* Does the element take it into its own equilibrium (element_type.along)? Dead forces on the whole
 * of it, along its line, in scenes without a motion. */
int distributed_takes(const equations *, int element, const scene_load *);
/* Those together. */
typedef struct distributed_taken {
    int acts;
    double force[3 * ELEMENT_ALONG_POINTS], mixed[3 * ELEMENT_MAX_STRAINS],
        H[ELEMENT_ALONG_COORDINATES * ELEMENT_ALONG_COORDINATES];
    along_output out; /* into the arrays above; its stresses into those of a slot */
} distributed_taken;
/* What acts at `path`; out->acts 0: nothing. */
void distributed_take(const equations *, int element, double path, distributed_taken *out);
/* forces[14] += what J^T sigma has not got in it, K[14 x 14] -= its derivative, as `out` has it.
 * gap[strains]: D(x) - e. */
void distributed_add_taken(const model *, const along_output *out, const double J[],
                           const double gap[], double forces[], double K[]);

/* forces[7 nodes] += what a load along a member times `scale` does on an element, K[7 nodes x 7
 * nodes] -= its derivative (NULL: not wanted); 0: nothing. Of one that the element takes: the
 * derivative of its forces by the load's size in the state, K untouched. */
int distributed_add_one(const equations *, const model_state *, const node_state x[], int element,
                        const scene_load *, double scale, double forces[], double K[]);
/* The same of all of them at `path`: of those that the element takes what J^T sigma has not got in
 * it, in a linear solution about `rest` all. `field`: without those that the element takes. */
int distributed_add(const equations *, const model_state *, const node_state x[], int element,
                    double path, double forces[], double K[]);
/* And of those that it takes alone. */
int distributed_add_own(const equations *, const model_state *, const node_state x[], int element,
                        double path, double forces[], double K[]);
/* Stresses of a state under what acts at `path` (sigma, C of stress_output); 0: it takes nothing.
 */
int distributed_stress(const equations *, const model_state *, const node_state x[], int element,
                       double path, const stress_output *, status *outcome);
int distributed_add_field(const equations *, const node_state x[], int element, double path,
                          double forces[], double K[]);

/* Does anything act along it? */
int distributed_acts(const distributed_loads *);
/* A load that begins, ends or acts between its ends, or SCENE_NONE. */
int distributed_jumps(const distributed_loads *);
/* What acts per initial length at x in [0, 1] of the element, on a section with this frame: loads
 * of its member, and what a rotating frame adds (of the section's turn too where rotary inertia is
 * active).  context: a distributed. */
void distributed_at(void *context, double x, const span_frame *, span_load *out);

#endif
