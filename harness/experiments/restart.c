#include "harness/experiments/restart.h"
#include "cases/scene/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/restart_text.h"

status restart_possible(const scene *s, fault *f)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return STATUS_OK;
    return fault_set(
        f, STATUS_REFUSED,
        "the scene has no motion in time that --ends could store or --restart continue "
        "from; remove them, or add an analysis 'motion'");
}

void restart_free(restart *r)
{
    for (int i = 0; i < r->ends; i++)
        outcome_end_free(&r->end[i]);
    free(r->end);
    free(r->scene);
    memset(r, 0, sizeof *r);
}

static status check_chosen(const restart *r, const solution_request *of, fault *f)
{
    if (strcmp(r->formulation, of->formulation.key) != 0 || r->elements != of->elements)
        return fault_set(
            f, STATUS_REFUSED,
            "--restart is of -f %s -n %d and not of -f %s -n %d: a motion continues with "
            "the formulation and the elements that it began with",
            r->formulation, r->elements, of->formulation.key, of->elements);
    if (r->keep_all != of->keep_all)
        return fault_set(f, STATUS_REFUSED, "--restart is of a run %s --keep-all: %s",
                         r->keep_all ? "with" : "without", r->keep_all ? "give it" : "remove it");
    return STATUS_OK;
}

/* Instants that are passed are no stations any more. */
static status drop_stations(const outcome_end *e, scene *s, fault *f)
{
    const double same_instant = 1e-9;
    scene_motion *m = &s->analysis[e->analysis].of.motion;
    const double last = m->path.value[m->path.stations - 1];
    int kept = 0;
    for (int i = 0; i < m->path.stations; i++)
        if (m->path.value[i] > e->time + same_instant * m->step)
            m->path.value[kept++] = m->path.value[i];
    if (kept == 0)
        return fault_set(
            f, STATUS_REFUSED,
            "the motion continues from %.10g s, and its last station is at %.10g s: give "
            "it a later one",
            e->time, last);
    m->path.stations = kept;
    return STATUS_OK;
}

status restart_begin(const restart *r, solution_request *of, scene *s, fault *f)
{
    TRY(check_chosen(r, of, f));
    TRY(restart_text_check(r->scene, s, f));
    for (int i = 0; i < r->ends; i++) {
        const int k = r->end[i].analysis;
        if (k < 0 || k >= s->analyses || s->analysis[k].kind != SCENE_MOTION)
            return fault_set(f, STATUS_REFUSED,
                             "--restart: %s is no motion of the scene; keep its end anew",
                             scene_called(s, SCENE_ANALYSES, k).text);
        TRY(drop_stations(&r->end[i], s, f));
    }
    of->restart = r->end;
    of->restarts = r->ends;
    return STATUS_OK;
}
