#include "harness/section_forces/span.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/shared/beam_coupled.h"
#include "harness/section_forces/fixed_point.h"
#include "harness/section_forces/span_twist.h"

enum { N = SPAN_GRID_POINTS, KAPPA = 0, GAMMA = 3 * N, UNKNOWNS = 6 * N };
static const double span_enough = 1e-12, tolerable = 1e-7; /* of strains times the length */

/* Everything in units of the element: lengths l0, forces EI/l0^2, moments EI/l0, bimoments EI. */
typedef struct span_work {
    const span_grid *g;
    const span_problem *problem;
    beam_constants c;
    double l0, force_unit;
    span_end end[2];
    span_curve curve;
    span_twist twist;
    double N[SPAN_GRID_POINTS][3], M[SPAN_GRID_POINTS][3];
    double flexibility[36]; /* of a section by its matrices */
} span_work;

static void begin(span_work *w)
{
    w->l0 = w->problem->request->length;
    w->force_unit = w->c.energy / w->l0;
    for (int e = 0; e < 2; e++) {
        w->end[e] = w->problem->end[e];
        for (int i = 0; i < 3; i++) {
            /* from p, so that nothing is lost where elements are small */
            w->end[e].frame.r[i] =
                (w->problem->end[e].frame.r[i] - w->problem->end[0].frame.r[i]) / w->l0;
            w->end[e].force[i] /= w->force_unit;
            w->end[e].moment[i] /= w->c.energy;
        }
        w->end[e].bimoment /= w->c.energy * w->l0;
        w->end[e].amplitude *= w->l0;
    }
}

/* Loads at the points: [points][force, moment about p]. */
static void loads_of(span_work *w, double out[N][6])
{
    memset(out, 0, N * sizeof *out);
    if (w->problem->load == NULL)
        return;
    for (int j = 0; j < N; j++) {
        span_frame at;
        span_load load;
        double turning[3];
        for (int i = 0; i < 3; i++)
            at.r[i] = w->problem->end[0].frame.r[i] + w->l0 * w->curve.r[j][i];
        memcpy(at.R, w->curve.R[j], sizeof at.R);
        memset(&load, 0, sizeof load);
        w->problem->load(w->problem->context, w->g->x[j], &at, &load);
        for (int i = 0; i < 3; i++)
            out[j][i] = load.force[i] * w->l0 / w->force_unit;
        vec3_cross(w->curve.r[j], out[j], turning);
        for (int i = 0; i < 3; i++)
            out[j][3 + i] = turning[i] + load.moment[i] * w->l0 / w->c.energy;
    }
}

/* Force and moment about the origin p that end e exerts, whatever section it is thought to act on.
 */
static void about_origin(const span_end *end, double out[6])
{
    memcpy(out, end->force, 3 * sizeof *out);
    vec3_cross(end->frame.r, end->force, out + 3);
    for (int i = 0; i < 3; i++)
        out[3 + i] += end->moment[i];
}

/* N, M at the points: equilibrium of the parts before and behind. */
static void resultants(span_work *w)
{
    double load[N][6], gathered[N][6], from[2][6];
    loads_of(w, load);
    span_grid_integrate(w->g, 6, load[0], gathered[0]);
    about_origin(&w->end[0], from[0]);
    about_origin(&w->end[1], from[1]);
    for (int j = 0; j < N; j++) {
        const double x = w->g->x[j];
        double here[6], turning[3];
        for (int i = 0; i < 6; i++)
            here[i] = (1 - x) * (from[0][i] - gathered[j][i]) +
                      x * (from[1][i] + gathered[N - 1][i] - gathered[j][i]);
        vec3_cross(w->curve.r[j], here, turning);
        for (int i = 0; i < 3; i++)
            here[3 + i] -= turning[i];
        mat3_transpose_mul_vec(w->curve.R[j], here, w->N[j]);
        mat3_transpose_mul_vec(w->curve.R[j], here + 3, w->M[j]);
    }
}

/* What stresses along the fibres, which the twist turns, add to the torque for a unit of it. */
static double wagner(const span_work *w, int j, double rate)
{
    const beam_constants *c = &w->c;
    if (w->problem->linear)
        return 0;
    return c->trapeze * w->N[j][0] + c->bend_y * w->M[j][1] + c->bend_z * w->M[j][2] +
           4 * c->torque * rate * rate;
}

static int twisted(span_work *w, const double strains[])
{
    const beam_constants *c = &w->c;
    span_torsion t = {.EIw = c->warping ? c->EIw : 0, .flexibility = c->F[8]};
    for (int e = 0; e < 2; e++) {
        t.bimoment[e] = w->end[e].bimoment;
        t.amplitude[e] = w->end[e].amplitude;
    }
    for (int j = 0; j < N; j++) {
        t.torque[j] = w->M[j][0] - (c->ys * w->N[j][2] - c->zs * w->N[j][1]);
        t.stiffness[j] = c->GJ + wagner(w, j, strains[KAPPA + 3 * j]);
        t.shear[j] = t.EIw > 0 ? c->F[6] * w->N[j][1] + c->F[7] * w->N[j][2] : 0;
    }
    return span_twist_solve(w->g, &t, &w->twist);
}

