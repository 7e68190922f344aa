/* Tangent of a structure in a deformed state about one node, where some of the node's prescribed
 * motion is released: its reaction has become a load. */
#ifndef BEAMWORK_TANGENT_H
#define BEAMWORK_TANGENT_H

#include "harness/model/model.h"
#include "harness/newton/border.h"

typedef struct node_tangent {
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled, and what is
                                released is unknown with the rest */
    sparse K;         /* of all coordinates when something is released, else of the free ones */
    sparse inside;    /* free x free */
    sparse geometric; /* like K, where solutions are refined: see stiffness_parts_geometric */
    int refined;      /* 1: the condition asks for it */
    /* Of `inside`, as it was estimated last (0: never), and how far its pivots were apart then. */
    double condition, apart;
    matrix_factor *own;    /* NULL: not needed so far */
    matrix_factor *factor; /* of `inside`: own, or that of the iteration that it was taken from */
    border border;
    int free, all;
    double *residual;
    const model_state *state;                   /* of K */
    int index[TANGENT_COMPONENTS], coordinates; /* the node's */
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS];
} node_tangent;

/* members: whose chains it shares, to be taken from an iteration; NULL: none. */
status tangent_alloc(analysis_context *c, const scene_compliance *a, const condensation *members,
                     node_tangent *t, fault *f);
void tangent_free(node_tangent *t);
/* reaction[6]: force and moment of the prescription on the node [N, N m]. */
status tangent_at(analysis_context *c, const scene_compliance *a, const model_state *s,
                  const double reaction[6], node_tangent *t, fault *f);
/* The same from K [the pattern of all coordinates when something is released, else of the free
 * ones] of an iteration that ended at the state, and its factors. */
status tangent_take(analysis_context *c, const scene_compliance *a, const model_state *s,
                    const double reaction[6], const sparse *K, const sparse *inside,
                    matrix_factor *, node_tangent *t, fault *f);
/* The same from the condensed members of the iteration. */
status tangent_take_condensed(analysis_context *c, const scene_compliance *a, const model_state *s,
                              const double reaction[6], const condensation *members,
                              node_tangent *t, fault *f);
/* Takes out of the reaction's moment what acts along free turns: there is no prescription that
 * exerts it. */
void tangent_prescribed(const node_tangent *t, double moment[3]);
/* Motions that the node can make at all. */
void tangent_movable(const model *m, const node_tangent *t, movable *out);
/* C[6 x 6] of the node with the reaction's moment as convention.h has it; columns outside `wanted`,
 * and rows and columns of what is not among the `components` that can move, stay zero. */
status tangent_compliance(analysis_context *c, node_tangent *t, unsigned wanted,
                          unsigned components, double C[36], fault *f);

#endif
