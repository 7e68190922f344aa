#include "harness/terminal/table_path.h"

#include <math.h>

#include "cases/scene/names.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table_stability.h"

enum { MOST_STEPS = 40 };

/* Of the iterations of a step, in lines below each other where they are many. */
static void corrections(FILE *to, int column, const solve_result *r, const step_record *k)
{
    paragraph words;
    FILE *list = paragraph_begin(&words, to);
    for (int j = 0; j < k->iterations; j++)
        fprintf(list, " %.0e", r->iteration[k->first + j].correction);
    paragraph_end(&words, column, column);
}

/* Steps of motions are told in short. */
static int steps_told(const solve_result *r)
{
    int steps = r->steps;
    for (int i = 0; i < r->motions; i++)
        steps -= r->motion[i].at.step > 0;
    return steps;
}

void table_path_steps(FILE *to, const solve_result *r)
{
    const int steps = steps_told(r);
    if (steps <= 0)
        return;
    fprintf(to, "%4s %12s %12s %8s %6s %10s  %s\n", "step", "path", "increment", "rejected",
            "stable", "iterations", "their corrections");
    for (int i = 0; i < steps && i < MOST_STEPS; i++) {
        const step_record *k = &r->step[i];
        const int column =
            fprintf(to, "%4d %12.6g %12.4g %8d %6s %10d  ", i + 1, k->path, k->increment,
                    k->rejected, table_stability_word(k->stability), k->iterations);
        corrections(to, column, r, k);
    }
    if (steps > MOST_STEPS)
        fprintf(to, "%4s %d more steps: --format json has them all\n", "", steps - MOST_STEPS);
}

static void matrix(FILE *to, const double value[36], const char *const row[6],
                   const char *const column[6])
{
    fprintf(to, "%7s", "");
    for (int j = 0; j < 6; j++)
        fprintf(to, " %14s", column[j]);
    fputc('\n', to);
    for (int i = 0; i < 6; i++) {
        fprintf(to, "%7s", row[i]);
        for (int j = 0; j < 6; j++)
            if (isfinite(value[6 * i + j]))
                fprintf(to, " %14.7g", value[6 * i + j] + 0.0); /* no "-0" */
            else
                fprintf(to, " %14s", "-");
        fputc('\n', to);
    }
}

void table_path_matrices(FILE *to, const scene *s, const solve_result *r)
{
    static const char *const motion[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int i = 0; i < r->matrix_sets; i++) {
        const nodal_matrices *m = &r->matrices[i];
        if (m->stations == 0)
            continue;
        const size_t last = 36 * (size_t)(m->stations - 1);
        fprintf(to, "compliance of %s at path %g, %s moments [SI]\n",
                scene_called(s, SCENE_NODES, m->node).text, m->path[m->stations - 1],
                scene_moments_name(m->moments));
        matrix(to, m->compliance + last, motion, load);
        if (!isfinite(m->stiffness[last]))
            continue;
        fprintf(to, "stiffness\n");
        matrix(to, m->stiffness + last, load, motion);
    }
}

static void row_of_event(FILE *to, const path_event *e)
{
    fprintf(to, "%s at %.9g m, load factor %.9g", result_event_name(e->kind), e->control,
            e->factor);
    if (e->kind == EVENT_BRANCH_JUMP)
        fprintf(to, ": a step led to another branch with %.9g\n", e->other_factor);
    else if (e->negative_before >= 0)
        fprintf(to, ": negative pivots %d -> %d\n", e->negative_before, e->negative_after);
    else
        fputc('\n', to);
}

void table_path_events(FILE *to, const solve_result *r)
{
    for (int i = 0; i < r->events; i++)
        row_of_event(to, &r->event[i]);
}
