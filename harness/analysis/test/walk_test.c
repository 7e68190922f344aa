/* Work along a path: what a step can take from the steps before it is not done again, and the
 * values are those of a path where it is. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

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

/* The uncondensed Newton has no tangent that a compliance could take. */
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

/* The axis of the joint's tilt goes once around: each of its components has two extrema. */
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

/* Steps to begin with are those to the first station: what went well goes on. */
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

/* A large deflection in one step is that of forty. */
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

/* The first iteration of each step has the tangent of the last one of the step before. */
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

int main(void)
{
    compliances();
    turning_back();
    shorter_first_steps();
    large_deflection();
    continuations();
    return gsl_test_summary();
}
