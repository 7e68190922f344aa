#include <math.h>
#include <string.h>

#include <gsl/gsl_eigen.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"
#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"

enum { M = TEST_ELEMENT_STRAINS, N = TEST_ELEMENT_COORDINATES, VALUES = 12 };

/* Returns the smallest eigenvalue of a symmetric matrix; NaN: out of memory, or not computed. */
static double least_eigenvalue(int n, double A[])
{
    double value[M], least = INFINITY;
    gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc((size_t)n);
    if (w == NULL)
        return NAN;
    gsl_matrix_view a = gsl_matrix_view_array(A, (size_t)n, (size_t)n);
    gsl_vector_view v = gsl_vector_view_array(value, (size_t)n);
    const int failed = gsl_eigen_symm(&a.matrix, &v.vector, w);
    gsl_eigen_symm_free(w);
    for (int i = 0; i < n; i++)
        least = value[i] < least ? value[i] : least;
    return failed ? NAN : least;
}

/* Computes B, the damping matrix V scaled to diagonal entries of 1 or -1 (damping_scale). Returns 0
 * and reports a violation if an entry of V is NaN or Inf. */
static int scale_damping(const test_element *s, const double C[], const double V[], double B[],
                         check_result *one)
{
    const int n = s->strains, wrong = damping_scale(n, C, V, B);
    if (wrong < n * n)
        checks_require(one, 0, "damping: entry %d, %d of V is %s; give finite numbers%s",
                       wrong / n + 1, wrong % n + 1, isnan(V[wrong]) ? "NaN" : "Inf", s->words);
    return wrong == n * n;
}

void own_damping_check(const test_element *s, const double C[], check_results *c)
{
    const int n = s->strains;
    double V[M * M], B[M * M];
    if (s->type.damping == NULL)
        return;
    checks_current(c, "damping%s", s->words);
    memset(V, 0, sizeof V);
    s->type.damping(s->data, V);
    check_result *symmetric = checks_open(c, "the damping matrix is symmetric", DAMPING_ROUNDING),
                 *dissipates = checks_open(c, "damping dissipates energy", DAMPING_ROUNDING);
    if (!scale_damping(s, C, V, B, dissipates))
        return;
    for (int i = 0; i < n; i++) {
        checks_deviation(dissipates, B[n * i + i] < 0 ? -B[n * i + i] : 0,
                         "damping: entry %d, %d of V is %.6g N s/m, so some motions gain energy; "
                         "give a positive semidefinite matrix%s",
                         i + 1, i + 1, V[n * i + i], s->words);
        for (int j = 0; j < i; j++)
            checks_deviation(symmetric, fabs(B[n * i + j] - B[n * j + i]),
                             "damping: entry %d, %d of V is %.6g, but the transposed entry is "
                             "%.6g; make V symmetric%s",
                             i + 1, j + 1, V[n * i + j], V[n * j + i], s->words);
    }
    const double least = least_eigenvalue(n, B);
    checks_deviation(
        dissipates,
        least < 0    ? -least
        : least >= 0 ? 0
                     : NAN,
        "damping: V, scaled to a diagonal of 1, has the eigenvalue %.6g, so some motions "
        "gain energy; give a positive semidefinite matrix%s",
        least, s->words);
}

typedef struct line_place {
    test_element_stencil at;
    double point, force[3], moment[3];
} line_place;

/* Computes the position and the axes of the section, and P, T and H unless they are NULL. */
static line_output section_of(const line_place *p, const node_state x[], double P[], double T[],
                              double H[])
{
    line_output out = {.at = p->point, .P = P, .T = T, .H = H};
    memcpy(out.force, p->force, sizeof out.force);
    memcpy(out.moment, p->moment, sizeof out.moment);
    p->at.s->type.line(p->at.s->data, x, 1, &out);
    return out;
}

static int motion_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const line_place *p = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(&p->at, i, si, j, sj, x);
    const line_output out = section_of(p, x, NULL, NULL, NULL);
    memcpy(values, out.r, sizeof out.r);
    memcpy(values + 3, out.R, sizeof out.R);
    return 0;
}

static void forces_of(const line_place *p, const node_state x[], double F[])
{
    const int n = p->at.s->coordinates;
    double P[3 * N], T[3 * N];
    section_of(p, x, P, T, NULL);
    memset(F, 0, (size_t)n * sizeof *F);
    dense_add_transpose_mul(n, 3, 1, P, p->force, F);
    dense_add_transpose_mul(n, 3, 1, T, p->moment, F);
}

static int forces_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const line_place *p = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(&p->at, i, si, j, sj, x);
    forces_of(p, x, values);
    return 0;
}

static void check_jacobian(const line_place *p, check_result *one)
{
    const test_element *s = p->at.s;
    const int n = s->coordinates;
    char where[TEST_ELEMENT_WORDS];
    double P[3 * N], T[3 * N], change[VALUES];
    const line_output now = section_of(p, p->at.x, P, T, NULL);
    for (int j = 0; j < n; j++) {
        const double unit = test_element_unit(s, j);
        double turn[3] = {0};
        stencil_first(motion_at, p, VALUES, j, change);
        for (int k = 0; k < 3; k++) {
            const double axis[3] = {now.R[k], now.R[3 + k], now.R[6 + k]},
                         moved[3] = {change[3 + k], change[6 + k], change[9 + k]};
            double part[3];
            vec3_cross(axis, moved, part);
            for (int i = 0; i < 3; i++)
                turn[i] += part[i] / 2;
        }
        for (int i = 0; i < 3; i++) {
            checks_deviation(one, fabs(P[n * i + j] * unit - change[i]) / s->request.length,
                             "line: at %g of the length, entry %d, %d of P (%s) is %.6g, but "
                             "finite differences of r give %.6g; correct P or r%s",
                             p->point, i + 1, j + 1, test_element_coordinate(s, j, where),
                             P[n * i + j], change[i] / unit, s->words);
            checks_deviation(one, fabs(T[n * i + j] * unit - turn[i]),
                             "line: at %g of the length, entry %d, %d of T (%s) is %.6g, but "
                             "finite differences of R give %.6g; correct T or R%s",
                             p->point, i + 1, j + 1, test_element_coordinate(s, j, where),
                             T[n * i + j], turn[i] / unit, s->words);
        }
    }
}

