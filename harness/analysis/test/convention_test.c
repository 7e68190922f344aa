/* Conventions of moments in the stiffness of a loaded node, and the records of Newton's method. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

typedef struct convention_matrices {
    double C[36], K[36];
} convention_matrices;

static void solve(const char *case_name, const char *const assignment[], const char *chosen,
                  cell_result *out)
{
    cell_request request = cells_of(case_find(case_name, NULL), chosen, 4);
    fault f = {""};
    cells_set(&request, assignment);
    gsl_test(cell_run(&request, out, &f) != STATUS_OK, "%s solved: %s", case_name, f.text);
}

static convention_matrices of(const char *case_name, const char *convention, const char *more,
                              const char *and_more)
{
    const char *const assignment[] = {convention, more, and_more, NULL};
    cell_result r;
    convention_matrices out = {{NAN}, {NAN}};
    solve(case_name, assignment, "collocation", &r);
    gsl_test(r.solve.matrix_sets != 1 ||
                 strcmp(strchr(convention, '=') + 1,
                        scene_moments_name(r.solve.matrices[0].moments)) != 0,
             "the result names %s", convention);
    const nodal_matrices *m = &r.solve.matrices[0];
    memcpy(out.C, m->compliance + 36 * (m->stations - 1), sizeof out.C);
    memcpy(out.K, m->stiffness + 36 * (m->stations - 1), sizeof out.K);
    cell_result_free(&r);
    return out;
}

static double asymmetry(const double A[36])
{
    double largest = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < i; j++)
            largest =
                fmax(largest, fabs(A[6 * i + j] - A[6 * j + i]) / sqrt(fabs(A[7 * i] * A[7 * j])));
    return largest;
}

static void inverse(void)
{
    const convention_matrices m = of("sheet_wagner", "moment_convention=spatial", NULL, NULL);
    double worst = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            double sum = i == j ? -1 : 0, size = 1;
            for (int k = 0; k < 6; k++) {
                sum += m.K[6 * i + k] * m.C[6 * k + j];
                size += fabs(m.K[6 * i + k] * m.C[6 * k + j]);
            }
            worst = fmax(worst, fabs(sum) / size);
        }
    gsl_test(worst > 1e-12, "stiffness times compliance is the unit matrix: %.1e", worst);
}

static void sheets(void)
{
    const convention_matrices near =
                                  of("sheet_cantilever", "moment_convention=spatial", NULL, NULL),
                              near_sym = of("sheet_cantilever", "moment_convention=symmetrised",
                                            NULL, NULL),
                              far = of("sheet_cantilever", "moment_convention=spatial",
                                       "tip_deflection=0.05", NULL),
                              far_sym = of("sheet_cantilever", "moment_convention=symmetrised",
                                           "tip_deflection=0.05", NULL);
    const int zz = 6 * 2 + 2;
    gsl_test_abs(near_sym.C[zz] / near.C[zz] - 1, 3.31e-5, 1e-7,
                 "C_zz at 0.15 L: symmetrised against spatial");
    gsl_test_abs(far_sym.C[zz] / far.C[zz] - 1, 2.741e-3, 2e-6,
                 "C_zz at 0.5 L: symmetrised against spatial");
}

static void reciprocity(void)
{
    const int ux_My = 4, thy_Fx = 6 * 4;
    static const char *const tip[] = {"tip_warping=0", "tip_warping=1"}, *const wagner[] = {
                                                                             "wagner=1",
                                                                             "wagner=0"};
    static const double apart[] = {0.14635, 0.31830}, changed[] = {0.07425, 0.15996};
    for (int i = 0; i < 2; i++) {
        const convention_matrices spatial = of("sheet_wagner", "moment_convention=spatial", tip[i],
                                               wagner[i]),
                                  half = of("sheet_wagner", "moment_convention=semitangential",
                                            tip[i], wagner[i]),
                                  sym = of("sheet_wagner", "moment_convention=symmetrised", tip[i],
                                           wagner[i]);
        gsl_test_abs(spatial.C[thy_Fx] / spatial.C[ux_My] - 1, apart[i], 1e-5,
                     "%s, spatial: thy by Fx and ux by My", tip[i]);
        gsl_test_abs(sym.C[ux_My] / spatial.C[ux_My] - 1, changed[i], 1e-5,
                     "%s: ux by My, symmetrised against spatial", tip[i]);
        gsl_test_rel(sym.C[thy_Fx], sym.C[ux_My], 1e-12, "%s, symmetrised: reciprocal", tip[i]);
        gsl_test(asymmetry(sym.K) > 1e-13, "%s, symmetrised: %.1e", tip[i], asymmetry(sym.K));
        gsl_test(asymmetry(half.C) > 1e-9, "%s: semitangential moments have a potential: %.1e",
                 tip[i], asymmetry(half.C));
        gsl_test(asymmetry(spatial.C) < 1e-2, "%s: spatial moments have none", tip[i]);
        gsl_test_rel(half.C[ux_My], sym.C[ux_My], 1e-9,
                     "%s: the symmetric part is the semitangential stiffness", tip[i]);
    }
}

static void quadratic(void)
{
    const char *const none[] = {NULL};
    static const char *const newton[] = {"collocation", "collocation:newton=displacement"};
    for (int k = 0; k < 2; k++) {
        cell_result r;
        solve("sheet_cantilever", none, newton[k], &r);
        long sum = 0;
        int ascending = 1;
        for (int i = 0; i < r.solve.steps; i++) {
            ascending &= r.solve.step[i].first == sum;
            sum += r.solve.step[i].iterations;
        }
        gsl_test(sum != r.counters.iterations || sum != r.solve.iterations || !ascending,
                 "%s: every iteration is recorded", newton[k]);
        const step_record *last = &r.solve.step[r.solve.steps - 1];
        const iteration_record *it = &r.solve.iteration[last->first];
        gsl_test_abs(it[0].residual, 1, 0, "%s: residuals relative to the first", newton[k]);
        gsl_test(it[last->iterations - 1].correction != last->correction ||
                     !(last->correction < 1e-8),
                 "%s: converged", newton[k]);
        for (int i = 2; i < last->iterations; i++) {
            const double order = log(it[i].correction / it[0].correction) /
                                 log(it[i - 1].correction / it[0].correction);
            gsl_test(!(it[i].correction < 1e-14) && !(order > 1.8),
                     "%s: order %.2f of iteration %d", newton[k], order, i + 1);
            gsl_test(!(it[i].residual < it[i - 1].residual), "%s: residual falls", newton[k]);
        }
        cell_result_free(&r);
    }
}

enum { TILTED = CASE_MAX_PARAMETERS - 1, TURNED = CASE_MAX_PARAMETERS - 2 };

static const double turn_of_axes[3] = {0.7, -1.1, 0.4};

static void turn_vector(const double q[4], double v[3])
{
    rotation_apply(q, v, v);
}

static status tilted_hinge(const double value[], scene *s, fault *f)
{
    double q[4];
    const status outcome = case_build(case_find("cross_flexure", NULL), value, s, f);
    const int arm = 0, edge = scene_add_attached(s, arm, 0.01, 0.02, 0);
    scene_add_load(s, SCENE_FORCE, edge, value[TILTED], -2 * value[TILTED], 20 * value[TILTED]);
    rotation_exp(turn_of_axes, q);
    if (value[TURNED] == 0)
        return outcome;
    for (int i = 0; i < s->nodes; i++) {
        turn_vector(q, s->node[i].position);
        for (int k = 0; k < 3; k++)
            turn_vector(q, s->node[i].axis[k]);
    }
    for (int i = 0; i < s->members; i++)
        turn_vector(q, s->member[i].y_axis);
    for (int i = 0; i < s->loads; i++)
        turn_vector(q, s->load[i].vector);
    return outcome;
}

static convention_matrices of_hinge(const char *rotation, const char *convention, double force,
                                    int in_other_axes)
{
    case_type type = *case_find("cross_flexure", NULL);
    cell_request request = cells_of(&type, "collocation", 2);
    fault f = {""};
    cell_result r;
    convention_matrices out = {{NAN}, {NAN}};
    cells_set(&request, (const char *const[]){rotation, convention, NULL});
    request.parameter[TILTED] = force;
    request.parameter[TURNED] = in_other_axes;
    type.build = tilted_hinge;
    gsl_test(cell_run(&request, &r, &f) != STATUS_OK, "%s, %s solved: %s", rotation, convention,
             f.text);
    const nodal_matrices *m = &r.solve.matrices[0];
    memcpy(out.C, m->compliance + 36 * (m->stations - 1), sizeof out.C);
    memcpy(out.K, m->stiffness + 36 * (m->stations - 1), sizeof out.K);
    cell_result_free(&r);
    return out;
}

static void in_other_axes(const double A[36], double B[36])
{
    double q[4], Q[9];
    rotation_exp(turn_of_axes, q);
    rotation_matrix(q, Q);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            B[6 * i + j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    B[6 * i + j] += Q[3 * (i % 3) + k] * A[6 * (i / 3 * 3 + k) + j / 3 * 3 + l] *
                                    Q[3 * (j % 3) + l];
        }
}

static double block_difference(const double A[36], const double B[36])
{
    double worst = 0;
    for (int block = 0; block < 4; block++) {
        double apart = 0, size = 0;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const int at = 6 * (block / 2 * 3 + i) + block % 2 * 3 + j;
                apart = fmax(apart, fabs(A[at] - B[at]));
                size = fmax(size, fabs(B[at]));
                if (isnan(A[at]) || isnan(B[at]))
                    return INFINITY;
            }
        worst = size > 0 ? fmax(worst, apart / size) : worst;
    }
    return worst;
}

static void partly_free_turns(void)
{
    static const char *const rotation[] = {"rotation=hinge", "rotation=first", "rotation=last",
                                           "rotation=between"},
                             *const convention[] = {"moment_convention=spatial",
                                                    "moment_convention=symmetrised"};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            for (int tilted = 0; tilted < 2; tilted++) {
                const convention_matrices here =
                                              of_hinge(rotation[i], convention[k], 0.5 * tilted, 0),
                                          there =
                                              of_hinge(rotation[i], convention[k], 0.5 * tilted, 1);
                convention_matrices expected;
                in_other_axes(here.C, expected.C);
                in_other_axes(here.K, expected.K);
                gsl_test(!(block_difference(there.C, expected.C) <= 1e-7),
                         "%s, %s%s: compliance in other axes: %.1e", rotation[i], convention[k],
                         tilted ? ", tilted" : "", block_difference(there.C, expected.C));
                gsl_test(!(block_difference(there.K, expected.K) <= 1e-7),
                         "%s, %s%s: stiffness in other axes: %.1e", rotation[i], convention[k],
                         tilted ? ", tilted" : "", block_difference(there.K, expected.K));
            }
}

static void at_every_angle(void)
{
    for (int i = -20; i <= 20; i++) {
        char angle[40];
        double value[3];
        static const char *const rotation[] = {"rotation=hinge", "rotation=first", "rotation=last"};
        snprintf(angle, sizeof angle, "angle=%.17g", i / 23.0);
        for (int k = 0; k < 3; k++) {
            const char *const assignment[] = {rotation[k], angle, NULL};
            cell_result r;
            solve("cross_flexure", assignment, "sheet_third", &r);
            value[k] = r.solve.matrices[0].compliance[36 * (r.solve.matrices[0].stations - 1)];
            cell_result_free(&r);
        }
        gsl_test_rel(value[1], value[0], 1e-8, "%s: tilts do not matter along x", angle);
        gsl_test_rel(value[2], value[0], 1e-8, "%s: nor which turn is prescribed", angle);
    }
}

static void convention_tests(void)
{
    partly_free_turns();
    at_every_angle();
    inverse();
    sheets();
    reciprocity();
    quadratic();
}

static void prediction_solve(const char *const assignment[], cell_result *out)
{
    cell_request request = cells_of(case_find("sheet_cantilever", NULL), "sheet_third", 1);
    fault f = {""};
    cells_set(&request, assignment);
    gsl_test(cell_run(&request, out, &f) != STATUS_OK, "solved: %s", f.text);
}

static void beside_the_element(const char *const assignment[], double in_plane, double apart)
{
    cell_result r;
    int predicted = 0;
    prediction_solve(assignment, &r);
    for (int i = 0; i < r.scene.quantities; i++) {
        const scene_quantity *q = &r.scene.quantity[i];
        const double value = r.solve.quantity[i].value;
        if (q->prediction.source == NULL)
            continue;
        predicted++;
        const int out_of_plane = strcmp(q->name, "C_zz") == 0 || strcmp(q->name, "C_uz_Fz") == 0;
        gsl_test_rel(q->prediction.value, value, out_of_plane ? apart : in_plane, "%s, %s",
                     assignment[0], q->name);
    }
    gsl_test_int(predicted, 7, "%s: everything that the closed form speaks of is predicted",
                 assignment[0]);
    cell_result_free(&r);
}

/* C_zz of the undeformed sheet is L^3/(3 E Iy) + L/(k G A). */
static void undeformed(void)
{
    const char *const straight[] = {"tip_deflection=1e-9", NULL};
    const double E = 200e9, w = 0.1, t = 0.00225, L = 0.1, nu = 0.3,
                 k = 10 * (1 + nu) / (12 + 11 * nu);
    cell_result r;
    prediction_solve(straight, &r);
    for (int i = 0; i < r.scene.quantities; i++)
        if (strcmp(r.scene.quantity[i].name, "C_zz") == 0)
            gsl_test_rel(r.scene.quantity[i].prediction.value,
                         4 * L * L * L / (E * t * w * w * w) + L * 2 * (1 + nu) / (k * E * w * t),
                         1e-11, "C_zz of the undeformed sheet");
    cell_result_free(&r);
}

