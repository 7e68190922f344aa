/* Loads on the field between the nodes (elements/field): forces and derivatives in any state, what
 * a rigid motion and a potential make of them, and fixed-end forces of the uniform beam. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/test/nodes.h"
#include "elements/test/random.h"
#include "elements/test/sections.h"

enum { N = ELEMENT_MAX_COORDINATES, LOADS = 3, MOMENT = 1, FOLLOWER = 2, ARM = 4, KINDS = 8 };
static const double l0 = 0.8;

/* Without an axis of symmetry. */
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

/* Some loads of a kind at some places. */
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

/* K along one direction against fourth-order differences; of moments at the nodes in the
 * exponential chart: F_i has 1/2 M . (e_j x e_i) beside dF_i/dx_j. */
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

/* In a state that is turned as a whole, the sum of forces on the nodes is that of the loads, and
 * the sum of moments too. */
static void resultants(const displacement_field *f, int kind, const char *name)
{
    double d[N], none[N] = {0}, F[N], force[3] = {0}, moment[3] = {0}, expected[2][3] = {{0}};
    node_state x[ELEMENT_MAX_NODES];
    field_rows rows[LOADS];
    field_load load[LOADS];
    double R[9];
    for (int k = 0; k < f->nodes; k++) { /* a rigid motion */
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

/* Work of dead forces round a closed path of states: none. */
static void closed_path(const displacement_field *f, int kind, const char *name)
{
    enum { STEPS = 400 };
    double d[N], more[N], none[N] = {0}, work = 0, size = 0;
    nodes_increments(f->nodes, l0, 0.9, 5, d);
    nodes_increments(f->nodes, l0, 0.9, 6, more);
    for (int step = 0; step < STEPS; step++) {
        const double pi = acos(-1), t = 2 * pi * (step + 0.5) / STEPS, h = 2 * pi / STEPS;
        double at[N], F[N];
        /* translations and warping round a circle; turns, whose increments do not add up, to and
         * fro about one axis per node */
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

/* Fixed-end forces of a uniform load, and of one that grows linearly, of a straight element with
 * shear: q l/2, q l^2/12; q l (3/20 + Phi/6)/(1 + Phi) ... (Przemieniecki, Theory of Matrix
 * Structural Analysis, 1968, sec. 10). */
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

int main(void)
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
    return gsl_test_summary();
}
