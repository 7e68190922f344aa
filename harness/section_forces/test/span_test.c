/* Values along a rod, which are computed from the frames and forces at both ends, must agree
 * within 1e-8 with the solution of an initial value problem that starts at one end (GSL,
 * tolerance 1e-13). */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/section_forces/section_forces.h"

/* first indices in the state: r (3), quaternion q (4), force (3) and moment (3) in fixed axes,
 * warping amplitude, bimoment */
enum { R = 0, Q = 3, FORCE = 7, MOMENT = 10, AMPLITUDE = 13, BIMOMENT = 14, STATE = 15 };

typedef struct rod {
    const char *name;
    section section;
    unsigned features;
    double length, curvature[3], strain[3], start[STATE];
    double dead[3], dead_moment[3], follower[3]; /* forces and moments per length in fixed axes, and
                                                    forces that rotate with the sections */
    double tolerance;
} rod;

static int has(const rod *b, unsigned bit)
{
    return (b->features & bit) != 0;
}

static void law(const rod *b, const double y[], double N[3], double M[3], double *rate, double *Mw,
                double *wagner)
{
    const section *c = &b->section;
    const double E = c->young, G = c->shear_modulus, ys = has(b, FEATURE_ECCENTRIC) ? c->ys : 0,
                 zs = has(b, FEATURE_ECCENTRIC) ? c->zs : 0;
    double T[9];
    rotation_matrix(y + Q, T);
    mat3_transpose_mul_vec(T, y + FORCE, N);
    mat3_transpose_mul_vec(T, y + MOMENT, M);
    const int shear = has(b, FEATURE_SHEAR), warps = has(b, FEATURE_WARPING);
    const double torque = M[0] - (ys * N[2] - zs * N[1]), soft = shear ? c->F[8] / G : 0,
                 across = shear && warps ? (c->F[6] * N[1] + c->F[7] * N[2]) / G : 0;
    double fibres = has(b, FEATURE_TRAPEZE) ? N[0] * (c->Ip / c->A + ys * ys + zs * zs) : 0;
    if (has(b, FEATURE_WAGNER_MOMENTS))
        fibres += M[1] * c->wagner_z / c->Iy - M[2] * c->wagner_y / c->Iz;
    fibres += -2 * zs * M[1] + 2 * ys * M[2];
    *rate = 0;
    for (int i = 0; i < 200; i++) {
        const double cubic =
            has(b, FEATURE_WAGNER_TORQUE) ? 4 * E * c->wagner_torque * *rate * *rate : 0;
        const double K = G * c->It + fibres + cubic;
        *wagner = (fibres + cubic) * *rate;
        *rate = warps ? (y[AMPLITUDE] + soft * torque + across) / (1 + soft * K) : torque / K;
    }
    *Mw = torque - G * c->It * *rate - *wagner;
}

