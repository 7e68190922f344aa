#include "elements/shared/beam_coupled.h"

#include <math.h>

#include "elements/math/dense.h"

enum { ALL = 6, HALF = 3 };

int beam_coupled_inverse(int n, const double A[], double inverse[])
{
    double scaled[ALL * ALL], scale[ALL];
    for (int i = 0; i < n; i++)
        scale[i] = 1 / sqrt(A[i * (n + 1)]);
    for (int i = 0; i < n * n; i++) {
        scaled[i] = A[i] * scale[i / n] * scale[i % n];
        inverse[i] = i % (n + 1) == 0;
    }
    const int failed = dense_cholesky(n, scaled);
    if (failed == 0)
        dense_cholesky_solve(n, n, scaled, inverse);
    for (int i = 0; i < n * n; i++)
        inverse[i] *= scale[i / n] * scale[i % n];
    return failed;
}

status beam_coupled_too_stiff(double length, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "element of length %g m: its stiffness matrix cannot be inverted; bring its "
                     "entries closer together, or use other lengths of elements",
                     length);
}

/* mixed = [K, B; B^T, -F] with F = Cgg^-1, B = Ckg F, K = Ckk - Ckg F Cgk. */
static int mix(const double C[36], double mixed[36])
{
    double Cgg[9], Ckg[9], F[9], B[9];
    for (int i = 0; i < HALF; i++)
        for (int j = 0; j < HALF; j++) {
            Cgg[HALF * i + j] = C[ALL * i + j];
            Ckg[HALF * i + j] = C[ALL * (HALF + i) + j];
        }
    if (beam_coupled_inverse(HALF, Cgg, F) != 0)
        return 1;
    mat3_mul(Ckg, F, B);
    for (int i = 0; i < HALF; i++)
        for (int j = 0; j < HALF; j++) {
            mixed[ALL * i + j] =
                C[ALL * (HALF + i) + HALF + j] - vec3_dot(&B[HALF * i], &Ckg[HALF * j]);
            mixed[ALL * i + HALF + j] = mixed[ALL * (HALF + j) + i] = B[HALF * i + j];
            mixed[ALL * (HALF + i) + HALF + j] = -F[HALF * i + j];
        }
    return 0;
}

status beam_coupled_of(const section *profile, double l0, double EI, beam_constants *out, fault *f)
{
    out->coupled = 1;
    out->warping = 0;
    for (int i = 0; i < ALL * ALL; i++)
        out->C[i] =
            profile->stiffness[i] / EI * (i / ALL < HALF ? l0 : 1) * (i % ALL < HALF ? l0 : 1);
    return mix(out->C, out->mixed) == 0 ? STATUS_OK : beam_coupled_too_stiff(l0, f);
}
