/* A bar of length l whose nodes have the additional unknowns s1 and s2, with the energy
 *   EA/(2l) (dl - l beta (s1 + s2)/2)^2 + EA l gamma (s1^2 + s2^2)/4
 * where dl is the elongation and beta and gamma are constants, and weak springs on all other
 * motions. If s1 = s2, its axial stiffness is
 * EA/l gamma/(gamma + beta^2). HELD: unknowns that are zero at ends with restrained warping. MASS
 * [kg]: mass of each unknown; without it, the bar uses the default mass. */
#include <math.h>
#include <string.h>

#include "elements/element.h"

#ifndef HELD
#define HELD 0
#endif

enum { N = 2 * (NODE_COORDINATES + 1) };
static const double beta = 0.5, gamma_ = 2;

struct element_data {
    double length, EA, mass; /* [m, N, kg] */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static int scalars(const double options[])
{
    (void)options;
    return 1;
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    (void)f;
    *out = (element_data){request->length, c->young * c->A, c->density * c->A * request->length};
    return STATUS_OK;
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    const double l = d->length, a = x[0].scalar[0], b = x[1].scalar[0], tiny = 1e-3 * d->EA * l;
    double square = 0, change = 0, along[2] = {0, 0}, same = 3;
    for (int i = 0; i < 3; i++) {
        const double u = x[1].u[i] - x[0].u[i], r = x[1].r[i] - x[0].r[i];
        square += r * r;
        change += u * (2 * r - u);
        for (int k = 0; k < 2; k++)
            along[k] += x[k].R[3 * i] * r;
    }
    for (int i = 0; i < 9; i++)
        same -= x[0].R[i] * x[1].R[i];
    const double gap = change / (sqrt(square) + l) - l * beta * (a + b) / 2;
    *out->energy = d->EA / (2 * l) * gap * gap + d->EA * l * gamma_ * (a * a + b * b) / 4 +
                   tiny * (same + 2 - (along[0] + along[1]) / sqrt(square));
    return STATUS_OK;
}

#ifdef MASS
static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *frame, inertia_output *out)
{
    (void)x;
    if (frame != NULL)
        return STATUS_REFUSED;
    double *const zero[] = {out->M, out->N, out->G};
    for (int k = 0; k < 3; k++)
        if (zero[k] != NULL)
            memset(zero[k], 0, N * N * sizeof(double));
    if (out->potential != NULL)
        *out->potential = 0;
    if (out->force != NULL)
        memset(out->force, 0, N * sizeof(double));
    for (int i = 0; i < N && out->M != NULL; i++) {
        const int c = i % NODE_COORDINATES;
        out->M[(N + 1) * i] = i >= 2 * NODE_COORDINATES ? MASS : c < 3 ? d->mass / 2 : 0;
    }
    return STATUS_OK;
}
#endif

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "scalars",
    .summary = "a bar with an additional unknown",
    .source = "this test",
    .family = "example",
    .offers = FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS,
    .limits = LIMIT_DOUBLY_SYMMETRIC,
    .leaves = LEAVES_FORCE | LEAVES_TANGENT,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
#ifdef MASS
    .inertia = inertia,
#endif
    .scalars = scalars,
    .held = HELD,
};
