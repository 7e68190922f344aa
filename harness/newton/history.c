#include "harness/newton/history.h"

#include <math.h>
#include <stdlib.h>

#include "harness/numerics/numerics.h"

status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f)
{
    const int first = step->iterations == 0;
    const double start = first ? energy : step->energy;
    iteration_record entry = *one;
    entry.residual = energy == 0 ? 0 : sqrt(energy / start);
    TRY(memory_append(&r->iteration, &r->iterations, &entry, sizeof entry, "step records", f));
    if (first) {
        step->first = r->iterations - 1;
        step->energy = energy;
    }
    step->iterations++;
    step->residual = entry.residual;
    step->correction = one->correction;
    step->incompatibility = one->incompatibility;
    return STATUS_OK;
}

void history_drop_step(solve_result *r, const step_record *step)
{
    if (step->iterations > 0)
        r->iterations = step->first;
}

history_mark history_here(const solve_result *r)
{
    return (history_mark){r->steps, r->iterations, r->ends};
}

void history_go_back(solve_result *r, const history_mark *mark)
{
    while (r->ends > mark->ends)
        outcome_end_free(&r->end[--r->ends]);
    r->steps = mark->steps;
    r->iterations = mark->iterations;
}

status history_add_step(solve_result *r, const step_record *record, fault *f)
{
    return memory_append(&r->step, &r->steps, record, sizeof *record, "step records", f);
}

/* With a mass an odd number of eigenvalues beyond zero is a divergence, and what else there is
 * frequencies tell. */
static step_stability without_symmetry(const scene *s, const step_record *one)
{
    const int massive = scene_has_mass(s);
    if (one->by_eigenvalues && one->passed > 0 && (!massive || one->passed % 2 != 0))
        return STEP_UNSTABLE;
    if (massive || !one->by_eigenvalues || one->passed < 0)
        return one->judged;
    return STEP_NO_DIVERGENCE;
}

void history_judge_steps(solve_result *r, const scene *s, int analysis, int first)
{
    const scene_analysis *a = &s->analysis[analysis];
    for (int i = first; i < r->steps; i++) {
        step_record *one = &r->step[i];
        one->analysis = analysis;
        one->stability = without_symmetry(s, one);
        if (a->kind == SCENE_MOTION || one->negative_pivots < 0)
            continue;
        if (one->negative_pivots == 0)
            one->stability = STEP_STABLE;
        else if (a->kind != SCENE_ROTATION && !scene_rotates(a))
            one->stability = STEP_UNSTABLE; /* in turning axes gyroscopic forces may hold it, ... */
        else if (one->negative_pivots % 2 != 0)
            one->stability = STEP_GROWS; /* ... but not an odd number: det(s^2 M + s G + K) is
                                            negative at s = 0 and positive far away */
    }
}

void history_judge_station(solve_result *r, int analysis, double path, step_stability found)
{
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis && r->step[i].path == path &&
            r->step[i].stability == STEP_OPEN)
            r->step[i].stability = found;
}

step_stability history_stability_at(const solve_result *r, int analysis, double path)
{
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis && r->step[i].path == path)
            return r->step[i].stability;
    return STEP_OPEN;
}

status history_add_event(solve_result *r, const path_event *event, fault *f)
{
    return memory_append(&r->event, &r->events, event, sizeof *event, "events", f);
}

status history_add_motion(solve_result *r, int analysis, double path, const outcome_motion *o,
                          fault *f)
{
    motion_record *more = realloc(r->motion, (size_t)(r->motions + o->steps + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the steps of a motion");
    r->motion = more;
    for (int i = 0; i < o->steps; i++)
        r->motion[r->motions++] = (motion_record){analysis, path, o->step[i]};
    return STATUS_OK;
}
