/* A rod of 10 m in free flight: a force and a moment at its lower end B, (6, 0, 0) m, throw it
 * (J.C. Simo, L. Vu-Quoc 1986 and 1988). */
#ifndef BEAMWORK_CASES_THROWN_H
#define BEAMWORK_CASES_THROWN_H

#include "cases/shared/timed.h"

typedef struct thrown_rod {
    double stiffening;          /* of EA = GA = 1e4 N */
    double bending;             /* EI = GJ [N m^2] */
    double A[3];                /* its upper end [m] */
    double y[3];                /* of its section */
    double force[3], moment[3]; /* at B, times functions of time [N, N m] */
} thrown_rod;
typedef struct thrown {
    int A, B, load[2]; /* nodes; force, moment */
} thrown;
thrown thrown_add(scene *, const thrown_rod *);

#endif
