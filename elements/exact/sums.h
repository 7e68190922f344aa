/* What the Gauss points of a collocation element add up to, in terms of x at the nodes, and from there to the element's
 * variables: its unknowns and strains in the order of stages.h. */
#ifndef BEAMWORK_EXACT_SUMS_H
#define BEAMWORK_EXACT_SUMS_H

#include "elements/exact/stage.h"
#include "elements/exact/stages.h"

typedef struct sums {
    double g[STAGES_NODES][3]; /* gradient */
    double X[STAGES_NODES][STAGES_NODES]
            [9];               /* second derivatives, second node not before the first */
    double Y[STAGES_NODES][9]; /* with F */
    double FF[9], gF[3];
    double z[WARPING_MAX],
        dz[WARPING_MAX * STAGES_ALL]; /* arguments of the warping energy and their derivatives */
} sums;

/* Adds point i with the given derivatives of its energy (stage_material). */
void sums_add(const stages *s, int i, const stage *p, const double force[3],
              const double gradient[6], const double M[36], sums *a);

/* Arguments of the warping energy and, in Sz, its gradient with respect to them. */
void sums_warping(const stages *s, const double e[], const stage p[], sums *a, double Sz[]);

/* To gradient and Hessian in the element's variables, warping energy included. */
void sums_gather(const stages *s, const sums *a, double gradient[], double hessian[]);

/* Change of x and x' at point i that goes with a change of all variables. */
void sums_follow(const stages *s, int i, const double variables[], double x[3], double slope[3]);

#endif