static void prediction_tests(void)
{
    const char *const small[] = {"tip_deflection=0.001", NULL},
                      *const middle[] = {"tip_deflection=0.015", NULL},
                      *const free_tip[] = {"tip_warping=1", NULL},
                      *const uniform[] = {"warping=0", NULL}, *const rigid[] = {"shear=0", NULL};
    undeformed();
    beside_the_element(small, 1e-11, 2e-5);
    beside_the_element(middle, 1e-11, 1e-2);
    beside_the_element(free_tip, 1e-11, 1.5e-2);
    beside_the_element(uniform, 1e-11, 3e-4);
    beside_the_element(rigid, 1e-11, 1.5e-2);
}

enum { STATIONS = 15 };

static void walk_solve(const char *name, const char *type, int elements, newton_form newton,
                       cell_result *out)
{
    cell_request request = cells_of(case_find(name, NULL), type, elements);
    fault f = {""};
    request.solve.newton = newton;
    gsl_test(cell_run(&request, out, &f) != STATUS_OK, "%s, Newton %d: %s", name, newton, f.text);
}

static double worst_difference(const cell_result *a, const cell_result *b)
{
    double worst = 0;
    for (int i = 0; i < a->solve.quantities; i++) {
        const curve *one = &a->solve.quantity[i].curve, *other = &b->solve.quantity[i].curve;
        for (int k = 0; k < one->points; k++)
            worst = fmax(worst, fabs(one->value[k] / other->value[k] - 1));
    }
    return worst;
}

