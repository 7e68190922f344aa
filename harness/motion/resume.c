#include "harness/motion/resume.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/kinematics.h"

static size_t coordinates_of(const model *m)
{
    const model_size size = model_sizes(m);
    return (size_t)size.free + (size_t)size.driven;
}

static int is_followed(const scene *s, int analysis)
{
    for (int i = analysis + 1; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION && s->analysis[i].follows == analysis)
            return 1;
    return 0;
}

status resume_keep(const analysis_context *c, int analysis, const instant *now,
                   const resume_control *control, outcome_motion *o, fault *f)
{
    const size_t n = coordinates_of(c->model), bytes = n * sizeof *now->v;
    if (!is_followed(c->scene, analysis))
        return STATUS_OK;
    o->end.v = malloc(3 * bytes + 1);
    if (o->end.v == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the end of a motion");
    memcpy(o->end.v, now->v, bytes);
    memcpy(o->end.v + n, now->a, bytes);
    memcpy(o->end.v + 2 * n, now->algorithm, bytes);
    o->end.time = now->time;
    o->end.step = control->step;
    o->end.largest = control->largest;
    o->end.quiet = control->quiet;
    o->end.work = now->work;
    o->end.dissipated = now->dissipated;
    return STATUS_OK;
}

status resume_take(const analysis_context *c, int before, instant *now, resume_control *control,
                   fault *f)
{
    const analysis_outcome *all = &c->outcomes[before];
    const outcome_motion *o = outcome_motion_of(all);
    const size_t n = coordinates_of(c->model), bytes = n * sizeof *now->v;
    if (all->status != STATUS_OK || o->end.v == NULL)
        return fault_set(f, STATUS_NOT_CONVERGED, "the motion that this one goes on from: %s",
                         all->reason);
    kinematics_state_copy(c->model, o->path.state[o->path.reached - 1], now->state);
    memcpy(now->v, o->end.v, bytes);
    memcpy(now->a, o->end.v + n, bytes);
    memcpy(now->algorithm, o->end.v + 2 * n, bytes);
    now->time = o->end.time;
    now->work = o->end.work;
    now->dissipated = o->end.dissipated;
    *control = (resume_control){o->end.step, o->end.largest, o->end.quiet};
    return STATUS_OK;
}
