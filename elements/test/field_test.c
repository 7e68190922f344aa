#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/shared/status.h"
#include "elements/sheet/potential.h"
#include "elements/sheet/sheet.h"
#include "elements/test/bimoment_values.h"
#include "elements/test/kit.h"

enum { N = ELEMENT_MAX_COORDINATES, LOADS = 3, MOMENT = 1, FOLLOWER = 2, ARM = 4, KINDS = 8 };
static const double l0 = 0.8;

static section angle(void)
{
    static const double point[3][2] = {{0, 0}, {0.3, 0}, {0, 0.2}}, thickness[2] = {0.03, 0.04};
    static const int ends[2][2] = {{0, 1}, {0, 2}};
    const section_spec spec = section_spec_walls(2e5, 8e4, 2, point, ends, thickness);
    return sections_computed(&spec);
}

static void prepare(const section *c, int nodes, unsigned features, displacement_field *f)
{
    const element_request request = {.section = c, .length = l0, .features = features};
    field_prepare(&request, nodes, f);
}

static const unsigned shear = FEATURE_SHEAR, all = FEATURE_SHEAR | FEATURE_WARPING;

static void loads_of(const displacement_field *f, int kind, field_rows rows[LOADS],
                     field_load load[LOADS])
{
    uint64_t seed = 11;
    memset(load, 0, LOADS * sizeof *load);
    for (int i = 0; i < LOADS; i++) {
        field_at(f, 0.5 + 0.4 * random_number(&seed), &rows[i]);
        double *v = kind & MOMENT ? load[i].moment : load[i].force;
        for (int k = 0; k < 3; k++) {
            v[k] = random_number(&seed);
            load[i].arm[k] = kind & ARM ? 0.2 * random_number(&seed) : 0;
        }
        load[i].follower = (kind & FOLLOWER) != 0;
    }
}

static void forces_at(const displacement_field *f, int kind, const double d[], double times,
                      const double more[], double at, double forces[N], double K[N * N])
{
    node_state x[ELEMENT_MAX_NODES];
    field_rows rows[LOADS];
    field_load load[LOADS];
    nodes_straight(f->nodes, l0, x);
    nodes_move(f->nodes, times, d, x);
    nodes_move(f->nodes, at, more, x);
    loads_of(f, kind, rows, load);
    memset(forces, 0, N * sizeof *forces);
    if (K != NULL)
        memset(K, 0, N * N * sizeof *K);
    field_add_loads(f, x, LOADS, rows, load, forces, K);
}

/* Compares K along one direction with fourth-order finite differences. For moments M at the nodes,
 * the exponential chart adds 1/2 M . (e_j x e_i) to dF_i/dx_j. */
static void derivatives(const displacement_field *f, int kind, const char *name)
{
    const int n = NODE_COORDINATES * f->nodes;
    const double h = 2e-3;
    double d[N], more[N], F[N], K[N * N], near[2][N], far[2][N], found[N] = {0}, largest = 0,
                                                                 off = 0;
    nodes_increments(f->nodes, l0, 0.9, 3, d);
    nodes_increments(f->nodes, l0, 1, 4, more);
    forces_at(f, kind, d, 1, more, 0, F, K);
    for (int side = 0; side < 2; side++) {
        forces_at(f, kind, d, 1, more, side ? h : -h, near[side], NULL);
        forces_at(f, kind, d, 1, more, side ? 2 * h : -2 * h, far[side], NULL);
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            found[i] -= K[i * n + j] * more[j];
        largest = fmax(largest, fabs(found[i]));
    }
    for (int i = 0; i < n; i++) {
        const int first = i / NODE_COORDINATES * NODE_COORDINATES + 3, turn = i - first;
        double chart = 0;
        if (turn >= 0 && turn < 3) {
            double e[3] = {turn == 0, turn == 1, turn == 2}, cross[3];
            vec3_cross(more + first, e, cross);
            chart = vec3_dot(F + first, cross) / 2;
        }
        const double slope =
            (8 * (near[1][i] - near[0][i]) - (far[1][i] - far[0][i])) / (12 * h) + chart;
        off = fmax(off, fabs(found[i] - slope));
    }
    gsl_test(!(off <= 1e-9 * largest), "%s, kind %d: tangent off by %g of %g", name, kind, off,
             largest);
    if (!(kind & (MOMENT | FOLLOWER)))
        gsl_test(!(nodes_asymmetry(n, K) <= 1e-13), "%s, kind %d: not symmetric, %g", name, kind,
                 nodes_asymmetry(n, K));
}

