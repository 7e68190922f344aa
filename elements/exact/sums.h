/* What the Gauss points of a collocation element add up to, in terms of x at the nodes, and from
 * there to the element's variables: its unknowns and strains in the order of stages.h. */
#ifndef BEAMWORK_EXACT_SUMS_H
#define BEAMWORK_EXACT_SUMS_H

#include "elements/exact/stage.h"
#include "elements/exact/stages.h"

typedef struct exact_sums {
    double g[EXACT_STAGES_NODES][3]; /* gradient */
    double X[EXACT_STAGES_NODES][EXACT_STAGES_NODES]
            [9];                     /* second derivatives, second node not before the first */
    double Y[EXACT_STAGES_NODES][9]; /* with F */
    double FF[9], gF[3];
    double z[EXACT_WARPING_MAX],
        dz[EXACT_WARPING_MAX *
           EXACT_STAGES_ALL]; /* arguments of the warping energy and their derivatives */
} exact_sums;

/* Adds point i with the given derivatives of its energy (exact_stage_material). */
void exact_sums_add(const exact_stages *s, int i, const exact_stage *p, const double force[3],
                    const double gradient[6], const double M[36], exact_sums *a);

/* Arguments of the warping energy and, in Sz, its gradient with respect to them. */
void exact_sums_warping(const exact_stages *s, const double e[], const exact_stage p[],
                        exact_sums *a, double Sz[]);

/* To gradient and Hessian in the element's variables, warping energy included. */
void exact_sums_gather(const exact_stages *s, const exact_sums *a, double gradient[],
                       double hessian[]);

/* Change of x and x' at point i that goes with a change of all variables. */
void exact_sums_change(const exact_stages *s, int i, const double variables[], double x[3],
                       double slope[3]);

#endif
