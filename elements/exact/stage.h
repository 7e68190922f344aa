/* One Gauss point of a collocation element: geometry, energy, and their derivatives with respect to x, x' and F (turn.h). */
#ifndef BEAMWORK_EXACT_STAGE_H
#define BEAMWORK_EXACT_STAGE_H

#include "elements/exact/constants.h"
#include "elements/exact/turn.h"

enum {
    STAGE_TURN = 0,
    STAGE_SLOPE = 3,
    STAGE_FORCE = 6,
    STAGE_SPACE = 9
}; /* places of x, x' and F */

typedef struct stage {
    double x[3], slope[3], kappa[3], N[3]; /* kappa: less that of the undeformed state */
    turn_form orientation, curvature;
} stage;

/* x [nodes x 3], N and dN [nodes]. */
void stage_at(int nodes, const double N[], const double dN[], const double x[],
              const double force[3], const double rest_kappa[3], stage *p);

/* Energy of a point as a function of (kappa, N): gradient [6] and Hessian [36]; T: its warping torque. */
double stage_material(const constants *c, const double kappa[3], const double N[3], double T,
                      double gradient[6], double M[36]);

/* Derivatives of kappa and N. */
void stage_rows(const stage *p, const double force[3], double D[6][STAGE_SPACE]);

/* w (D^T M D + second derivatives of kappa and N contracted with `gradient`). */
void stage_hessian(const stage *p, const double force[3], const double gradient[6],
                   const double M[36], double w, double D[6][STAGE_SPACE],
                   double H[STAGE_SPACE][STAGE_SPACE]);

#endif
