#include "harness/study/dense_reference.h"

#include <math.h>

/* [s] of a whole run; longer ones are counted from one iteration */
static const double longest = 1;
enum { MOST_UNKNOWNS = 3000 }; /* 72 MB; a few seconds per iteration */

/* Coordinates, strains and stresses. */
static int unknowns_of(const cell_result *cell)
{
    return cell->size.free + 2 * cell->size.strains * cell->size.elements;
}

static void sample(const cell_request *dense, dense_reference *out)
{
    cell_request one = *dense;
    cell_result cell;
    fault f = {""};
    double seconds = 0;
    one.solve.sample = one.solve.phases = 1;
    if (cell_run(&one, &cell, &f) == STATUS_OK)
        for (int k = 0; k < PHASE_REST; k++)
            seconds += cell.solve.phase[k];
    if (seconds > 0) { /* a path that is continued has no dense form: nothing was sampled */
        out->iteration = out->unknowns > 0 ? fmin(out->iteration, seconds) : seconds;
        out->unknowns = unknowns_of(&cell);
    }
    cell_result_free(&cell);
}

void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out)
{
    const long iterations = cell->counters.iterations;
    cell_request dense = *own;
    dense.solve.newton = NEWTON_DENSE;
    if (iterations == 0 || unknowns_of(cell) > MOST_UNKNOWNS)
        return; /* a linear problem, or one too large */
    if (out->unknowns == 0 || out->iteration < longest)
        sample(&dense, out);
    if (out->unknowns > 0 && out->iteration * (double)iterations <= longest)
        rounds_run(&dense, floor, &out->whole);
}

double dense_reference_seconds(const dense_reference *b, long iterations)
{
    if (b->whole.rounds > 0)
        return rounds_least(&b->whole);
    return b->unknowns > 0 ? b->iteration * (double)iterations : INFINITY;
}
