/* A section by its matrices, every entry that there can be of a size that matters. */
#ifndef BEAMWORK_TEST_MATRICES_H
#define BEAMWORK_TEST_MATRICES_H

#include <math.h>

#include "elements/section/section.h"

/* Lengths in units of `unit` metres, force in newtons, time in seconds of the same mass. */
static inline section_spec matrices_spec(double unit)
{
    static const double stiff[6] = {5e6, 2e6, 1.7e6, 90, 130, 480},
                        part[15] = {0.2,  -0.1, 0.3, 0.15, -0.2, 0.1,  -0.15, 0.2,
                                    -0.3, 0.25, 0.1, -0.1, 0.4,  -0.2, 0.1};
    const double m = 0.7 * unit, y = 0.011 / unit, z = -0.007 / unit, r = 1e-4 / (unit * unit);
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness, *M = spec.constants.mass;
    for (int i = 0, k = 0; i < 6; i++) {
        C[7 * i] = stiff[i] / (i < 3 ? 1 : unit * unit);
        for (int j = 0; j < i; j++, k++)
            C[6 * i + j] = C[6 * j + i] = part[k] * sqrt(C[7 * i] * C[7 * j]);
    }
    M[0] = M[7] = M[14] = m;
    M[4] = M[24] = m * z;
    M[9] = M[19] = -M[4];
    M[15] = M[20] = m * y;
    M[5] = M[30] = -M[15];
    M[21] = m * (y * y + z * z) + 3 * m * r;
    M[28] = m * z * z + 2 * m * r;
    M[35] = m * y * y + m * r;
    M[29] = M[34] = -m * y * z + 0.3 * m * r;
    return spec;
}

#endif
