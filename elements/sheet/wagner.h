/* Wagner torque: the energy int E c kx^4 ds of a twisted wide section (N Eqs. 45, 46), kx as N
 * Eq. 26. */
#ifndef BEAMWORK_SHEET_WAGNER_H
#define BEAMWORK_SHEET_WAGNER_H

#include "elements/sheet/strains.h"

enum { SHEET_WAGNER_POINTS = 5, SHEET_WAGNER_STRAINS = 3 }; /* degree 8: exact */

typedef struct sheet_wagner_term {
    int active;
    double weight[SHEET_WAGNER_POINTS];                     /* E c ds [N m^5] */
    double rate[SHEET_WAGNER_POINTS][SHEET_WAGNER_STRAINS]; /* kx per e2, e7, e8 [1/m^2] */
} sheet_wagner_term;

/* Inactive without FEATURE_WAGNER_TORQUE; refuses initial torsion beside it. */
status sheet_wagner_prepare(const element_request *request, sheet_wagner_term *out, fault *f);

/* Adds to energy[1], sigma[8], C[8 x 8], of one element or of several in lanes; NULL: not wanted.
 */
static inline void sheet_wagner_add(const sheet_wagner_term *w, const real e[SHEET_STRAINS],
                                    real *energy, real *sigma, real *C)
{
    static const int strain_of[SHEET_WAGNER_STRAINS] = {1, 6, 7};
    if (!w->active)
        return;
    for (int i = 0; i < SHEET_WAGNER_POINTS; i++) {
        const double *rate = w->rate[i];
        const real kx = rate[0] * e[1] + rate[1] * e[6] + rate[2] * e[7],
                   square = w->weight[i] * kx * kx;
        if (energy != NULL)
            *energy += square * kx * kx;
        for (int k = 0; k < SHEET_WAGNER_STRAINS; k++) {
            if (sigma != NULL)
                sigma[strain_of[k]] += 4 * square * kx * rate[k];
            for (int m = 0; m < SHEET_WAGNER_STRAINS && C != NULL; m++)
                C[SHEET_STRAINS * strain_of[k] + strain_of[m]] += 12 * square * rate[k] * rate[m];
        }
    }
}

#endif