static void resultants(const displacement_field *f, int kind, const char *name)
{
    double d[N], none[N] = {0}, F[N], force[3] = {0}, moment[3] = {0}, expected[2][3] = {{0}};
    node_state x[ELEMENT_MAX_NODES];
    field_rows rows[LOADS];
    field_load load[LOADS];
    double R[9] = {0};
    for (int k = 0; k < f->nodes; k++) {
        const double turn[3] = {0.7, -0.4, 1.1};
        double along[3];
        nodes_straight(f->nodes, l0, x);
        nodes_turn(x[k].R, turn);
        memcpy(R, x[k].R, sizeof R);
        mat3_mul_vec(R, x[k].r, along);
        for (int i = 0; i < 3; i++) {
            d[NODE_COORDINATES * k + i] = along[i] - x[k].r[i] + 0.1 * i;
            d[NODE_COORDINATES * k + 3 + i] = turn[i];
        }
        d[NODE_COORDINATES * k + 6] = 0;
    }
    forces_at(f, kind, d, 1, none, 0, F, NULL);
    nodes_straight(f->nodes, l0, x);
    nodes_move(f->nodes, 1, d, x);
    for (int k = 0; k < f->nodes; k++) {
        double turning[3];
        vec3_cross(x[k].r, F + NODE_COORDINATES * k, turning);
        for (int i = 0; i < 3; i++) {
            force[i] += F[NODE_COORDINATES * k + i];
            moment[i] += F[NODE_COORDINATES * k + 3 + i] + turning[i];
        }
    }
    loads_of(f, kind, rows, load);
    for (int i = 0; i < LOADS; i++) {
        double at[3] = {0}, arm[3], v[3], m[3], turning[3];
        for (int k = 0; k < f->nodes; k++)
            for (int c = 0; c < 3; c++)
                at[c] += rows[i].part[k] * x[k].r[c];
        mat3_mul_vec(R, load[i].arm, arm);
        memcpy(v, load[i].force, sizeof v);
        memcpy(m, load[i].moment, sizeof m);
        if (load[i].follower) {
            mat3_mul_vec(R, load[i].force, v);
            mat3_mul_vec(R, load[i].moment, m);
        }
        for (int c = 0; c < 3; c++)
            at[c] += arm[c];
        vec3_cross(at, v, turning);
        for (int c = 0; c < 3; c++) {
            expected[0][c] += v[c];
            expected[1][c] += m[c] + turning[c];
        }
    }
    for (int c = 0; c < 3; c++) {
        gsl_test_abs(force[c], expected[0][c], 1e-13, "%s, kind %d: force %d", name, kind, c);
        gsl_test_abs(moment[c], expected[1][c], 1e-13, "%s, kind %d: moment %d", name, kind, c);
    }
}

static void closed_path(const displacement_field *f, int kind, const char *name)
{
    enum { STEPS = 400 };
    double d[N], more[N], none[N] = {0}, work = 0, size = 0;
    nodes_increments(f->nodes, l0, 0.9, 5, d);
    nodes_increments(f->nodes, l0, 0.9, 6, more);
    for (int step = 0; step < STEPS; step++) {
        const double pi = acos(-1), t = 2 * pi * (step + 0.5) / STEPS, h = 2 * pi / STEPS;
        double at[N], F[N];
        for (int i = 0; i < N; i++)
            at[i] = cos(t) * d[i] +
                    (i % NODE_COORDINATES >= 3 && i % NODE_COORDINATES < 6 ? 0 : sin(t) * more[i]);
        forces_at(f, kind, at, 1, none, 0, F, NULL);
        for (int i = 0; i < NODE_COORDINATES * f->nodes; i++) {
            const double rate =
                h *
                (-sin(t) * d[i] +
                 (i % NODE_COORDINATES >= 3 && i % NODE_COORDINATES < 6 ? 0 : cos(t) * more[i]));
            work += F[i] * rate;
            size += fabs(F[i] * rate);
        }
    }
    gsl_test(!(fabs(work) <= 1e-12 * size), "%s, kind %d: work %g of %g on a closed path", name,
             kind, work, size);
}

/* Fixed-end forces of a straight element with shear deformation under a uniform load (force q l/2,
 * moment q l^2/12) and under a linearly increasing load (force q l (3/20 + Phi/6)/(1 + Phi) at the
 * start): Przemieniecki, Theory of Matrix Structural Analysis, 1968, sec. 10. */