static void compliances(void)
{
    cell_result taken, own;
    walk_solve("sheet_cantilever", "sheet_third", 2, NEWTON_MIXED, &taken);
    walk_solve("sheet_cantilever", "sheet_third", 2, NEWTON_DENSE, &own);
    gsl_test_int((int)(own.counters.factorisations - own.counters.iterations), STATIONS,
                 "a tangent of its own at every station");
    gsl_test(taken.counters.factorisations - taken.counters.iterations > STATIONS / 2,
             "Newton's last one at most of them: %ld factorisations, %ld iterations",
             taken.counters.factorisations, taken.counters.iterations);
    const double worst = worst_difference(&taken, &own);
    gsl_test(!(worst < 1e-10), "the same compliances (%.1e)", worst);
    cell_result_free(&taken);
    cell_result_free(&own);
}

static void turning_back(void)
{
    enum { BEGINNING = 10 };
    cell_result r;
    int most = 0;
    walk_solve("spherical_joint", "sheet_third", 1, NEWTON_MIXED, &r);
    for (int i = BEGINNING; i < r.solve.steps; i++)
        most = r.solve.step[i].iterations > most ? r.solve.step[i].iterations : most;
    gsl_test_int(most, 2, "iterations of a step of a smooth path");
    cell_result_free(&r);
}

