/* The stress function of the second-order elements, linear but for the Wagner torque, of one
 * element or of several in lanes. */
#ifndef BEAMWORK_SHEET_LINEAR_H
#define BEAMWORK_SHEET_LINEAR_H

#include <string.h>

#include "elements/sheet/base.h"

/* As element_type.stress. */
static inline void sheet_linear_stress(const sheet_base_data *d, const real e[SHEET_STRAINS],
                                       stress_real *out)
{
    enum { N = SHEET_STRAINS };
    real sigma[N];
    for (int i = 0; i < N; i++) {
        sigma[i] = real_of(0);
        for (int j = 0; j < N; j++)
            sigma[i] += d->S[N * i + j] * e[j];
    }
    if (out->energy != NULL) {
        *out->energy = real_of(0);
        for (int i = 0; i < N; i++)
            *out->energy += sigma[i] * e[i] / 2;
    }
    if (out->sigma != NULL)
        memcpy(out->sigma, sigma, sizeof sigma);
    if (out->C != NULL)
        for (int i = 0; i < N * N; i++)
            out->C[i] = real_of(d->S[i]);
    if (out->residual != NULL)
        *out->residual = real_of(0);
    sheet_wagner_add(&d->wagner, e, out->energy, out->sigma, out->C);
}

#endif
