/* A dead force per length q(x) inside the equilibrium of a collocation element (derived here).
 * Between its nodes the force is F + g(x), with F that of the middle,
 *   g(x) = l0 (int_x^1 q - 1/2 int_0^1 q),
 * which takes the place of F in N of stages.h, while halves of int q stay at the nodes: the whole
 * is the potential with - int q . r.  F is in the axes G half way between the ends, and
 * so is the contribution of g, xi = G^T g: a turn psi of G in its own axes changes it by xi x psi.
 * The potential depends on G through xi alone, and is linear in it except for the effect of the
 * points. */
#ifndef BEAMWORK_EXACT_ALONG_H
#define BEAMWORK_EXACT_ALONG_H

#include "elements/collocation/stages.h"

/* Data of a kind of element; q at the points of element.h. */
typedef struct exact_along {
    double at[EXACT_STAGES_MAX][ELEMENT_ALONG_POINTS]; /* g at the stages [m] */
    double missed[ELEMENT_ALONG_POINTS][3]; /* of the work on the undeformed line, what the stages'
                                               quadrature misses: turns with G [m^2] */
    double half[ELEMENT_ALONG_POINTS];      /* of int q [m] */
} exact_along;

/* The frame G of an element's state, and g. */
typedef struct exact_along_frame {
    double q[2][4], u[4], size;                     /* of the nodes; their mean, and its length */
    double G[9], g[EXACT_STAGES_MAX][3], missed[9]; /* [N]; [N m], columns in axes of G */
    double xi[EXACT_STAGES_MAX][3];                 /* dimensionless */
} exact_along_frame;

void exact_along_prepare(const element_request *, const exact_stages *, exact_along *);
void exact_along_frame_of(const exact_stages *, const exact_along *, const node_state x[],
                          const double force[], exact_along_frame *);
/* Computes the terms that need the evaluated stages: ends, rotation, H, and the part of the
 * undeformed line in moment. moved[stages][3]: derivative of the energy by xi. */
void exact_along_finish(const exact_stages *, const exact_along *, const exact_along_frame *,
                        double moved[][3], along_output *);
/* Linear in the force, of the undeformed element. */
status exact_along_linear(const exact_stages *, const exact_along *, const node_state x[],
                          along_output *);
/* Derivatives by the size of along_output.rate. */
status exact_along_rate(const exact_stages *, const exact_along *, const node_state x[],
                        along_output *);

/* d(xi)/d(psi). */
static inline void exact_along_column(const double xi[3], double column[9])
{
    const double skew[9] = {0, -xi[2], xi[1], xi[2], 0, -xi[0], -xi[1], xi[0], 0};
    for (int i = 0; i < 9; i++)
        column[i] = skew[i];
}

#endif