static void shorter_first_steps(void)
{
    cell_result whole, shorter;
    cell_request request = cells_of(case_find("sheet_cantilever", NULL), "sheet_third", 2);
    fault f = {""};
    walk_solve("sheet_cantilever", "sheet_third", 2, NEWTON_MIXED, &whole);
    request.solve.steps_between = 3;
    gsl_test(cell_run(&request, &shorter, &f) != STATUS_OK, "three steps: %s", f.text);
    gsl_test_int(whole.solve.steps, STATIONS, "a step to each station");
    gsl_test_int(shorter.solve.steps, STATIONS + 1, "a third and the rest to the first one");
    const double worst = worst_difference(&whole, &shorter);
    gsl_test(!(worst < 1e-10), "the same states (%.1e)", worst);
    cell_result_free(&whole);
    cell_result_free(&shorter);
}

static void large_deflection(void)
{
    cell_result r[2];
    for (int i = 0; i < 2; i++) {
        cell_request request = cells_of(case_find("elastica", NULL), "collocation", 4);
        fault f = {""};
        request.solve.steps_between = i == 0 ? 1 : 40;
        gsl_test(cell_run(&request, &r[i], &f) != STATUS_OK, "elastica: %s", f.text);
    }
    gsl_test_int(r[0].solve.steps, 1, "one step");
    gsl_test(2 * r[0].counters.iterations > r[1].counters.iterations,
             "less than half the work: %ld iterations, %ld", r[0].counters.iterations,
             r[1].counters.iterations);
    gsl_test_rel(cells_value(&r[0], "theta"), cells_value(&r[1], "theta"), 1e-11,
                 "of the same branch");
    cell_result_free(&r[0]);
    cell_result_free(&r[1]);
}

static void continuations(void)
{
    cell_result r;
    walk_solve("c_cantilever", "geometrically_exact", 4, NEWTON_MIXED, &r);
    const counters *n = &r.counters;
    gsl_test(n->rejected_steps == 0 && n->factorisations > n->iterations - n->steps + 2,
             "%ld factorisations, %ld iterations of %ld steps", n->factorisations, n->iterations,
             n->steps);
    cell_result_free(&r);
}

static void walk_tests(void)
{
    compliances();
    turning_back();
    shorter_first_steps();
    large_deflection();
    continuations();
}

int main(void)
{
    convention_tests();
    prediction_tests();
    walk_tests();
    return gsl_test_summary();
}
