/* A shear-deformable beam with two nodes. The strains [m] are uniform along the element:
 *   d = Rm^T (rq - rp) - (l, 0, 0), where Rm is halfway from Rp to Rq, and l log(Rp^T Rq).
 * The derivatives of the strains are computed by finite differences.
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK timoshenko.c -o timoshenko.so
 *   beamwork converge tapered_cantilever --element ./timoshenko.so -f all */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { STRAINS = 6 };

struct element_data {
    double length;
    double stiffness[STRAINS]; /* [N/m] */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    const double l = request->length;
    (void)f;
    /* Returns the transverse flexibility: shear if requested, and residual bending. */
    out->length = l;
    const double shear = request->features & FEATURE_SHEAR ? l / c->shear_modulus : 0;
    const double Fy = shear * c->F[0] + l * l * l / (12 * c->young * c->Iz);
    const double Fz = shear * c->F[4] + l * l * l / (12 * c->young * c->Iy);
    const double l3 = l * l * l, one[STRAINS] = {c->young * c->A / l,
                                                 1 / Fy,
                                                 1 / Fz,
                                                 c->shear_modulus * c->It / l3,
                                                 c->young * c->Iy / l3,
                                                 c->young * c->Iz / l3};
    memcpy(out->stiffness, one, sizeof one);
    return STATUS_OK;
}

/* Computes y = A^T x. */
static void transposed(const double A[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = A[i] * x[0] + A[3 + i] * x[1] + A[6 + i] * x[2];
}

/* Computes the rotation vector from R to S, shorter than pi, in the axes of R. */
static void between(const double R[9], const double S[9], double psi[3])
{
    double T[9]; /* R^T S */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            T[3 * i + j] = R[i] * S[j] + R[3 + i] * S[3 + j] + R[6 + i] * S[6 + j];
    const double axis[3] = {(T[7] - T[5]) / 2, (T[2] - T[6]) / 2, (T[3] - T[1]) / 2};
    const double sine = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double angle = atan2(sine, (T[0] + T[4] + T[8] - 1) / 2);
    for (int i = 0; i < 3; i++)
        psi[i] = axis[i] * (sine > 0 ? angle / sine : 1);
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    double chord[3], psi[3], p[3], q[3]; /* the chord in the axes of nodes p and q */
    if (out->e == NULL)
        return;
    for (int i = 0; i < 3; i++)
        chord[i] = x[1].r[i] - x[0].r[i];
    between(x[0].R, x[1].R, psi);
    transposed(x[0].R, chord, p);
    transposed(x[1].R, chord, q);
    /* Normal to psi, the mean of p and q is c times the chord in the middle axes. */
    const double square = psi[0] * psi[0] + psi[1] * psi[1] + psi[2] * psi[2];
    const double c = cos(sqrt(square) / 2), k = square > 0 ? (1 - 1 / c) / square : 0;
    const double along = psi[0] * p[0] + psi[1] * p[1] + psi[2] * p[2];
    for (int i = 0; i < 3; i++) {
        out->e[i] = (p[i] + q[i]) / (2 * c) + k * along * psi[i];
        out->e[3 + i] = d->length * psi[i];
    }
    out->e[0] -= d->length;
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    double energy = 0;
    (void)inner;
    if (out->C != NULL)
        memset(out->C, 0, STRAINS * STRAINS * sizeof *out->C);
    for (int i = 0; i < STRAINS; i++) {
        energy += d->stiffness[i] * e[i] * e[i] / 2;
        if (out->sigma != NULL)
            out->sigma[i] = d->stiffness[i] * e[i];
        if (out->C != NULL)
            out->C[i * STRAINS + i] = d->stiffness[i];
    }
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

static int strains(const double options[])
{
    (void)options;
    return STRAINS;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "timoshenko",
    .summary = "two nodes, one integration point, flexible in shear, no warping",
    .source = "Reissner, J. Appl. Math. Phys. 32 (1981), with one integration point",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN,
    .leaves = LEAVES_J,
    .data_size = data_size,
    .prepare = prepare,
    .strains = strains,
    .strain = strain,
    .stress = stress,
};