static void fixed_ends(void)
{
    const section c = {.young = 1,
                       .shear_modulus = 1,
                       .A = 1,
                       .Iy = 0.02,
                       .Iz = 0.03,
                       .It = 0.01,
                       .Ip = 0.05,
                       .D = {0.5, 0, 0, 0, 0.4, 0, 0, 0, 1},
                       .F = {2, 0, 0, 0, 2.5, 0, 0, 0, 0}};
    displacement_field f;
    node_state x[2];
    double at[FIELD_MOST_POINTS], w[FIELD_MOST_POINTS];
    prepare(&c, 2, shear, &f);
    nodes_straight(2, l0, x);
    const int count = field_points(&f, 0, 1, at, w);
    for (int power = 0; power < 2; power++)
        for (int across = 1; across < 3; across++) {
            const double inertia = across == 1 ? c.Iz : c.Iy,
                         Phi = 12 * inertia * c.F[4 * (across - 1)] / (l0 * l0),
                         sign = across == 1 ? 1 : -1;
            double F[14] = {0};
            for (int g = 0; g < count; g++) {
                field_rows rows;
                field_load load = {.follower = 0};
                field_at(&f, at[g], &rows);
                load.force[across] = l0 * w[g] * (power ? at[g] : 1);
                field_add_loads(&f, x, 1, &rows, &load, F, NULL);
            }
            const double p = power ? l0 * (9 + 10 * Phi) / (60 * (1 + Phi)) : l0 / 2,
                         q = power ? l0 * (21 + 20 * Phi) / (60 * (1 + Phi)) : l0 / 2,
                         end_p = power ? l0 * l0 * (4 + 5 * Phi) / (120 * (1 + Phi)) : l0 * l0 / 12,
                         end_q = power ? l0 * l0 * (6 + 5 * Phi) / (120 * (1 + Phi)) : l0 * l0 / 12;
            gsl_test_rel(F[across], p, 1e-13, "force on p, power %d", power);
            gsl_test_rel(F[7 + across], q, 1e-13, "force on q, power %d", power);
            gsl_test_rel(F[across == 1 ? 5 : 4], sign * end_p, 1e-13, "moment on p, %d", power);
            gsl_test_rel(F[across == 1 ? 12 : 11], -sign * end_q, 1e-13, "moment on q, %d", power);
        }
}

static void field_tests(void)
{
    const section c = angle();
    for (int nodes = 2; nodes <= 3; nodes++)
        for (int warps = 0; warps < (nodes == 2 ? 2 : 1); warps++) {
            displacement_field f;
            const char *name = nodes == 3 ? "three nodes" : warps ? "two nodes, warping" : "two";
            prepare(&c, nodes, warps ? all : shear, &f);
            for (int kind = 0; kind < KINDS; kind++) {
                if (kind & MOMENT && kind & ARM)
                    continue;
                derivatives(&f, kind, name);
                resultants(&f, kind, name);
                if (!(kind & (MOMENT | FOLLOWER)))
                    closed_path(&f, kind, name);
            }
        }
    fixed_ends();
}

/* The field of n nodes must contain every polynomial of degree n: Lagrange's polynomials of the
 * positions have degree n - 1, and the slopes of the nodes add the highest power. */
static void polynomials(void)
{
    const section c = angle();
    for (int nodes = 3; nodes <= ELEMENT_MAX_NODES; nodes++)
        for (int unequal = 0; unequal < 2; unequal++) {
            displacement_field f;
            double largest = 0;
            prepare(&c, nodes, shear, &f);
            for (int k = 1; k < nodes - 1 && unequal; k++)
                f.place[k] += 0.2 * f.place[k] * (1 - f.place[k]);
            for (int degree = 0; degree <= nodes; degree++)
                for (double x = 0.05; x < 1; x += 0.3) {
                    field_rows at;
                    double sum = 0;
                    field_at(&f, x, &at);
                    for (int k = 0; k < nodes; k++) {
                        const double slope =
                            degree > 0 ? degree * pow(f.place[k], degree - 1) / f.l0 : 0;
                        sum += at.part[k] * pow(f.place[k], degree) + at.lean[k] * slope;
                    }
                    largest = fmax(largest, fabs(sum - pow(x, degree)));
                }
            gsl_test(!(largest < 1e-12), "%d %s nodes: polynomials, error %g", nodes,
                     unequal ? "unequal" : "equal", largest);
        }
}

