/* What the files of harness/newton share. */
#ifndef BEAMWORK_EQUATIONS_IMPL_H
#define BEAMWORK_EQUATIONS_IMPL_H

#include "harness/model/model.h"
#include "harness/newton/applied.h"
#include "harness/newton/run_state.h"

/* One element's equations in model coordinates. */
typedef struct element_part {
    status outcome;
    fault why;
    double incompatibility; /* |D(x) - e|/l */
    double force[MODEL_MAX_COORDINATES], K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
} element_part;

/* rotating_frame.c: force -= centrifugal force, K += its stiffness (NULL: not wanted), in element
 * coordinates; nothing where no frame turns. */
status rotating_frame_add(const equations *eq, const node_state x[], int element, double path,
                          double force[], double K[], fault *f);

/* loads.c: out[free + driven] += all of them, or those on vertices alone, not along elements. */
void loads_add(const equations *eq, const model_state *s, double path, double out[]);
void loads_add_at_vertices(const equations *eq, const model_state *s, double path, double out[]);
/* What those on vertices add to K. */
void loads_stiffness_at_vertices(const equations *eq, const model_state *s, double path,
                                 loads_entry, void *context);
void loads_subtract_at_vertices(const equations *eq, const model_state *s, double path, sparse *K);
/* And all of them, on a pattern of model.h. */
void loads_subtract_stiffness(const equations *eq, const model_state *s, double path, sparse *K);
/* REFUSED: a moment whose stiffness is not symmetric, which a symmetric matrix cannot hold. */
status loads_have_potential(const equations *eq, const model_state *s, double path, fault *f);

/* linearise_node.c: the moment [N m] about its axis that a node held about one axis alone takes
 * from its support in a state (sigma: as internal.h has it); 0: rounding. */
double linearise_held_moment(const equations *eq, const model_state *s, const double sigma[],
                             double path, int node, int axis);
/* Elements and loads give the derivatives of work in the exponential chart of a node's turn. Where
 * a node is held about one axis, equilibrium is that of the moments about the two others, which
 * that moment R about the axis h makes differ: K_ij += R/2, K_ji -= R/2 with h, i, j in cyclic
 * order. */
void linearise_add_held_moments(const equations *eq, const model_state *s, double path, sparse *K);
/* REFUSED: such a moment, which has no potential either. */
status linearise_held_have_potential(const equations *eq, const double sigma[], double path,
                                     fault *f);

#endif