/* Checks H against finite differences of the nodal forces. */
static void check_second(const line_place *p, check_result *one)
{
    const test_element *s = p->at.s;
    const int n = s->coordinates;
    double H[N * N], P[3 * N], T[3 * N], F[N], column[N];
    section_of(p, p->at.x, P, T, H);
    forces_of(p, p->at.x, F);
    for (int j = 0; j < n; j++) {
        const double unit = test_element_unit(s, j);
        const int k = j % NODE_COORDINATES - 3, first = j - k;
        stencil_first(forces_at, p, n, j, column);
        for (int i = 0; i < n; i++)
            column[i] /= unit;
        if (k >= 0 && k < 3) {
            column[first + (k + 1) % 3] += F[first + (k + 2) % 3] / 2;
            column[first + (k + 2) % 3] -= F[first + (k + 1) % 3] / 2;
        }
        for (int i = 0; i < n; i++)
            checks_deviation(one, fabs(H[n * i + j] - column[i]) * unit * test_element_unit(s, i),
                             "line: at %g of the length, entry %d, %d of H is %.6g, but finite "
                             "differences of the nodal forces give %.6g; correct H%s",
                             p->point, i + 1, j + 1, H[n * i + j], column[i], s->words);
    }
}

static void check_sums(const line_place *p, check_result *one)
{
    const test_element *s = p->at.s;
    const node_state *x = p->at.x;
    const line_output at = section_of(p, x, NULL, NULL, NULL);
    double F[N], sum[6] = {0}, moment[3];
    forces_of(p, x, F);
    for (int k = 0; k < s->nodes; k++) {
        const double *own = F + NODE_COORDINATES * k;
        vec3_cross(x[k].r, own, moment);
        for (int i = 0; i < 3; i++) {
            sum[i] += own[i];
            sum[3 + i] += own[3 + i] + moment[i];
        }
    }
    vec3_cross(at.r, p->force, moment);
    for (int i = 0; i < 6; i++) {
        const double right = i < 3 ? p->force[i] : p->moment[i - 3] + moment[i - 3],
                     size = i < 3 ? s->request.length : 1;
        checks_deviation(
            one, fabs(sum[i] - right) * size,
            "line: for a load at %g of the length, the nodal forces have the %s %c = %.6g instead "
            "of %.6g; let the section follow rigid motions of the nodes%s",
            p->point, i < 3 ? "sum along" : "moment about", "xyz"[i % 3], sum[i], right,
            s -> words);
    }
}

static void check_at_rest(const line_place *p, check_result *one)
{
    const test_element *s = p->at.s;
    node_state x[ELEMENT_MAX_NODES];
    test_element_state(s, 0, 1, x);
    const line_output at = section_of(p, x, NULL, NULL, NULL);
    for (int i = 0; i < 3; i++) {
        const double right = (1 - p->point) * x[0].r[i] + p->point * x[s->nodes - 1].r[i];
        checks_deviation(one, fabs(at.r[i] - right) / s->request.length,
                         "line: in the undeformed element, the section at %g of the length is at "
                         "%c = %.6g instead of %.6g; correct r%s",
                         p->point, "xyz"[i], at.r[i], right, s->words);
    }
    for (int i = 0; i < 9; i++)
        checks_deviation(one, fabs(at.R[i] - x[0].R[i]),
                         "line: in the undeformed element, R at %g of the length differs from R of "
                         "the nodes; correct R%s",
                         p->point, s->words);
}

void own_line_check(const test_element *s, check_results *c)
{
    static const double point[] = {0, 0.3, 0.75, 1}, turn[3] = {0.5, -0.6, 0.7};
    node_state bent[ELEMENT_MAX_NODES], x[ELEMENT_MAX_NODES];
    const int straight = vec3_norm(s->made.curvature) == 0;
    if (s->type.line == NULL)
        return;
    checks_current(c, "line%s", s->words);
    test_element_state(s, 0.05, 5, bent);
    test_element_rigid_motion(s, turn, bent, x);
    for (size_t k = 0; k < sizeof point / sizeof point[0]; k++) {
        const double f = 1 / s->request.length;
        const line_place p = {.at = {s, x},
                              .point = point[k],
                              .force = {0.7 * f, -1.1 * f, 0.4 * f},
                              .moment = {-0.6, 0.9, 1.2}};
        check_jacobian(
            &p, checks_open(c, "P and T are the derivatives of position and rotation", 1e-8));
        check_second(&p, checks_open(c, "H is the derivative of the nodal forces of a load", 1e-7));
        check_sums(&p, checks_open(c, "the nodal forces are in equilibrium with the load", 1e-11));
        if (straight)
            check_at_rest(&p, checks_open(c, "sections of the undeformed element", 1e-13));
    }
}