/* Of a section by its matrices: no part of the torque is that of warping. */
static void strained_matrices(span_work *w, double out[])
{
    for (int j = 0; j < N; j++) {
        double stress[6], strain[6];
        memcpy(stress, w->N[j], sizeof w->N[j]);
        memcpy(stress + 3, w->M[j], sizeof w->M[j]);
        dense_mul_vec(6, 6, w->flexibility, stress, strain);
        memcpy(&out[GAMMA + 3 * j], strain, 3 * sizeof *out);
        memcpy(&out[KAPPA + 3 * j], strain + 3, 3 * sizeof *out);
        w->twist.rate[j] = strain[3];
        w->twist.bimoment[j] = w->twist.warping[j] = 0;
    }
}

/* Strains that the resultants make on the line that the strains before gave. */
static int again(void *context, const double strains[], double out[])
{
    span_work *w = context;
    const beam_constants *c = &w->c;
    const element_request *request = w->problem->request;
    double kappa[3 * N], gamma[3 * N];
    for (int j = 0; j < N; j++)
        for (int i = 0; i < 3; i++) {
            kappa[3 * j + i] = strains[KAPPA + 3 * j + i] + w->l0 * request->curvature[i];
            gamma[3 * j + i] =
                strains[GAMMA + 3 * j + i] + (w->problem->linear ? 0 : request->strain[i]);
        }
    span_curve_between(w->g, &w->end[0].frame, &w->end[1].frame, kappa, gamma, &w->curve);
    resultants(w);
    if (c->coupled) {
        strained_matrices(w, out);
        return 0;
    }
    if (twisted(w, strains) != 0)
        return 1;
    for (int j = 0; j < N; j++) {
        const double k = w->twist.rate[j], half = k * k / 2, Mw = w->twist.warping[j], *Q = w->N[j];
        double *curved = &out[KAPPA + 3 * j], *strained = &out[GAMMA + 3 * j];
        curved[0] = k;
        curved[1] = w->M[j][1] / c->EIy - c->bend_y * half;
        curved[2] = w->M[j][2] / c->EIz - c->bend_z * half;
        strained[0] = Q[0] / c->EA - c->trapeze * half;
        strained[1] = c->F[0] * Q[1] + c->F[1] * Q[2] + c->F[2] * Mw + c->zs * k;
        strained[2] = c->F[3] * Q[1] + c->F[4] * Q[2] + c->F[5] * Mw - c->ys * k;
    }
    return 0;
}

static void take(const span_work *w, span_fields *out)
{
    for (int j = 0; j < N; j++) {
        double *v = out->value[j];
        const double k = w->twist.rate[j];
        for (int i = 0; i < 3; i++) {
            v[SPAN_N + i] = w->N[j][i] * w->force_unit;
            v[SPAN_MX + i] = w->M[j][i] * w->c.energy;
        }
        v[SPAN_BIMOMENT] = w->twist.bimoment[j] * w->c.energy * w->l0;
        v[SPAN_MX_SAINT_VENANT] = (w->c.coupled ? w->M[j][0] : w->c.GJ * k) * w->c.energy;
        v[SPAN_MX_WARPING] = w->twist.warping[j] * w->c.energy;
        v[SPAN_MX_WAGNER] = wagner(w, j, k) * k * w->c.energy;
        v[SPAN_TWIST] = k / w->l0;
    }
}

status span_recover(const span_grid *g, const span_problem *problem, span_fields *out, fault *f)
{
    span_work w = {.g = g, .problem = problem};
    double strains[UNKNOWNS] = {0}, made[UNKNOWNS];
    TRY(beam_constants_of(problem->request, &w.c, f));
    if (w.c.coupled && beam_coupled_inverse(6, w.c.C, w.flexibility) != 0)
        return beam_coupled_too_stiff(problem->request->length, f);
    begin(&w);
    if (problem->linear) {
        if (again(&w, strains, made) != 0)
            return fault_set(f, STATUS_SINGULAR, "torsion inside an element is singular");
    } else if (!(fixed_point_find(UNKNOWNS, again, &w, span_enough, strains) <= tolerable)) {
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "no line between the ends of an element of %g m was found; take more "
                         "elements",
                         problem->request->length);
    } else {
        again(&w, strains, made); /* of the strains that were best */
    }
    take(&w, out);
    return STATUS_OK;
}

void span_at(const span_grid *g, const span_fields *fields, double x, double out[])
{
    double share[N];
    span_grid_at(g, x, share);
    for (int i = 0; i < SPAN_VALUES; i++) {
        out[i] = 0;
        for (int j = 0; j < N; j++)
            out[i] += share[j] * fields->value[j][i];
    }
}
