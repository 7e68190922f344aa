/* Collocation elements with loads along them must be in equilibrium with these loads, and their
 * tangent must agree with finite differences. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/math/vec3.h"
#include "elements/test/kit.h"

extern const element_type element_collocation;

enum { N = 14, STRAINS = 8, POINTS = ELEMENT_ALONG_POINTS, INNER = 24, MEMORY = 24 * 9 };
static const double l0 = 0.8;

typedef struct along_subject {
    element_data *data;
    double curvature[3];
} along_subject;

static section section_of(int matrices)
{
    static const double point[4][2] = {{0, 0}, {0.3, 0}, {0.3, 0.2}, {0.1, 0.25}},
                        thickness[3] = {0.03, 0.04, 0.03};
    section_spec spec = section_spec_walls(2e5, 8e4, 3, point, NULL, thickness);
    if (!matrices) {
        section c = sections_computed(&spec);
        c.F[2] = c.F[6] = 0.2 * sqrt(c.F[0] * c.F[8]);
        c.F[5] = c.F[7] = -0.1 * sqrt(c.F[4] * c.F[8]);
        gsl_test(!(c.F[2] > 0), "warping shears");
        return c;
    }
    uint64_t seed = 3;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j <= i; j++)
            spec.constants.stiffness[6 * i + j] = spec.constants.stiffness[6 * j + i] =
                i == j ? (i < 3 ? 900 : 12) : 2 * random_number(&seed);
    return sections_computed(&spec);
}

static along_subject subject_of(int stages, int matrices, const double curvature[3])
{
    const section c = section_of(matrices);
    const double option[ELEMENT_MAX_OPTIONS] = {stages - 3};
    const unsigned features = FEATURE_SHEAR | FEATURE_LARGE | FEATURE_HARINGX | FEATURE_GEOMETRIC |
                              (matrices ? FEATURE_COUPLED
                                        : FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |
                                              FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE);
    element_request request = {.section = &c,
                               .length = l0,
                               .features = features,
                               .options = option,
                               .type = &element_collocation};
    fault f = {""};
    along_subject s = {malloc(element_collocation.data_size(&request)), {0}};
    memcpy(request.curvature, curvature, sizeof s.curvature);
    memcpy(s.curvature, curvature, sizeof s.curvature);
    gsl_test(element_collocation.prepare(&request, s.data, &f), "%d stages: %s", stages, f.text);
    return s;
}

static void rest_nodes(const along_subject *s, node_state x[2])
{
    const double along[3] = {1, 0, 0};
    double rotation[3];
    memset(x, 0, 2 * sizeof *x);
    for (int i = 0; i < 3; i++)
        rotation[i] = s->curvature[i] * l0;
    for (int k = 0; k < 2; k++) {
        double q[4];
        arc_at(rotation, along, k, x[k].r, q);
        rotation_matrix(q, x[k].R);
        for (int i = 0; i < 3; i++)
            x[k].r[i] *= l0;
    }
}

static void forces_at(const along_subject *s, const node_state x[], const double q[],
                      double forces[N], double K[N * N])
{
    double e[STRAINS], J[STRAINS * N], sigma[STRAINS], C[STRAINS * STRAINS], memory[MEMORY],
        mixed[3 * STRAINS], H[N * N], inner[INNER], none[STRAINS] = {0}, work[STRAINS * N],
                                                    change = 1;
    along_output out = {.force = q,
                        .e = e,
                        .inner = inner,
                        .sigma = sigma,
                        .C = C,
                        .memory = memory,
                        .mixed = mixed,
                        .H = H};
    status outcome;
    element_collocation.strain(s->data, x, &(strain_output){.e = e, .J = J});
    element_collocation.rest(s->data, inner);
    const element_data *data = s->data;
    for (int i = 0; i < 30 && change > 1e-14; i++) {
        element_collocation.along(1, &data, x, &out, &outcome);
        change = element_collocation.update(s->data, none, memory, inner);
    }
    element_collocation.along(1, &data, x, &out, &outcome);
    gsl_test(outcome || !(change < 1e-11), "inner unknowns under a load (%.1e)", change);
    memset(forces, 0, N * sizeof *forces);
    dense_add_transpose_mul(N, STRAINS, 1, J, sigma, forces);
    dense_add_transpose_mul(N, 3, 1, out.turn, out.moment, forces);
    for (int i = 0; i < N; i++)
        forces[i] -= out.ends[i];
    if (K == NULL)
        return;
    element_collocation.strain(s->data, x, &(strain_output){.s = sigma, .H = K});
    dense_add_congruence(STRAINS, N, J, C, K, work);
    dense_add_congruence(3, N, out.turn, out.second, K, work);
    double cross[STRAINS * N], both[N * N] = {0};
    dense_mul(STRAINS, 3, N, mixed, out.turn, cross);
    dense_add_transpose_mul(N, STRAINS, N, J, cross, both);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            K[i * N + j] += H[i * N + j] + both[i * N + j] + both[j * N + i];
}

static double dot(int n, const double a[], const double b[])
{
    return dense_dot(n, a, b);
}

static void load_of(double size, int across, double q[3 * POINTS])
{
    double point[POINTS], weight[POINTS];
    quadrature_points(POINTS, point, weight);
    for (int j = 0; j < POINTS; j++) {
        q[3 * j] = size * (1 - 2 * point[j]);
        q[3 * j + 1] = -across * size * (0.5 + point[j]);
        q[3 * j + 2] = across * size * (0.8 - point[j] * point[j]);
    }
}

static void state_of(const along_subject *s, double size, node_state x[2])
{
    double d[N];
    rest_nodes(s, x);
    for (int k = 0; k < 2; k++) {
        const double turn[3] = {0.6, -0.5, 0.7};
        double r[3], q[4];
        rotation_exp(turn, q);
        rotation_apply(q, x[k].r, r);
        for (int i = 0; i < 3; i++) {
            x[k].u[i] += r[i] - x[k].r[i];
            x[k].r[i] = r[i];
        }
        nodes_turn(x[k].R, turn);
    }
    nodes_increments(2, l0, size, 5, d);
    nodes_move(2, 1, d, x);
}

static void tangent(int stages, int matrices, const double curvature[3])
{
    const along_subject s = subject_of(stages, matrices, curvature);
    const double step = 1e-4;
    double q[3 * POINTS], F[N], K[N * N], asymmetry, worst = 0;
    node_state x[2], moved[2];
    load_of(20, 1, q);
    state_of(&s, 0.015, x);
    forces_at(&s, x, q, F, K);
    asymmetry = nodes_asymmetry(N, K);
    for (unsigned seed = 1; seed < 9; seed++) {
        double d[N], at[4], Kd[N], largest = 0;
        static const double times[4] = {1, -1, 2, -2};
        nodes_increments(2, l0, 1, seed, d);
        for (int i = 0; i < 4; i++) {
            memcpy(moved, x, sizeof moved);
            nodes_move(2, times[i] * step, d, moved);
            forces_at(&s, moved, q, F, NULL);
            at[i] = dot(N, F, d);
        }
        dense_mul_vec(N, N, K, d, Kd);
        for (int i = 0; i < N; i++)
            largest += fabs(Kd[i] * d[i]);
        worst = worst_of(worst,
                         fabs((8 * (at[0] - at[1]) - at[2] + at[3]) / (12 * step) - dot(N, d, Kd)) /
                             largest);
    }
    gsl_test(!(worst < 1e-8), "%d stages, matrices %d, curvature %g: tangent (%.1e)", stages,
             matrices, curvature[2], worst);
    gsl_test(!(asymmetry < 1e-12), "its symmetry (%.1e)", asymmetry);
    free(s.data);
}

static void rate(int stages)
{
    static const double curved[3] = {0.4, -0.7, 0.9};
    const along_subject s = subject_of(stages, 0, curved);
    const element_data *data = s.data;
    double q[3 * POINTS], dq[3 * POINTS], F[2][N],
        own[N] = {0}, e[STRAINS], inner[INNER], sigma[STRAINS], memory[MEMORY],
        C[STRAINS * STRAINS], mixed[3 * STRAINS], J[STRAINS * N], none[STRAINS] = {0}, worst = 0,
        size = 0;
    const double step = 1e-3;
    node_state x[2];
    status outcome;
    state_of(&s, 0.015, x);
    load_of(20, 1, q);
    for (int i = 0; i < 3 * POINTS; i++)
        dq[i] = cos(i);
    element_collocation.strain(s.data, x, &(strain_output){.e = e, .J = J});
    element_collocation.rest(s.data, inner);
    along_output out = {.force = q,
                        .e = e,
                        .inner = inner,
                        .sigma = sigma,
                        .C = C,
                        .memory = memory,
                        .mixed = mixed};
    for (int i = 0; i < 20; i++) {
        element_collocation.along(1, &data, x, &out, &outcome);
        element_collocation.update(s.data, none, memory, inner);
    }
    out.rate = dq;
    element_collocation.along(1, &data, x, &out, &outcome);
    dense_add_transpose_mul(N, STRAINS, 1, J, sigma, own);
    dense_add_transpose_mul(N, 3, 1, out.turn, out.moment, own);
    for (int k = 0; k < 2; k++) {
        double there[3 * POINTS];
        for (int i = 0; i < 3 * POINTS; i++)
            there[i] = q[i] + (k ? -step : step) * dq[i];
        forces_at(&s, x, there, F[k], NULL);
    }
    for (int i = 0; i < N; i++) {
        own[i] -= out.ends[i];
        worst = worst_of(worst, fabs(own[i] - (F[0][i] - F[1][i]) / (2 * step)));
        size = fmax(size, fabs(own[i]));
    }
    gsl_test(outcome || !(worst < 1e-8 * size), "%d stages: rate of the forces (%.1e)", stages,
             worst / size);
    free(s.data);
}

static void closed_path(int stages, const double curvature[3])
{
    enum { SIDES = 3, RULE = 12 };
    const along_subject s = subject_of(stages, 0, curvature);
    double q[3 * POINTS], F[N], at[RULE], weight[RULE], sum = 0, size = 0;
    load_of(20, 1, q);
    quadrature_points(RULE, at, weight);
    double corner[SIDES][N];
    for (int c = 0; c < SIDES; c++) {
        memset(corner[c], 0, sizeof corner[c]);
        corner[c][0] = c == 1 ? 0.0005 : 0;
        corner[c][8] = c == 2 ? 0.0005 : 0;
        corner[c][4] = c == 1 ? 0.01 : 0;
        corner[c][12] = c == 2 ? -0.012 : 0;
    }
    for (int c = 0; c < SIDES; c++)
        for (int g = 0; g < RULE; g++) {
            double d[N], there[N];
            node_state x[2];
            for (int i = 0; i < N; i++) {
                d[i] = corner[(c + 1) % SIDES][i] - corner[c][i];
                there[i] = corner[c][i] + at[g] * d[i];
            }
            state_of(&s, 0.005, x);
            nodes_move(2, 1, there, x);
            forces_at(&s, x, q, F, NULL);
            sum += weight[g] * dot(N, F, d);
            size += weight[g] * fabs(dot(N, F, d));
        }
    gsl_test(!(fabs(sum) < 1e-9 * size), "%d stages: work round a closed path (%.1e of %.1e)",
             stages, sum, size);
    free(s.data);
}

static void resultants(int stages, const double curvature[3])
{
    const along_subject s = subject_of(stages, 0, curvature);
    double q[3 * POINTS], F[N], point[POINTS], weight[POINTS], Q[3] = {0};
    node_state x[2];
    load_of(20, 1, q);
    quadrature_points(POINTS, point, weight);
    state_of(&s, 0.015, x);
    forces_at(&s, x, q, F, NULL);
    for (int j = 0; j < POINTS; j++)
        for (int i = 0; i < 3; i++)
            Q[i] += l0 * weight[j] * q[3 * j + i];
    for (int i = 0; i < 3; i++)
        gsl_test(!(fabs(F[i] + F[7 + i] + Q[i]) < 1e-9 * 30), "%d stages: resultant", stages);
    free(s.data);
}

static double moment_left(const along_subject *s, const double q[], const double F[],
                          const node_state x[])
{
    const double along[3] = {1, 0, 0},
                 rotation[3] = {s->curvature[0] * l0, s->curvature[1] * l0, s->curvature[2] * l0};
    double point[POINTS], weight[POINTS], arm[3], more[3], sum[3];
    vec3_cross(x[1].r, F + 7, sum);
    for (int i = 0; i < 3; i++)
        sum[i] += F[3 + i] + F[10 + i];
    quadrature_points(POINTS, point, weight);
    for (int j = 0; j < POINTS; j++) {
        double turned[4];
        arc_at(rotation, along, point[j], arm, turned);
        vec3_cross(arm, q + (ptrdiff_t)3 * j, more);
        for (int i = 0; i < 3; i++)
            sum[i] += l0 * l0 * weight[j] * more[i];
    }
    return vec3_norm(sum);
}

static void linear(int stages, int matrices, const double curvature[3], int across)
{
    const along_subject s = subject_of(stages, matrices, curvature);
    const element_data *data = s.data;
    double q[3 * POINTS], F[2][N], K[2][N * N], sigma[STRAINS], G[STRAINS * STRAINS],
        mixed[3 * STRAINS], H[N * N], J[STRAINS * N],
        own[N] = {0}, k[N * N], work[STRAINS * N], cross[STRAINS * N], both[N * N] = {0}, worst = 0,
        size = 0;
    node_state x[2];
    status outcome;
    rest_nodes(&s, x);
    for (int i = 0; i < 2; i++) {
        load_of(i ? -1e-2 : 1e-2, across, q);
        forces_at(&s, x, q, F[i], K[i]);
    }
    load_of(1e-2, across, q);
    along_output out = {.force = q, .sigma = sigma, .C = G, .mixed = mixed, .H = H};
    element_collocation.along(1, &data, x, &out, &outcome);
    element_collocation.strain(s.data, x, &(strain_output){.J = J});
    dense_add_transpose_mul(N, STRAINS, 1, J, sigma, own);
    dense_add_transpose_mul(N, 3, 1, out.turn, out.moment, own);
    for (int i = 0; i < N; i++) {
        own[i] -= out.ends[i];
        worst = worst_of(worst, fabs(own[i] - (F[0][i] - F[1][i]) / 2));
        size = fmax(size, fabs(own[i]));
    }
    gsl_test(outcome || !(worst < 1e-6 * size), "%d stages, matrices %d: linear forces (%.1e)",
             stages, matrices, worst / size);
    if (across) {
        const double left = moment_left(&s, q, own, x);
        gsl_test(!(left < 1e-11 * size), "%d stages: moments at rest (%.1e)", stages, left / size);
        free(s.data);
        return;
    }
    element_collocation.strain(s.data, x, &(strain_output){.s = sigma, .H = k});
    dense_add_congruence(STRAINS, N, J, G, k, work);
    dense_mul(STRAINS, 3, N, mixed, out.turn, cross);
    dense_add_transpose_mul(N, STRAINS, N, J, cross, both);
    worst = size = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double found = (K[0][i * N + j] - K[1][i * N + j]) / 2;
            worst = worst_of(worst, fabs(k[i * N + j] + H[i * N + j] + both[i * N + j] +
                                         both[j * N + i] - found));
            size = fmax(size, fabs(found));
        }
    gsl_test(!(worst < 0.1 * size), "%d stages: stiffness of the stresses (%.1e)", stages,
             worst / size);
    free(s.data);
}

enum { MANY = 6 };

static void many(int stages, const double curvature[3])
{
    const along_subject s = subject_of(stages, 0, curvature);
    const element_data *data[MANY];
    double q[3 * POINTS], e[MANY][STRAINS], inner[MANY][INNER], sigma[2][MANY][STRAINS],
        C[2][MANY][STRAINS * STRAINS], memory[2][MANY][MEMORY], mixed[2][MANY][3 * STRAINS],
        H[2][MANY][N * N];
    node_state x[2 * MANY];
    load_of(3, 1, q);
    for (int k = 0; k < MANY; k++) {
        data[k] = s.data;
        state_of(&s, 0.02 * (k + 1), x + (ptrdiff_t)2 * k);
        element_collocation.strain(s.data, x + (ptrdiff_t)2 * k, &(strain_output){.e = e[k]});
        element_collocation.rest(s.data, inner[k]);
    }
    for (int count = 1; count <= MANY; count++) {
        along_output out[2][MANY];
        status outcome[2][MANY];
        for (int k = 0; k < MANY; k++)
            for (int i = 0; i < 2; i++) {
                out[i][k] = (along_output){.force = q,
                                           .e = e[k],
                                           .inner = inner[k],
                                           .sigma = sigma[i][k],
                                           .C = C[i][k],
                                           .memory = memory[i][k],
                                           .mixed = mixed[i][k],
                                           .H = H[i][k]};
                outcome[i][k] = STATUS_SINGULAR;
                sigma[i][k][0] = out[i][k].second[0] = 17;
            }
        element_collocation.along(count, data, x, out[0], outcome[0]);
        for (int k = 0; k < count; k++)
            element_collocation.along(1, &data[k], x + (ptrdiff_t)2 * k, &out[1][k],
                                      &outcome[1][k]);
        int differ = 0, written = 0;
        for (int k = 0; k < count; k++)
            differ += outcome[0][k] != STATUS_OK || outcome[1][k] != STATUS_OK ||
                      memcmp(sigma[0][k], sigma[1][k], sizeof sigma[0][k]) != 0 ||
                      memcmp(C[0][k], C[1][k], sizeof C[0][k]) != 0 ||
                      memcmp(mixed[0][k], mixed[1][k], sizeof mixed[0][k]) != 0 ||
                      memcmp(H[0][k], H[1][k], sizeof H[0][k]) != 0 ||
                      memcmp(out[0][k].turn, out[1][k].turn, sizeof out[0][k].turn) != 0 ||
                      memcmp(out[0][k].ends, out[1][k].ends, sizeof out[0][k].ends) != 0 ||
                      memcmp(out[0][k].moment, out[1][k].moment, sizeof out[0][k].moment) != 0 ||
                      memcmp(out[0][k].second, out[1][k].second, sizeof out[0][k].second) != 0;
        for (int k = count; k < MANY; k++)
            written += outcome[0][k] != STATUS_SINGULAR || sigma[0][k][0] != 17 ||
                       out[0][k].second[0] != 17;
        gsl_test(differ || written,
                 "%d stages, %d of %d at once: %d differ, %d too many are written", stages, count,
                 MANY, differ, written);
    }
    free(s.data);
}

int main(void)
{
    static const double straight[3] = {0}, curved[3] = {0.4, -0.7, 0.9};
    for (int stages = 3; stages <= 5; stages++) {
        tangent(stages, 0, straight);
        tangent(stages, 0, curved);
        tangent(stages, 1, curved);
        closed_path(stages, curved);
        rate(stages);
        many(stages, curved);
        resultants(stages, curved);
        linear(stages, 0, curved, 1);
        linear(stages, 1, curved, 1);
        linear(stages, 0, straight, 0);
    }
    return gsl_test_summary();
}