static int slope(double s, const double y[], double dy[], void *context)
{
    const rod *b = context;
    const section *c = &b->section;
    const double E = c->young, G = c->shear_modulus, ys = has(b, FEATURE_ECCENTRIC) ? c->ys : 0,
                 zs = has(b, FEATURE_ECCENTRIC) ? c->zs : 0;
    double N[3], M[3], k, Mw, wagner, gamma[3], kappa[3], T[9], turn[3];
    (void)s;
    law(b, y, N, M, &k, &Mw, &wagner);
    const double half = k * k / 2, shear = has(b, FEATURE_SHEAR) ? 1 / G : 0,
                 moments = has(b, FEATURE_WAGNER_MOMENTS);
    kappa[0] = k + b->curvature[0];
    kappa[1] =
        M[1] / (E * c->Iy) - half * (moments * c->wagner_z / c->Iy - 2 * zs) + b->curvature[1];
    kappa[2] =
        M[2] / (E * c->Iz) - half * (-moments * c->wagner_y / c->Iz + 2 * ys) + b->curvature[2];
    gamma[0] = 1 + N[0] / (E * c->A) + b->strain[0];
    if (has(b, FEATURE_TRAPEZE))
        gamma[0] -= half * (c->Ip / c->A + ys * ys + zs * zs);
    gamma[1] = shear * (c->F[0] * N[1] + c->F[1] * N[2] + c->F[2] * Mw) + zs * k + b->strain[1];
    gamma[2] = shear * (c->F[3] * N[1] + c->F[4] * N[2] + c->F[5] * Mw) - ys * k + b->strain[2];
    rotation_matrix(y + Q, T);
    mat3_mul_vec(T, gamma, dy + R);
    const double spin[4] = {0, kappa[0] / 2, kappa[1] / 2, kappa[2] / 2};
    rotation_compose(y + Q, spin, dy + Q);
    vec3_cross(dy + R, y + FORCE, turn);
    double follower[3];
    mat3_mul_vec(T, b->follower, follower);
    for (int i = 0; i < 3; i++) {
        dy[FORCE + i] = -b->dead[i] - follower[i];
        dy[MOMENT + i] = -turn[i] - b->dead_moment[i];
    }
    dy[AMPLITUDE] = has(b, FEATURE_WARPING) ? y[BIMOMENT] / (E * c->Iw) : 0;
    dy[BIMOMENT] = has(b, FEATURE_WARPING) ? -Mw : 0;
    return GSL_SUCCESS;
}

static void integrate(rod *b, double to, double y[STATE])
{
    gsl_odeiv2_system system = {slope, NULL, STATE, b};
    gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd,
                                                         1e-3 * b->length, 1e-14, 1e-13);
    double s = 0;
    memcpy(y, b->start, sizeof b->start);
    if (to > 0)
        gsl_test(gsl_odeiv2_driver_apply(d, &s, to, y) != GSL_SUCCESS, "%s: integrated", b->name);
    rotation_normalise(y + Q);
    gsl_odeiv2_driver_free(d);
}

static void values_of(const rod *b, const double y[], double out[SPAN_VALUES])
{
    double Mw;
    law(b, y, out + SPAN_N, out + SPAN_MX, &out[SPAN_TWIST], &Mw, &out[SPAN_MX_WAGNER]);
    out[SPAN_BIMOMENT] = y[BIMOMENT];
    out[SPAN_MX_SAINT_VENANT] = b->section.shear_modulus * b->section.It * out[SPAN_TWIST];
    out[SPAN_MX_WARPING] = Mw;
}

static void take_end(const double y[], span_end *end)
{
    memcpy(end->frame.r, y + R, sizeof end->frame.r);
    rotation_matrix(y + Q, end->frame.R);
    memcpy(end->force, y + FORCE, sizeof end->force);
    memcpy(end->moment, y + MOMENT, sizeof end->moment);
    end->amplitude = y[AMPLITUDE];
    end->bimoment = y[BIMOMENT];
}

static void load(void *context, double x, const span_frame *at, span_load *out)
{
    const rod *b = context;
    double follower[3];
    (void)x;
    mat3_mul_vec(at->R, b->follower, follower);
    for (int i = 0; i < 3; i++) {
        out->force[i] = b->dead[i] + follower[i];
        out->moment[i] = b->dead_moment[i];
    }
}

