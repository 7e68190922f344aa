/* What a load puts on the vertices of a mesh, in a state. */
#ifndef BEAMWORK_MODEL_APPLIED_H
#define BEAMWORK_MODEL_APPLIED_H

#include "harness/newton/run_state.h"

typedef struct applied {
    int vertex;
    int follower;  /* 1: F turns with the vertex */
    int offset;    /* 1: arm is not zero */
    double F[6];   /* force and spatial moment [N, N m] */
    double arm[3]; /* from the vertex to where the force acts, with which it turns [m] */
} applied;

/* What the load is times at `path`, or in time (loading_of). */
double applied_factor(const equations *, const scene_load *load, double path);
/* Along the whole of a member, where it goes to nodes with a motion's mass by the shares of that;
 * not by the load's own wish. */
int applied_with_mass(const scene_load *);
/* The load times `scale`.  Along members it is lumped at the nodes of elements, by linear shares,
 * or quadratic ones with a middle node: of a uniform load 1/2, 1/2, or Simpson's weights. */
void applied_each(const model *, const model_state *, const scene_load *, double scale,
                  void (*take)(void *context, const applied *), void *context);
/* The same of a load along the member of this element, and of this element alone. */
void applied_element(const model *, const model_state *, const scene_load *, double scale,
                     int element, void (*take)(void *context, const applied *), void *context);
/* The part [from, to] of an element that a load along its member acts on; of one at a place both
 * are it, in the element behind it. 0: it acts elsewhere. */
int applied_part(const model *, int element, const scene_load *, double part[2]);
/* Is that inside the element, not at an end of it? */
int applied_inside(double x);
/* Vector of a load along the member at x in [0, 1] of an element, as the scene gives it. */
void applied_vector(const model *, int element, const scene_load *, double x, double vector[3]);
/* The undeformed member's axes, y as the scene gives it, from the triad of a place of it, whose y
 * and z are the principal ones of the section. */
void applied_member_axes(const double triad[9], const section *, double axes[9]);

/* What the load times `scale` adds to K, entry by entry; some are zero, some at the same place. */
typedef void (*loads_entry)(void *context, int row, int column, double value);
void applied_stiffness(const model *, const model_state *, const scene_load *, double scale,
                       loads_entry take, void *context);

#endif
