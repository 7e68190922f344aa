/* Parts of a solution and the whole are read from one clock: what passes without work is in
 * neither, and no part is missing. */
#include <gsl/gsl_test.h>
#include <time.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

static const element_type *sleepy_type;

static void sleep_and_strain(const element_data *data, const node_state x[], strain_output *out)
{
    const struct timespec pause = {.tv_nsec = 1000000};
    nanosleep(&pause, NULL);
    sleepy_type->strain(data, x, out);
}

/* Sleeps a millisecond in each evaluation, which takes microseconds. */
static element_type make_sleepy(const element_type *type)
{
    element_type sleepy = *type;
    sleepy_type = type;
    sleepy.strain = sleep_and_strain;
    sleepy.strain_many = NULL;
    return sleepy;
}

static void parts_are_the_whole(const cell_request *request, const char *what)
{
    cell_result cell;
    fault f = {""};
    double sum = 0;
    gsl_test(cell_run(request, &cell, &f) != STATUS_OK, "%s: solved %s", what, f.text);
    for (int k = 0; k < PHASES; k++) {
        sum += cell.solve.phase[k];
        gsl_test(!(cell.solve.phase[k] >= 0), "%s: %s is a part of the whole (%g of %g s)", what,
                 phase_name((newton_phase)k), cell.solve.phase[k], cell.solve.seconds_solve);
    }
    gsl_test(!(cell.solve.phase[PHASE_ELEMENTS] > 0), "%s: elements take time", what);
    /* readings of the clock are no more than four fifths of it */
    gsl_test(!(sum <= cell.solve.seconds_solve && sum > 0.2 * cell.solve.seconds_solve),
             "%s: the parts, %g s, are the whole, %g s, but for the readings", what, sum,
             cell.solve.seconds_solve);
    cell_result_free(&cell);
}

static void parts_of(const char *name, const char *key, int elements)
{
    cell_request request = cells_of(case_find(name, NULL), key, elements);
    const element_type sleepy = make_sleepy(request.formulation);
    request.solve.phases = 1;
    parts_are_the_whole(&request, key);
    request.formulation = &sleepy;
    parts_are_the_whole(&request, "asleep at times");
}

/* Unasked, no clock is read: nothing is said of parts. */
static void nothing_unasked(void)
{
    const cell_request request = cells_of(case_find("elastica", NULL), "collocation", 2);
    cell_result cell;
    fault f = {""};
    gsl_test(cell_run(&request, &cell, &f) != STATUS_OK, "solved %s", f.text);
    for (int k = 0; k < PHASES; k++)
        gsl_test_abs(cell.solve.phase[k], 0, 0, "%s unasked", phase_name((newton_phase)k));
    cell_result_free(&cell);
}

int main(void)
{
    parts_of("sheet_cantilever", "sheet_third", 1);
    parts_of("elastica", "collocation", 2);
    parts_of("elastica", "sheet_third:newton=dense", 2);
    parts_of("snap_through", "geometrically_exact", 4);
    nothing_unasked();
    return gsl_test_summary();
}
