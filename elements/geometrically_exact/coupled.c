#include "elements/geometrically_exact/coupled.h"

#include <string.h>

#include "elements/math/quadrature.h"
#include "elements/shared/beam_coupled.h"

enum { ALL = 6 };

/* F += 1/12 A^T Fkk A with A (N, Q, M) = (0, Qz, -Qy), the slope of the moment. */
static void add_linear_moment(double F[36])
{
    static const int shear[] = {2, 1}, moment[] = {4, 5};
    static const double sign[] = {1, -1};
    double added[4];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            added[2 * i + j] = sign[i] * sign[j] * F[ALL * moment[i] + moment[j]] / 12;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            F[ALL * shear[i] + shear[j]] += added[2 * i + j];
}

status exact_coupled_stiffness(const beam_constants *c, int points, int strains, double length,
                               double S[], fault *f)
{
    const double unit = c->energy / (length * length);
    double x[ELEMENT_MAX_NODES], w[ELEMENT_MAX_NODES], C[36], F[36];
    quadrature_points(points, x, w);
    memcpy(C, c->C, sizeof C);
    if (points == 1) {
        int failed = beam_coupled_inverse(ALL, c->C, F);
        add_linear_moment(F);
        failed = failed != 0 || beam_coupled_inverse(ALL, F, C) != 0;
        if (failed)
            return beam_coupled_too_stiff(length, f);
    }
    for (int g = 0; g < points; g++)
        for (int i = 0; i < ALL; i++)
            for (int j = 0; j < ALL; j++)
                S[(ALL * g + i) * strains + ALL * g + j] = unit * w[g] * C[ALL * i + j];
    return STATUS_OK;
}