static const double inner_l0 = 0.8;

static void add_inner(int i, int j, double value, double B[FIELD_INNER * FIELD_INNER])
{
    B[i * FIELD_INNER + j] = B[j * FIELD_INNER + i] = value;
}

/* B of a uniform element is the coefficient of -omega^4 in the power series of its exact dynamic
 * stiffness. For rods and shafts the series are those of z cot(z) and z/sin(z), where z = omega l
 * sqrt(rho/E) for a rod. For the Euler-Bernoulli beam the terms are (59 z^8/161700) E I/l^3 and so
 * on, where z^4 = rho A omega^2 l^4/(E I). */
static void field_inner_tests(void)
{
    const double A = 0.2, I[3] = {0.013, 0.007, 0.009}, density = 3, stiffness[2] = {A, 0.009},
                 mass[2] = {density * A, density * 0.02};
    section_spec spec = sections_of(A, I[0], I[1], I[2]);
    spec.density = density;
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c, .length = inner_l0, .features = FEATURE_MASS};
    displacement_field f;
    double B[FIELD_INNER * FIELD_INNER], exact[FIELD_INNER * FIELD_INNER] = {0};
    field_prepare(&request, 2, &f);
    field_inner(&request, &f, B);
    for (int k = 0; k < 2; k++) {
        const int p = 3 * k, q = NODE_COORDINATES + p;
        const double b = mass[k] * mass[k] * inner_l0 * inner_l0 * inner_l0 / stiffness[k];
        add_inner(p, p, b / 45, exact);
        add_inner(q, q, b / 45, exact);
        add_inner(p, q, b * 7 / 360, exact);
    }
    for (int across = 1; across < 3; across++) {
        const int v = across, w = NODE_COORDINATES + v, t = across == 1 ? 5 : 4,
                  u = NODE_COORDINATES + t;
        const double b = mass[0] * mass[0] * pow(inner_l0, 5) / I[across == 1 ? 1 : 0],
                     l = across == 1 ? inner_l0 : -inner_l0;
        for (int side = 0; side < 2; side++) {
            add_inner(side ? w : v, side ? w : v, b * 59 / 161700, exact);
            add_inner(side ? u : t, side ? u : t, b * inner_l0 * inner_l0 * 71 / 4365900, exact);
            add_inner(side ? w : v, side ? u : t, (side ? -1 : 1) * b * l * 223 / 2910600, exact);
            add_inner(side ? w : v, side ? t : u, (side ? 1 : -1) * b * l * 1681 / 23284800, exact);
        }
        add_inner(v, w, b * 1279 / 3880800, exact);
        add_inner(t, u, -b * inner_l0 * inner_l0 * 1097 / 69854400, exact);
    }
    for (int i = 0; i < FIELD_INNER; i++)
        for (int j = 0; j < FIELD_INNER; j++) {
            const double size = sqrt(exact[i * (FIELD_INNER + 1)] * exact[j * (FIELD_INNER + 1)]);
            gsl_test(!(fabs(B[i * FIELD_INNER + j] - exact[i * FIELD_INNER + j]) <= 1e-11 * size),
                     "B[%d][%d] = %.12g, not %.12g", i, j, B[i * FIELD_INNER + j],
                     exact[i * FIELD_INNER + j]);
        }
}

extern const element_type element_sheet_second, element_sheet_third, element_sheet_third_printed;

enum { COEFFICIENTS_N = 8, MX = 1, MYP, MYQ, MODES = 5 };
enum {
    ONE,
    PX = 1 + SHEET_LOCAL_PX,
    ZP = 1 + SHEET_LOCAL_ZP,
    ZQ = 1 + SHEET_LOCAL_ZQ,
    WP = 1 + SHEET_LOCAL_WP,
    WQ = 1 + SHEET_LOCAL_WQ
};

/* Stresses of the unit torques M, PP, PQ, QP and QQ, and the variables that multiply these
 * torques. */
static const int stress_of[MODES] = {MX, MYP, MYP, MYQ, MYQ},
                 variable_of[MODES] = {ONE, ZP, ZQ, ZP, ZQ};

static double find(int count, const sheet_potential_term terms[], int i, int j, int a, int b)
{
    for (int k = 0; k < count; k++)
        if (terms[k].i == i && terms[k].j == j &&
            ((terms[k].a == a && terms[k].b == b) || (terms[k].a == b && terms[k].b == a)))
            return terms[k].c;
    return 0;
}

