#include "harness/section_forces/section_forces_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/shared/beam_constants.h"

/* Solves R' = R kappa~, r' = R (e_x + gamma) over [0, 1]. All lengths are relative to the length of
 * the element. kappa[points x 3] and gamma[points x 3] are in section axes. Uses a Magnus series of
 * order six between the points. The curve ends at both frames: the gap at the end, which is a
 * discretisation error, is distributed in proportion to x. */
static void span_curve_between(const span_grid *g, const span_frame *p, const span_frame *q,
                               const double kappa[], const double gamma[], span_curve *out);
/* Solves the torsion equations over [0, 1]. All lengths are relative to the length of the element.
 * Returns 0, or 1 if the equations are singular. */
static int span_twist_solve(const span_grid *g, const span_torsion *t, span_twist *out);

enum { N = SPAN_GRID_POINTS, KAPPA = 0, GAMMA = 3 * N, UNKNOWNS = 6 * N };
static const double span_enough = 1e-12, tolerable = 1e-7;

/* All values are in units of the element: length l0, force EI/l0^2, moment EI/l0, bimoment EI. */
typedef struct span_work {
    const span_grid *g;
    const span_problem *problem;
    beam_constants c;
    double l0, force_unit;
    span_end end[2];
    span_curve curve;
    span_twist twist;
    double N[SPAN_GRID_POINTS][3], M[SPAN_GRID_POINTS][3];
    double flexibility[36];
} span_work;

static void begin(span_work *w)
{
    w->l0 = w->problem->request->length;
    w->force_unit = w->c.energy / w->l0;
    for (int e = 0; e < 2; e++) {
        w->end[e] = w->problem->end[e];
        for (int i = 0; i < 3; i++) {
            /* Positions are relative to p, which avoids cancellation for small elements. */
            w->end[e].frame.r[i] =
                (w->problem->end[e].frame.r[i] - w->problem->end[0].frame.r[i]) / w->l0;
            w->end[e].force[i] /= w->force_unit;
            w->end[e].moment[i] /= w->c.energy;
        }
        w->end[e].bimoment /= w->c.energy * w->l0;
        w->end[e].amplitude *= w->l0;
    }
}

/* Computes the distributed loads at the points: [points][force, moment about p], in the units of
 * span_work. */
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

/* Computes the force and the moment at an end, transferred to the origin p. */
static void about_origin(const span_end *end, double out[6])
{
    memcpy(out, end->force, 3 * sizeof *out);
    vec3_cross(end->frame.r, end->force, out + 3);
    for (int i = 0; i < 3; i++)
        out[3 + i] += end->moment[i];
}

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

/* Returns the torque per twist rate due to the stresses along the fibres, which the twist
 * inclines. */
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

/* Computes new strains from the resultants along the line that belongs to the previous strains. */
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

static void take(const span_work *w, const double strains[], span_fields *out)
{
    out->curve = w->curve;
    memcpy(out->bend, &strains[KAPPA], sizeof out->bend);
    memcpy(out->shear, &strains[GAMMA], sizeof out->shear);
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
                         "no equilibrium line between the ends of an element of %g m was found; "
                         "use more elements",
                         problem->request->length);
    } else {
        again(&w, strains, made);
    }
    take(&w, made, out);
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

static void close_gap(const span_grid *g, const double end[3], double at[N][3])
{
    double missing[3];
    for (int i = 0; i < 3; i++)
        missing[i] = end[i] - at[N - 1][i];
    for (int j = 0; j < N; j++)
        for (int i = 0; i < 3; i++)
            at[j][i] += g->x[j] * missing[i];
}

/* Computes displacements and rotations to first order: theta' = R kappa, u' = theta x R e_x + R
 * gamma, in units of the length. */
static void moved_linearly(const span_grid *g, double length, const span_fields *of,
                           const span_move end[2], double u[N][3], double turn[N][3])
{
    static const double along[3] = {1, 0, 0};
    double rate[N][3], tangent[3], sheared[3];
    for (int j = 0; j < N; j++)
        mat3_mul_vec(of->curve.R[j], of->bend[j], rate[j]);
    span_grid_integrate(g, 3, rate[0], turn[0]);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < 3; i++)
            turn[j][i] += end[0].turn[i];
    close_gap(g, end[1].turn, turn);
    for (int j = 0; j < N; j++) {
        mat3_mul_vec(of->curve.R[j], along, tangent);
        mat3_mul_vec(of->curve.R[j], of->shear[j], sheared);
        vec3_cross(turn[j], tangent, rate[j]);
        for (int i = 0; i < 3; i++)
            rate[j][i] = length * (rate[j][i] + sheared[i]);
    }
    span_grid_integrate(g, 3, rate[0], u[0]);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < 3; i++)
            u[j][i] += end[0].displacement[i];
    close_gap(g, end[1].displacement, u);
}

