#include "harness/run/baseline.h"

#include <math.h>

static const double longest = 1; /* [s] of a whole run; longer ones are counted from one iteration */

static void sample(const cell_request *dense, baseline *out)
{
    cell_request one = *dense;
    cell_result cell;
    fault f = {""};
    double seconds = 0;
    one.solve.sample = one.solve.phases = 1;
    if (cell_run(&one, &cell, &f) == STATUS_OK) {
        for (int k = 0; k < PHASES; k++)
            seconds += cell.solve.phase[k];
        out->iteration = out->unknowns > 0 ? fmin(out->iteration, seconds) : seconds;
        out->unknowns = cell.size.free + 2 * cell.size.strains * cell.size.elements;
    }
    cell_result_free(&cell);
}

void baseline_round(const cell_request *own, long iterations, double floor, baseline *out)
{
    cell_request dense = *own;
    dense.solve.newton = SOLVE_DENSE;
    if (iterations == 0)
        return; /* a linear problem */
    if (out->unknowns == 0 || out->iteration < longest)
        sample(&dense, out);
    if (out->unknowns > 0 && out->iteration * (double)iterations <= longest)
        clock_round(&dense, floor, &out->whole);
}

double baseline_seconds(const baseline *b, long iterations)
{
    if (b->whole.rounds > 0)
        return clock_least(&b->whole);
    return b->unknowns > 0 ? b->iteration * (double)iterations : INFINITY;
}
