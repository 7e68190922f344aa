#include "elements/shared/beam_constants.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

status beam_length_check(double length, fault *f)
{
    return length > 0 && isfinite(length)
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "the length of an element is %g m; move the nodes of the member apart",
                           length);
}

status beam_overflow(double length, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "element of length %g m: its stiffness overflows; use fewer elements", length);
}

status beam_constants_of(const element_request *request, beam_constants *out, fault *f)
{
    const section *c = request->section;
    const unsigned has = request->features;
    const double l0 = request->length, EI = c->young * fmin(c->Iy, c->Iz), E = c->young / EI,
                 G = c->shear_modulus / EI;
    TRY(beam_length_check(l0, f));
    memset(out, 0, sizeof *out);
    out->energy = EI / l0;
    out->EA = E * c->A * l0 * l0;
    out->EIy = E * c->Iy;
    out->EIz = E * c->Iz;
    out->GJ = G * c->It;
    out->warping = (has & FEATURE_WARPING) != 0;
    memcpy(out->initial, request->strain, sizeof out->initial);
    if (c->matrices)
        TRY(beam_coupled_of(c, l0, EI, out, f));
    out->EIw = E * c->Iw / (l0 * l0);
    const double scale[3] = {1 / l0, 1 / l0, 1};
    if (has & FEATURE_SHEAR)
        for (int i = 0; i < 9; i++)
            out->F[i] = c->F[i] / G * scale[i / 3] * scale[i % 3];
    /* Without shear, a fibre at (y, z) rotates about the shear centre, so r' has the components zs
     * kappa_x and -ys kappa_x in the section. The elongation of the fibre is gamma_x + z kappa_y -
     * y kappa_z + [(y - ys)^2 + (z - zs)^2] kappa_x^2/2. */
    if (has & FEATURE_TRAPEZE)
        out->trapeze = c->Ip / c->A / (l0 * l0);
    if (has & FEATURE_WAGNER_MOMENTS) {
        out->bend_y = c->wagner_z / c->Iy / l0;
        out->bend_z = -c->wagner_y / c->Iz / l0;
    }
    if (has & FEATURE_ECCENTRIC) {
        out->ys = c->ys / l0;
        out->zs = c->zs / l0;
        out->trapeze += out->ys * out->ys + out->zs * out->zs;
        out->bend_y -= 2 * out->zs;
        out->bend_z += 2 * out->ys;
    }
    if (has & FEATURE_WAGNER_TORQUE)
        out->torque = E * c->wagner_torque / (l0 * l0);
    const double all[] = {out->energy, out->EA,   out->EIy,  out->EIz,  out->GJ,
                          out->EIw,    out->F[0], out->F[4], out->F[8], out->torque};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (!isfinite(all[i]))
            return beam_overflow(l0, f);
    return STATUS_OK;
}

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
                     "element of length %g m: its stiffness matrix cannot be inverted; give "
                     "entries of more similar size, or elements of another length",
                     length);
}

/* Computes mixed = [K, B; B^T, -F] with F = Cgg^-1, B = Ckg F, K = Ckk - Ckg F Cgk. */
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