static void check(rod *b)
{
    static const double place[] = {0, 0.13, 0.5, 0.77, 1};
    element_request request = {
        .section = &b->section, .length = b->length, .features = b->features};
    span_problem problem = {.request = &request, .load = load, .context = b};
    span_grid g;
    span_fields fields;
    fault f = {""};
    double y[STATE], exact[SPAN_VALUES], got[SPAN_VALUES], size[3] = {0};
    memcpy(request.curvature, b->curvature, sizeof request.curvature);
    memcpy(request.strain, b->strain, sizeof request.strain);
    for (int end = 0; end < 2; end++) {
        integrate(b, end * b->length, y);
        take_end(y, &problem.end[end]);
        size[0] = fmax(size[0], vec3_norm(y + FORCE));
        size[1] = fmax(size[1], vec3_norm(y + MOMENT));
        size[2] = fmax(size[2], fmax(fabs(y[BIMOMENT]), size[1] * b->length * 1e-3));
    }
    span_grid_make(&g);
    const status outcome = span_recover(&g, &problem, &fields, &f);
    gsl_test(outcome != STATUS_OK, "%s: recovered (%s)", b->name, f.text);
    if (outcome != STATUS_OK)
        return;
    for (int i = 0; i < 5; i++) {
        integrate(b, place[i] * b->length, y);
        values_of(b, y, exact);
        span_at(&g, &fields, place[i], got);
        for (int v = 0; v < SPAN_TWIST; v++) {
            const int moment = v == SPAN_BIMOMENT ? 2 : 1;
            const double scale = size[v <= SPAN_QZ ? 0 : moment];
            gsl_test(!(fabs(got[v] - exact[v]) <= b->tolerance * scale),
                     "%s: value %d at %.2f is %.12g, exactly %.12g", b->name, v, place[i], got[v],
                     exact[v]);
        }
    }
}

int main(void)
{
    static const section
        channel = {.young = 2,
                   .shear_modulus = 0.8,
                   .A = 500,
                   .Iy = 3,
                   .Iz = 1.2,
                   .It = 0.4,
                   .Iw = 0.05,
                   .ys = 0.06,
                   .zs = -0.03,
                   .Ip = 4.2,
                   .wagner_y = 0.2,
                   .wagner_z = -0.1,
                   .wagner_torque = 0.05,
                   .F = {0.02, 0.003, 0.01, 0.003, 0.015, -0.02, 0.01, -0.02, 0.3}},
        wire = {.young = 1, .shear_modulus = 0.4, .A = 1e5, .Iy = 1, .Iz = 1, .It = 2, .Ip = 2},
        thin = {.young = 1,
                .shear_modulus = 1,
                .A = 1e5,
                .Iy = 1,
                .Iz = 1,
                .It = 1,
                .Iw = 1e-2,
                .Ip = 2};
    const unsigned all = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |
                         FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE;
    rod rods[] = {
        {"elastica of half a turn",
         wire,
         0,
         1,
         {0},
         {0},
         {0, 0, 0, 1, 0, 0, 0, 0.5, 6, 0, 0, 0, 6, 0, 0},
         {0},
         {0},
         {0},
         1e-8},
        {"wire in tension",
         wire,
         0,
         1,
         {0},
         {0},
         {0, 0, 0, 1, 0, 0, 0, 40, 1, 2, 0.3, -0.31, 0.16, 0, 0},
         {0},
         {0},
         {0},
         1e-8},
        {"column that bulges",
         wire,
         0,
         1,
         {0},
         {0},
         {0, 0, 0, 1, 0, 0, 0, -14, 0.5, 0, 0.1, 0.2, 2, 0, 0},
         {0},
         {0},
         {0},
         1e-9},
        {"arc under loads",
         wire,
         0,
         1.3,
         {0.4, -0.3, 0.9},
         {0.01, 0.02, 0},
         {1, 2, 3, 0.8, 0, 0.6, 0, 1, 2, -1, 0.5, 0.7, -0.4, 0, 0},
         {1, -2, 3},
         {0.3, 0.2, -0.5},
         {0.5, 1, -0.7},
         1e-9},
        {"torsion with warping held",
         thin,
         FEATURE_WARPING,
         1,
         {0},
         {0},
         {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0.05},
         {0},
         {0.3, 0, 0},
         {0},
         1e-9},
        {"everything",
         channel,
         all,
         1,
         {0.1, 0.2, -0.1},
         {0.01, 0, 0.005},
         {0, 1, 0, 1, 0, 0, 0, 0.8, 0.6, -0.4, 0.25, 0.5, 0.6, 0.1, 0.03},
         {0.2, 0.4, -0.1},
         {0.02, 0.05, 0.03},
         {0.1, 0, 0.1},
         1e-9},
    };
    for (size_t i = 0; i < sizeof rods / sizeof rods[0]; i++)
        check(&rods[i]);
    return gsl_test_summary();
}
