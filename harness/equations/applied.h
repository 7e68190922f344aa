/* What a load puts on the vertices of a mesh, in a state. */
#ifndef BEAMWORK_MODEL_APPLIED_H
#define BEAMWORK_MODEL_APPLIED_H

#include "harness/model/model.h"

typedef struct applied {
    int vertex;
    int follower;  /* 1: F turns with the vertex */
    int offset;    /* 1: arm is not zero */
    double F[6];   /* force and spatial moment [N, N m] */
    double arm[3]; /* from the vertex to where the force acts, with which it turns [m] */
} applied;

/* The load times `scale`.  Along members it is lumped, per initial length: 1/2, 1/2, or Simpson's
 * weights with a middle node. */
void applied_each(const model *, const model_state *, const scene_load *, double scale,
                  void (*take)(void *context, const applied *), void *context);
/* The same of a load along the member of this element, and of this element alone. */
void applied_element(const model *, const model_state *, const scene_load *, double scale,
                     int element, void (*take)(void *context, const applied *), void *context);
/* The undeformed member's axes, y as the scene gives it, from the triad of a place of it, whose y
 * and z are the principal ones of the section. */
void applied_member_axes(const double triad[9], const section *, double axes[9]);

/* What the load times `scale` adds to K, entry by entry; some are zero, some at the same place. */
typedef void (*loads_entry)(void *context, int row, int column, double value);
void applied_stiffness(const model *, const model_state *, const scene_load *, double scale,
                       loads_entry take, void *context);

#endif
