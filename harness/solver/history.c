#include "harness/solver/history.h"

#include <math.h>
#include <stdlib.h>

/* Room for one more: lists double when their count is a power of two. */
static void *grown(void *list, int count, size_t size)
{
    if ((count & (count - 1)) != 0)
        return list;
    return realloc(list, (count == 0 ? 1 : 2 * (size_t)count) * size);
}

status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f)
{
    iteration_record *more = grown(r->iteration, r->iterations, sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for step records");
    if (step->iterations == 0) {
        step->first = r->iterations;
        step->energy = energy;
    }
    r->iteration = more;
    more[r->iterations] = *one;
    more[r->iterations++].residual = energy == 0 ? 0 : sqrt(energy / step->energy);
    step->iterations++;
    step->residual = more[r->iterations - 1].residual;
    step->correction = one->correction;
    step->incompatibility = one->incompatibility;
    return STATUS_OK;
}

void history_drop_step(solve_result *r, const step_record *step)
{
    if (step->iterations > 0)
        r->iterations = step->first;
}

status history_add_step(solve_result *r, const step_record *record, fault *f)
{
    step_record *more = realloc(r->step, ((size_t)r->steps + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for step records");
    r->step = more;
    r->step[r->steps++] = *record;
    return STATUS_OK;
}

status history_add_event(solve_result *r, const path_event *event, fault *f)
{
    path_event *more = realloc(r->event, ((size_t)r->events + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for events");
    r->event = more;
    r->event[r->events++] = *event;
    return STATUS_OK;
}
