/* One Gauss point of a collocation element: geometry, energy, and their derivatives with respect to
 * x, x' and F (milenkovic.h). */
#ifndef BEAMWORK_EXACT_STAGE_H
#define BEAMWORK_EXACT_STAGE_H

#include "elements/exact/milenkovic.h"
#include "elements/shared/beam_constants.h"

enum {
    EXACT_STAGE_MILENKOVIC = 0,
    EXACT_STAGE_SLOPE = 3,
    EXACT_STAGE_FORCE = 6,
    EXACT_STAGE_SPACE = 9
}; /* places of x, x' and F */

typedef struct exact_stage {
    double x[3], slope[3], kappa[3], N[3]; /* kappa: less that of the undeformed state */
    exact_milenkovic_form orientation, curvature;
} exact_stage;

/* x [nodes x 3], N and dN [nodes]. */
void exact_stage_at(int nodes, const double N[], const double dN[], const double x[],
                    const double force[3], const double rest_kappa[3], exact_stage *p);

/* Energy of a point as a function of (kappa, N): gradient [6] and Hessian [36]; T: its warping
 * torque. */
double exact_stage_material(const beam_constants *c, const double kappa[3], const double N[3],
                            double T, double gradient[6], double M[36]);

/* Derivatives of kappa and N. */
void exact_stage_rows(const exact_stage *p, const double force[3], double D[6][EXACT_STAGE_SPACE]);

/* w (D^T M D + second derivatives of kappa and N contracted with `gradient`). */
void exact_stage_hessian(const exact_stage *p, const double force[3], const double gradient[6],
                         const double M[36], double w, double D[6][EXACT_STAGE_SPACE],
                         double H[EXACT_STAGE_SPACE][EXACT_STAGE_SPACE]);

#endif
