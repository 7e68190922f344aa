/* Work along a path: what a step can take from the steps before it is not done again, and the
 * values are those of a path where it is. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/catalogue/case_find.h"
#include "harness/test/cells.h"

enum { STATIONS = 15 };

static void solve(const char *name, const char *type, int elements, solve_newton newton,
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
    solve("sheet_cantilever", "sheet_third", 2, SOLVE_MIXED, &taken);
    solve("sheet_cantilever", "sheet_third", 2, SOLVE_DENSE, &own);
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
    solve("spherical_joint", "sheet_third", 1, SOLVE_MIXED, &r);
    for (int i = BEGINNING; i < r.solve.steps; i++)
        most = r.solve.step[i].iterations > most ? r.solve.step[i].iterations : most;
    gsl_test_int(most, 2, "iterations of a step of a smooth path");
    cell_result_free(&r);
}

/* The first iteration of each step has the tangent of the last one of the step before. */
static void continuations(void)
{
    cell_result r;
    solve("c_cantilever", "geometrically_exact", 4, SOLVE_MIXED, &r);
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
    continuations();
    return gsl_test_summary();
}