static double error_of(double got, double expected)
{
    return expected == 0 ? fabs(got) : fabs(got / expected - 1);
}

static double compliance(const double value[], int k, int l)
{
    return k >= l ? value[k * (k + 1) / 2 + l] : value[l * (l + 1) / 2 + k];
}

/* Returns the coefficient of v_a v_b in A_ij according to the table: the sum over every pair of
 * unit torques that contributes to it. */
static double expected_compliance(const double value[], int i, int j, int a, int b)
{
    double sum = 0;
    for (int k = 0; k < MODES; k++)
        for (int l = 0; l < MODES; l++) {
            const int va = variable_of[k], vb = variable_of[l];
            if (stress_of[k] == i && stress_of[l] == j &&
                ((va == a && vb == b) || (va == b && vb == a)))
                sum += compliance(value, k, l);
        }
    return sum;
}

static void coefficients(void)
{
    static const int twist[3] = {PX, WP, WQ}, ends[3][2] = {{WP, WP}, {WP, WQ}, {WQ, WQ}};
    double worst = 0;
    for (size_t row = 0; row < sizeof bimoment_values / sizeof bimoment_values[0]; row++) {
        const double lambda = bimoment_values[row].lambda, *value = bimoment_values[row].value;
        const section c = {.young = 1,
                           .shear_modulus = 1,
                           .A = 1,
                           .Iy = 1,
                           .Iz = 1,
                           .It = 1,
                           .Iw = 1 / (lambda * lambda),
                           .Ip = 2};
        const element_request request = {.section = &c, .length = 1, .features = FEATURE_WARPING};
        sheet_potential p;
        gsl_test(sheet_coefficients_prepare(&request, bimoment_values[row].printed, &p, NULL) !=
                     STATUS_OK,
                 "potential, lambda = %g", lambda);
        double error = 0;
        for (int k = 0; k < MODES; k++)
            for (int l = 0; l <= k; l++) {
                const int i = stress_of[k], j = stress_of[l], a = variable_of[k],
                          b = variable_of[l];
                error = fmax(error, error_of(find(p.terms_A, p.A, i, j, a, b),
                                             expected_compliance(value, i, j, a, b)));
            }
        for (int k = 0; k < MODES; k++)
            for (int m = 0; m < 3; m++)
                error = fmax(
                    error, error_of(find(p.terms_b, p.b, stress_of[k], 0, variable_of[k], twist[m]),
                                    value[15 + 3 * k + m]));
        for (int m = 0; m < 3; m++)
            error = fmax(error, error_of(find(p.terms_P0, p.P0, 0, 0, ends[m][0], ends[m][1]),
                                         value[30 + m]));
        gsl_test(!(error < 2e-14), "lambda = %g, sign of u_y %s: coefficients (%.1e)", lambda,
                 bimoment_values[row].printed ? "printed" : "corrected", error);
        worst = fmax(worst, error);
    }
    gsl_test(!(worst > 0 && worst < 2e-14), "largest relative error of all coefficients: %.1e",
             worst);
}

static void uniform_torsion(void)
{
    static const double torque[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1] = {
        {1}, {-1, 4, -5, 2}, {0, 2, -4, 2}, {0, 0, -2, 2}, {0, 0, -1, 2}};
    sheet_torsion_integrals limit, near[2];
    double error[2] = {0};
    sheet_torsion_integrate(INFINITY, torque, &limit);
    for (int n = 0; n < 2; n++) {
        sheet_torsion_integrate(n == 0 ? 1e6 : 1e8, torque, &near[n]);
        for (int k = 0; k < SHEET_TORSION_MODES; k++)
            for (int l = 0; l < SHEET_TORSION_MODES; l++)
                error[n] = fmax(error[n], fabs(near[n].compliance[k][l] - limit.compliance[k][l]));
    }
    gsl_test(!(error[0] < 3e-6 && fabs(error[1] / error[0] - 0.01) < 1e-3),
             "lambda -> inf is uniform torsion (%.1e, %.1e)", error[0], error[1]);
}

static void stiffness_at_rest(const element_type *type, const section *c, unsigned features,
                              double C[COEFFICIENTS_N * COEFFICIENTS_N])
{
    const double e[COEFFICIENTS_N] = {0};
    const element_request request = {.section = c, .length = 0.9, .features = features};
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, NULL) != STATUS_OK, "%s: prepared",
             type->name);
    type->stress(d, e, NULL, &(stress_output){.C = C});
    free(d);
}

