/* Wagner torque: the energy int E c kx^4 ds of a twisted wide section (N Eqs. 45, 46), kx as N Eq. 26. */
#ifndef BEAMWORK_SHEET_WAGNER_H
#define BEAMWORK_SHEET_WAGNER_H

#include "elements/sheet/strains.h"

enum { WAGNER_POINTS = 5, WAGNER_STRAINS = 3 }; /* degree 8: exact */

typedef struct wagner_term {
    int active;
    double weight[WAGNER_POINTS];               /* E c ds [N m^5] */
    double rate[WAGNER_POINTS][WAGNER_STRAINS]; /* kx per e2, e7, e8 [1/m^2] */
} wagner_term;

/* Inactive without FEATURE_WAGNER_TORQUE; refuses initial torsion beside it. */
status wagner_prepare(const element_request *request, wagner_term *out, fault *f);

/* Adds to energy[1], sigma[8], C[8 x 8]; NULL: not wanted. */
void wagner_add(const wagner_term *w, const double e[SHEET_STRAINS], double *energy, double *sigma,
                double *C);

#endif