/* Computes displacements as differences between the curve and the undeformed curve, and rotations
 * of the sections relative to the rotation at p. */
static void moved_far(const span_grid *g, double length, const span_fields *of,
                      const span_frame begin[2], const double curvature[3], const span_move end[2],
                      double u[N][3], double turn[N][3])
{
    double kappa[N][3], gamma[N][3] = {{0}}, first[4], back[4];
    span_curve rest;
    span_frame from[2] = {begin[0], begin[1]};
    for (int i = 0; i < 3; i++) {
        from[0].r[i] = 0;
        from[1].r[i] = (begin[1].r[i] - begin[0].r[i]) / length;
        for (int j = 0; j < N; j++)
            kappa[j][i] = length * curvature[i];
    }
    span_curve_between(g, &from[0], &from[1], kappa[0], gamma[0], &rest);
    rotation_exp(end[0].turn, first);
    rotation_conjugate(first, back);
    for (int j = 0; j < N; j++) {
        double now[4], then[4], q[4];
        rotation_from_matrix(of->curve.R[j], now);
        rotation_from_matrix(rest.R[j], then);
        rotation_conjugate(then, then);
        rotation_compose(now, then, q);
        rotation_compose(back, q, q);
        rotation_log(q, turn[j]);
        for (int i = 0; i < 3; i++)
            u[j][i] = end[0].displacement[i] + length * (of->curve.r[j][i] - rest.r[j][i]);
    }
    close_gap(g, end[1].displacement, u);
}

void span_moved(const span_grid *g, const span_problem *problem, const span_fields *of,
                const span_frame begin[2], const double curvature[3], const span_move end[2],
                double x, span_move *out)
{
    double u[N][3], turn[N][3], share[N], q[4], step[4];
    const double length = problem->request->length;
    if (problem->linear)
        moved_linearly(g, length, of, end, u, turn);
    else
        moved_far(g, length, of, begin, curvature, end, u, turn);
    memset(out, 0, sizeof *out);
    span_grid_at(g, x, share);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < N; j++) {
            out->displacement[i] += share[j] * u[j][i];
            out->turn[i] += share[j] * turn[j][i];
        }
    if (problem->linear)
        return;
    rotation_exp(end[0].turn, q);
    rotation_exp(out->turn, step);
    rotation_compose(q, step, q);
    rotation_log(q, out->turn);
}

enum { CURVE_N = SPAN_GRID_POINTS };

/* Computes the rotation over an interval of length h, in the axes at its start (Blanes, Casas, Ros,
 * BIT 40, 2000): R^T' = -kappa~ R^T at three Gauss points. */
static void turn_of(const span_grid *g, int gap, const double kappa[], double h, double out[3])
{
    double at[SPAN_GRID_GAUSS][3] = {{0}}, a[3], b[3], c[3], first[3], second[3], third[3],
           fourth[3];
    for (int k = 0; k < SPAN_GRID_GAUSS; k++)
        for (int j = 0; j < CURVE_N; j++)
            for (int i = 0; i < 3; i++)
                at[k][i] -= h * g->gauss[gap][k][j] * kappa[3 * j + i];
    for (int i = 0; i < 3; i++) {
        a[i] = at[1][i];
        b[i] = sqrt(15) / 3 * (at[2][i] - at[0][i]);
        c[i] = 10.0 / 3 * (at[2][i] - 2 * at[1][i] + at[0][i]);
    }
    vec3_cross(a, b, first);
    for (int i = 0; i < 3; i++) {
        third[i] = 2 * c[i] + first[i];
        fourth[i] = -20 * a[i] - c[i] + first[i];
    }
    vec3_cross(a, third, second);
    for (int i = 0; i < 3; i++)
        third[i] = b[i] - second[i] / 60;
    vec3_cross(fourth, third, second);
    for (int i = 0; i < 3; i++)
        out[i] = -(a[i] + c[i] / 12 + second[i] / 240);
}

