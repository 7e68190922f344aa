/* Eigenpairs of largest size of a real operator without symmetry: the operator projected on a
 * growing orthonormal basis (Arnoldi).  There is no inertia that counts them: when those wanted
 * have converged, another start joins the basis until it brings nothing that is as large. */
#ifndef BEAMWORK_ARNOLDI_H
#define BEAMWORK_ARNOLDI_H

#include <complex.h>

#include "elements/shared/status.h"

typedef struct arnoldi_problem {
    int n, wanted;
    void (*apply)(void *context, const double x[], double y[]); /* y = T x */
    void *context;
} arnoldi_problem;

typedef struct arnoldi_result {
    int count; /* fewer than wanted when no more are larger than rounding; one more where
                  the last one is the first of a conjugate pair */
    double complex *theta; /* [count] largest size first, conjugates one after the other */
    double complex *mode;  /* [count x n] of length 1 */
    double *residual;      /* [count] |T x - theta x|/|theta| */
    long applied;
} arnoldi_result;

status arnoldi_solve(const arnoldi_problem *, arnoldi_result *, fault *);
void arnoldi_free(arnoldi_result *);

#endif
