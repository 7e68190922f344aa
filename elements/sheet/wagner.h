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

/* Adds to energy[1], sigma[8], C[8 x 8]; NULL: not wanted. */
void sheet_wagner_add(const sheet_wagner_term *w, const double e[SHEET_STRAINS], double *energy,
                      double *sigma, double *C);

#endif
