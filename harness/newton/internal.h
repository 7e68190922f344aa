/* Resultants of the stresses on the sections of a member.
 *
 * At the ends of an element they are what its nodal forces J^T sigma leave when the loads along it
 * that its nodes take are taken off: in equilibrium with everything beyond, whatever a formulation
 * assumes inside.  Between them harness/section_forces/section_forces.h carries them on, the same
 * way for all formulations. */
#ifndef BEAMWORK_MODEL_INTERNAL_H
#define BEAMWORK_MODEL_INTERNAL_H

#include "harness/newton/run_state.h"
#include "harness/section_forces/section_forces.h"

/* Which state. */
typedef struct internal_state {
    const model_state *s;
    const double *sigma; /* [elements x strains] stresses; NULL: those of the state */
    const double *x; /* of a linear solution about s, which is undeformed: its displacements [free +
                        driven]; NULL: s is in equilibrium */
    double path;     /* parameter of the loads */
    /* of a motion, else NULL */
    const struct internal_inertia *moving;
} internal_state;

/* Forces of inertia of one element of a motion. */
typedef struct internal_inertia {
    /* ends[2][7] += those of its lumped masses at its first and its last node */
    void (*ends)(const void *context, int element, double ends[2][7]);
    /* of a mass that lies evenly along it and moves as each node does, per initial length, in fixed
     * axes: density[nodes][force, moment about the node's frame] */
    void (*along)(const void *context, int element, double density[ELEMENT_MAX_NODES][6]);
    const void *context;
} internal_inertia;

/* Of what lies towards `to` on what lies towards `from`, in the principal axes of the turned
 * section, moments about its centroid: N, Qy, Qz [N], Mx, My, Mz [N m], bimoment [N m^2] (work:
 * that of the warping amplitude's rate). end: 0 from, 1 to. */
void internal_at_end(const equations *, const internal_state *, int member, int end, double out[7]);

/* A place of a member, 0 from .. 1 to of its initial length; before: on the side of `from` of what
 * jumps there. */
typedef struct internal_place {
    int member;
    double place;
    int before;
} internal_place;

/* The same at a place of a member, and what else section_forces.h has: out[SPAN_VALUES].
 * NOT_CONVERGED: as span_recover. Of a motion the mass lies evenly along an element again, with
 * accelerations that are interpolated between its nodes: of a linear acceleration the forces are
 * those of what lies beyond, so that values go through from element to element (order 2). Warping
 * inertia acts at nodes. */
status internal_at(const equations *, const internal_state *, const internal_place *, double out[],
                   fault *);

/* Largest value of `of` over a member, that of the section at x in [0, 1] of an element, counted
 * along the member, from its resultants [SPAN_VALUES]. */
typedef double (*internal_measure)(void *context, int element, double x, const double resultants[]);
status internal_largest(const equations *, const internal_state *, int member, internal_measure of,
                        void *context, double *out, fault *);

#endif
