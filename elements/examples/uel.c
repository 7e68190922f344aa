/* A user element (UEL) of Abaqus as a formulation. The user element is called for RHS and AMATRX as
 * in a static Abaqus step with large displacements (LFLAGS 1, 1, 1). It must have twelve degrees of
 * freedom and no state variables that outlive a call. ENERGY(2) is the strain energy.
 *   gfortran -O2 -fPIC -c uel_beam.f90
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK uel.c uel_beam.o -lgfortran -lm -o uel.so
 *   beamwork element-test --element ./uel.so */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { N = 12, PROPS = 6, STATES = 100 };

/* SUBROUTINE UEL. INTEGER is int, DOUBLE PRECISION is double, and all arguments are addresses. */
void uel_(double rhs[], double amatrx[], double svars[], double energy[8], const int *ndofel,
          const int *nrhs, const int *nsvars, const double props[], const int *nprops,
          const double coords[], const int *mcrd, const int *nnode, const double u[],
          const double du[], const double v[], const double a[], const int *jtype,
          const double time[2], const double *dtime, const int *kstep, const int *kinc,
          const int *jelem, const double params[], const int *ndload, const int jdltyp[],
          const double adlmag[], const double predef[], const int *npredf, const int lflags[],
          const int *mlvarx, const double ddlmag[], const int *mdload, double *pnewdt,
          const int jprops[], const int *njprop, const double *period);

struct element_data {
    double length;
    double props[PROPS]; /* E, G, A, Iy, Iz, It, in the order that the user element expects */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    (void)f;
    *out = (element_data){request->length, {c->young, c->shear_modulus, c->A, c->Iy, c->Iz, c->It}};
    return STATUS_OK;
}

/* Computes the rotation vector of R, whose length is at most pi. */
static void rotation_vector(const double R[9], double psi[3])
{
    double q[4], most = R[0] + R[4] + R[8]; /* quaternion, computed from its largest component */
    int k = 3;
    for (int i = 0; i < 3; i++)
        if (R[4 * i] > most) {
            most = R[4 * i];
            k = i;
        }
    const double axial[3] = {R[7] - R[5], R[2] - R[6], R[3] - R[1]};
    for (int i = 0; i < 3; i++)
        q[i] = k == 3 ? axial[i] : R[3 * k + i] + R[3 * i + k];
    q[3] = k == 3 ? 1 + R[0] + R[4] + R[8] : axial[k];
    if (k < 3)
        q[k] = 1 + 2 * R[4 * k] - R[0] - R[4] - R[8];
    const double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    for (int i = 0; i < 3; i++)
        psi[i] = sine > 0 ? 2 * atan2(q[3] < 0 ? -sine : sine, fabs(q[3])) / sine * q[i] : 0;
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    const int n = N, one = 1, none = 0, two = 2, three = 3, states = STATES, props = PROPS;
    const int lflags[5] = {1, 1, 1, 0, 0}, no_int[1] = {0};
    const double coords[6] = {0, 0, 0, d->length, 0, 0}, zero[N] = {0}, step = 1;
    double rhs[N] = {0}, K[N * N] = {0}, svars[STATES] = {0}, energy[8] = {0}, pnewdt = 1;
    double u[N];
    for (int k = 0; k < 2; k++) { /* motion from the undeformed element at the origin */
        for (int i = 0; i < 3; i++)
            u[6 * k + i] = x[k].r[i] - coords[3 * k + i];
        rotation_vector(x[k].R, u + 6 * k + 3);
    }
    uel_(rhs, K, svars, energy, &n, &one, &states, d->props, &props, coords, &three, &two, u, u,
         zero, zero, &one, zero, &step, &one, &one, &one, zero, &none, no_int, zero, zero, &none,
         lflags, &n, zero, &none, &pnewdt, no_int, &none, &step);
    if (pnewdt < 1) /* true if the user element requests a smaller step */
        return STATUS_NOT_CONVERGED;
    if (out->energy != NULL)
        *out->energy = energy[1];
    if (out->F != NULL)
        memset(out->F, 0, 2 * NODE_COORDINATES * sizeof *out->F);
    if (out->K != NULL)
        memset(out->K, 0, 4 * NODE_COORDINATES * NODE_COORDINATES * sizeof *out->K);
    for (int i = 0; i < N; i++) {
        const int row = i + i / 6; /* the seventh coordinate of a node is warping, not used here */
        if (out->F != NULL)
            out->F[row] = -rhs[i];
        for (int j = 0; j < N && out->K != NULL; j++)
            out->K[row * 2 * NODE_COORDINATES + j + j / 6] = K[j * N + i]; /* AMATRX by columns */
    }
    return STATUS_OK;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "uel",
    .summary = "a user element in Fortran: corotational, two nodes, thin",
    .source = "uel_beam.f90",
    .family = "example",
    .offers = FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_QUARTER_TURN,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
};