/* In the undeformed state, the third-order element differs from the second-order element only by
 * the hyperbolic twist, which tends to the cubic twist for lambda -> 0. */
static void second_order_limit(void)
{
    section c = {.young = 3.1,
                 .shear_modulus = 1.3,
                 .A = 0.7,
                 .Iy = 0.23,
                 .Iz = 0.0117,
                 .It = 0.031,
                 .Iw = 1e4,
                 .Ip = 0.2417};
    double second[COEFFICIENTS_N * COEFFICIENTS_N], third[COEFFICIENTS_N * COEFFICIENTS_N],
        worst = 0;
    c.F[4] = 1 / (0.83 * c.A);
    for (int warping = 0; warping < 2; warping++)
        for (int printed = 0; printed < 2; printed++) {
            const unsigned features = FEATURE_SHEAR | (warping ? FEATURE_WARPING : 0);
            const element_type *type =
                printed ? &element_sheet_third_printed : &element_sheet_third;
            stiffness_at_rest(&element_sheet_second, &c, features, second);
            stiffness_at_rest(type, &c, features, third);
            if (!warping)
                for (int pass = 0; pass < 2; pass++) {
                    double *C = pass == 0 ? second : third;
                    for (int i = 0; i < COEFFICIENTS_N; i++)
                        C[COEFFICIENTS_N * i + 1] +=
                            C[COEFFICIENTS_N * i + 6] + C[COEFFICIENTS_N * i + 7],
                            C[COEFFICIENTS_N * i + 6] = C[COEFFICIENTS_N * i + 7] = 0;
                    for (int j = 0; j < COEFFICIENTS_N; j++)
                        C[COEFFICIENTS_N + j] +=
                            C[COEFFICIENTS_N * 6 + j] + C[COEFFICIENTS_N * 7 + j],
                            C[COEFFICIENTS_N * 6 + j] = C[COEFFICIENTS_N * 7 + j] = 0;
                }
            for (int i = 0; i < COEFFICIENTS_N; i++)
                for (int j = 0; j < COEFFICIENTS_N; j++)
                    worst = fmax(worst, fabs(third[COEFFICIENTS_N * i + j] -
                                             second[COEFFICIENTS_N * i + j]) /
                                            (sqrt(second[(COEFFICIENTS_N + 1) * i] *
                                                  second[(COEFFICIENTS_N + 1) * j]) +
                                             1e-300));
        }
    gsl_test(!(worst < 1e-14), "the undeformed third-order element is the second-order one (%.1e)",
             worst);
}

static void sheet_coefficients_tests(void)
{
    coefficients();
    uniform_torsion();
    second_order_limit();
}

static void line_of(int length, int middle)
{
    char path[4000];
    fault f;
    memset(f.text, '#', sizeof f.text);
    memset(path, 'p', sizeof path);
    path[length] = '\0';
    const status s = fault_set(&f, STATUS_FAULT, "culprit %s remedy", path);
    const int whole = (int)strlen("culprit  remedy") + length < FAULT_TEXT;
    gsl_test_int((int)s, STATUS_FAULT, "status");
    gsl_test(memchr(f.text, '\0', sizeof f.text) == NULL, "%d characters: it ends", length);
    gsl_test(strncmp(f.text, "culprit p", 9) != 0 ||
                 strcmp(f.text + strlen(f.text) - 8, "p remedy") != 0,
             "%d characters: both ends are there", length);
    gsl_test((strstr(f.text, " ... ") == NULL) != whole || whole == middle,
             "%d characters: the middle", length);
    gsl_test(whole && strlen(f.text) != strlen("culprit  remedy") + (size_t)length,
             "%d characters: all of them", length);
}

static void status_tests(void)
{
    const int most = FAULT_TEXT - 1 - (int)strlen("culprit  remedy");
    for (int length = 1; length < 3999; length += length < 2 * FAULT_TEXT ? 1 : 97)
        line_of(length, length > most);
    gsl_test(fault_set(NULL, STATUS_SINGULAR, "nobody listens") != STATUS_SINGULAR,
             "nobody listens");
}

int main(void)
{
    field_tests();
    polynomials();
    field_inner_tests();
    sheet_coefficients_tests();
    status_tests();
    return gsl_test_summary();
}
