/* When iterative refinement of a linear solution ends, and how many digits it has then.
 *
 * Residuals come from element strains.  With factors off by part q of the solution (about eps times
 * the condition of K) every correction is q times the last one, until they settle where the
 * rounding of the forces keeps them (N.J. Higham, Accuracy and Stability of Numerical Algorithms
 * (2002), section 12.1): x is then the solution for loads rounded in their last digit, and the
 * correction is its error.  That level is a property of the problem, neither of the mesh nor of K:
 * a bar of length L pushed along an oblique axis has forces whose components are rounded; across
 * the bar eps P L^3/(3 EI) stands beside P L/(EA), eps (L/r)^2/3.  Square bars of side L/10 to
 * L/1e5, 1 to 256 elements, three oblique axes, every formulation: eps (L/side)^2 times 2.5 at most
 * where that is above what the mesh rounds (170 times for the geometrically exact element, whose
 * factors are the worst), whatever the condition, which goes from 1 to 2e16, and q from 0 to 0.08
 * (0.8 for that element). */
#ifndef BEAMWORK_REFINEMENT_H
#define BEAMWORK_REFINEMENT_H

#include "elements/shared/status.h"

typedef enum refinement_state {
    REFINEMENT_GOES_ON,
    REFINEMENT_ENDS,
    REFINEMENT_LOST
} refinement_state;

/* Begins as {0}. */
typedef struct solution_refinement {
    int corrections; /* the first is the solution itself */
    double last;     /* in parts of the solution */
} solution_refinement;

/* What follows from a correction, in parts of the solution: at least two after the first, and on
 * while they halve and digits are missing. */
refinement_state refinement_next(solution_refinement *, double correction);
/* Are the digits enough that a last correction, or another measure of the error, leaves? */
refinement_state refinement_judge(solution_refinement *, double correction);
/* SINGULAR, with the digits that are left of `what` and what helps. */
status refinement_refuse(const solution_refinement *, const char *what, fault *);
/* |change|/|x| in a metric of n weights, |x| of at least `least`; 0: no change. */
double refinement_part(int n, const double weight[], const double change[], const double x[],
                       double least);

#endif
