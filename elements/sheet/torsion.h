/* Nonuniform torsion of an element (N Eq. 51), in x = s/L with lambda = L sqrt(GJ/EIw).
 *
 * A torque t(x) beside which the twist rate vanishes at both ends twists by kappa = (lambda^2/GJ)
 * g, lambda^2 g - g'' = t, g(0) = g(1) = 0; its bimoment is L g' (N App. B, with M_x as given).
 * Twist rates Wp, Wq of the ends without torque are kappa = Wp h_p + Wq h_q, h_q = sinh(lambda
 * x)/sinh(lambda), h_p(x) = h_q(1 - x).
 *
 * Integrated by parts, the Hellinger-Reissner potential of N Eq. 44 needs the bimoment only in the
 * integrals below, in which nothing cancels, neither for lambda -> 0 nor for lambda -> inf. */
#ifndef BEAMWORK_SHEET_TORSION_H
#define BEAMWORK_SHEET_TORSION_H

#include "elements/shared/status.h"

enum { SHEET_TORSION_DEGREE = 3, SHEET_TORSION_MODES = 5 };
enum { SHEET_TORSION_PX, SHEET_TORSION_WP, SHEET_TORSION_WQ, SHEET_TORSION_TWISTS };

typedef struct sheet_torsion_integrals {
    double compliance[SHEET_TORSION_MODES]
                     [SHEET_TORSION_MODES]; /* lambda^2 int t_k g_l dx, symmetric */
    /* int t_k (phi' - h) dx: twist rate per px/L, Wp, Wq in N Eq. 19 less that of the ends without
     * torque */
    double work[SHEET_TORSION_MODES][SHEET_TORSION_TWISTS];
    double same, other; /* h_p against itself and against h_q in int (lambda^2 h h + h' h') dx */
} sheet_torsion_integrals;

/* Torque modes t_k(x) = sum_i t[k][i] x^i, whole numbers.  lambda INFINITY: nothing warps, the
 * twist of phi_x is uniform. */
void sheet_torsion_integrate(double lambda,
                             const double t[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1],
                             sheet_torsion_integrals *out);

#endif