static void turn(const span_grid *g, const span_frame *p, const span_frame *q, const double kappa[],
                 span_curve *out)
{
    double along[CURVE_N][4], end[4], missing[3];
    rotation_from_matrix(p->R, along[0]);
    rotation_from_matrix(q->R, end);
    for (int i = 0; i + 1 < CURVE_N; i++) {
        double step[3], by[4];
        turn_of(g, i, kappa, g->x[i + 1] - g->x[i], step);
        rotation_exp(step, by);
        rotation_compose(along[i], by, along[i + 1]);
    }
    rotation_between(along[CURVE_N - 1], end, missing);
    for (int i = 0; i < CURVE_N; i++) {
        const double part[3] = {g->x[i] * missing[0], g->x[i] * missing[1], g->x[i] * missing[2]};
        double by[4];
        rotation_exp(part, by);
        rotation_compose(by, along[i], along[i]);
        rotation_matrix(along[i], out->R[i]);
    }
    memcpy(out->R[0], p->R, sizeof out->R[0]);
    memcpy(out->R[CURVE_N - 1], q->R, sizeof out->R[0]);
}

static void span_curve_between(const span_grid *g, const span_frame *p, const span_frame *q,
                               const double kappa[], const double gamma[], span_curve *out)
{
    double slope[CURVE_N][3];
    turn(g, p, q, kappa, out);
    for (int i = 0; i < CURVE_N; i++) {
        const double along[3] = {1 + gamma[3 * i], gamma[3 * i + 1], gamma[3 * i + 2]};
        mat3_mul_vec(out->R[i], along, slope[i]);
    }
    span_grid_integrate(g, 3, slope[0], out->r[0]);
    double missing[3];
    for (int k = 0; k < 3; k++)
        missing[k] = q->r[k] - p->r[k] - out->r[CURVE_N - 1][k];
    for (int i = 0; i < CURVE_N; i++)
        for (int k = 0; k < 3; k++)
            out->r[i][k] += p->r[k] + g->x[i] * missing[k];
}

enum { TWIST_N = SPAN_GRID_POINTS };

/* Computes the warping amplitudes a[SPAN_GRID_POINTS] of the solution with the given bimoment at
 * end `end` (0, 1) and the given amplitude at the other end. Returns 0, or 1 if the equations are
 * singular. */
static int amplitudes(const span_grid *g, const span_torsion *t, int end, double a[])
{
    double matrix[TWIST_N * TWIST_N];
    int pivot[TWIST_N];
    for (int i = 0; i < TWIST_N; i++) {
        const double soft = 1 + t->stiffness[i] * t->flexibility;
        for (int j = 0; j < TWIST_N; j++) {
            double second = 0;
            for (int k = 0; k < TWIST_N; k++)
                second += g->derivative[i][k] * g->derivative[k][j];
            matrix[i * TWIST_N + j] = t->EIw * second - (i == j ? t->stiffness[i] / soft : 0);
        }
        a[i] = -(t->torque[i] - t->stiffness[i] * t->shear[i]) / soft;
    }
    const int natural = end ? TWIST_N - 1 : 0, essential = TWIST_N - 1 - natural;
    for (int j = 0; j < TWIST_N; j++) {
        matrix[natural * TWIST_N + j] = t->EIw * g->derivative[natural][j];
        matrix[essential * TWIST_N + j] = j == essential ? t->EIw : 0;
    }
    a[natural] = t->bimoment[end];
    a[essential] = t->EIw * t->amplitude[1 - end];
    if (dense_lu(TWIST_N, matrix, pivot) != 0)
        return 1;
    dense_lu_solve(TWIST_N, 1, matrix, pivot, a);
    return 0;
}

static void add(const span_grid *g, const span_torsion *t, const double a[], const double share[],
                span_twist *out)
{
    for (int i = 0; i < TWIST_N; i++) {
        double slope = 0;
        for (int j = 0; j < TWIST_N; j++)
            slope += g->derivative[i][j] * a[j];
        const double warping = (t->torque[i] - t->stiffness[i] * (a[i] + t->shear[i])) /
                               (1 + t->stiffness[i] * t->flexibility);
        out->bimoment[i] += share[i] * t->EIw * slope;
        out->warping[i] += share[i] * warping;
        out->rate[i] += share[i] * (a[i] + t->flexibility * warping + t->shear[i]);
    }
}

static int span_twist_solve(const span_grid *g, const span_torsion *t, span_twist *out)
{
    double a[TWIST_N], share[TWIST_N];
    memset(out, 0, sizeof *out);
    if (t->EIw == 0) {
        for (int i = 0; i < TWIST_N; i++)
            out->rate[i] = t->stiffness[i] != 0 ? t->torque[i] / t->stiffness[i] : 0;
        return 0;
    }
    for (int end = 0; end < 2; end++) {
        if (amplitudes(g, t, end, a) != 0)
            return 1;
        for (int i = 0; i < TWIST_N; i++)
            share[i] = end ? g->x[i] : 1 - g->x[i];
        add(g, t, a, share, out);
    }
    out->bimoment[0] = t->bimoment[0];
    out->bimoment[TWIST_N - 1] = t->bimoment[1];
    return 0;
}
