#include "harness/study/sound.h"

#include <math.h>
#include <stdio.h>

/* Largest last correction of a step that counts as converged: the next one would be of the size
 * of its square; a larger one, up to the second, is the last where the one after it is predicted
 * and negligible. With more elements than these it is larger in proportion: rounding of their
 * places keeps it there. */
static const double promised_correction = 1e-8, largest_correction = 1e-6,
                    negligible_correction = 1e-14, many_elements = 1e4;

static int iterations_of_steps(const solve_result *r)
{
    int sum = 0;
    for (int i = 0; i < r->steps; i++)
        sum += r->step[i].iterations;
    return sum;
}

/* Tries of longer steps that failed before the ones that were kept. */
static long rejected_before_steps(const solve_result *r)
{
    long sum = 0;
    for (int i = 0; i < r->steps; i++)
        sum += r->step[i].rejected;
    return sum;
}

/* The first step that ended too soon, or -1. */
static int unfinished_step(const solve_result *r, double promised)
{
    for (int i = 0; i < r->steps; i++)
        if (!(r->step[i].correction <= promised) &&
            !(r->step[i].correction <= largest_correction &&
              r->step[i].remaining <= negligible_correction))
            return i;
    return -1;
}

/* Nothing but Newton's iterations, none of them in vain: then each is one evaluation of every
 * element and one factorisation. */
static int is_plain(const cell_result *cell, const scene *s, newton_form newton)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind != SCENE_STATIC)
            return 0;
    return newton == NEWTON_MIXED && cell->counters.rejected_steps == 0;
}

/* A continuation begins each step with the tangent that the one before it ended with. */
static long most_reused(const cell_result *cell, const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind == SCENE_CONTINUATION)
            return cell->counters.steps;
    return 0;
}

/* The steps of a motion go on with the factors of their first iterations. */
static long most_stale(const cell_result *cell, const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind == SCENE_MOTION)
            return cell->counters.iterations - cell->counters.steps;
    return 0;
}

/* The first count that is less than the iterations need, or in a plain cell another one; NULL:
 * none. */
static const char *wrong_count(const cell_result *cell, long reused, long stale, int plain)
{
    const counters *c = &cell->counters;
    const long linearised = c->iterations - reused, evaluations = linearised * cell->size.elements;
    const struct {
        const char *name;
        long counted, needed;
    } row[] = {{"strain evaluations", c->strain_evaluations, evaluations},
               {"stress evaluations", c->stress_evaluations, evaluations},
               {"factorisations", c->factorisations, linearised - stale}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        if (row[i].counted < row[i].needed || (plain && row[i].counted != row[i].needed))
            return row[i].name;
    return c->solutions < c->iterations ? "solutions" : NULL;
}

int sound_cell(const cell_result *cell, const scene *s, newton_form newton, char why[FAULT_TEXT])
{
    const solve_result *r = &cell->solve;
    const counters *c = &cell->counters;
    if (r->status != STATUS_OK)
        return 1;
    const double promised = promised_correction * fmax(1, cell->size.elements / many_elements);
    const int iterations = iterations_of_steps(r), early = unfinished_step(r, promised);
    const long rejected = rejected_before_steps(r);
    const char *count =
        wrong_count(cell, most_reused(cell, s), most_stale(cell, s), is_plain(cell, s, newton));
    if (c->steps != r->steps)
        snprintf(why, FAULT_TEXT, "%ld steps were counted and %d kept", c->steps, r->steps);
    else if (c->rejected_steps != rejected)
        snprintf(why, FAULT_TEXT, "%ld rejected steps were counted, %ld by the steps after them",
                 c->rejected_steps, rejected);
    else if (iterations > r->iterations || r->iterations > c->iterations)
        snprintf(why, FAULT_TEXT, "%d iterations of steps, %d kept, %ld counted", iterations,
                 r->iterations, c->iterations);
    else if (early >= 0)
        snprintf(why, FAULT_TEXT, "step %d ended with a correction of %.1e, before one of %.1e",
                 early, r->step[early].correction, r->step[early].remaining);
    else if (count != NULL)
        snprintf(why, FAULT_TEXT, "its %s do not fit %ld iterations with %d elements", count,
                 c->iterations, cell->size.elements);
    else
        return 1;
    return 0;
}
