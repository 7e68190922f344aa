#include "harness/time/resume.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/numerics/numerics.h"
#include "harness/time/damping.h"

static int is_followed(const scene *s, int analysis)
{
    for (int i = analysis + 1; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION && s->analysis[i].follows == analysis)
            return 1;
    return 0;
}

/* Sizes of what is kept of this model. */
static void measure(const model *m, const instant *now, outcome_end *out)
{
    out->between = (size_t)turns_between_count(m);
    out->states = now->state->size - 3 * out->between;
    out->coordinates = (size_t)model_all_coordinates(m);
    out->strains = now->strain != NULL ? (size_t)model_elements(m) * (size_t)model_strains(m) : 0;
    out->released = now->ends_known ? instant_ends(m) : 0;
}

/* Where the parts of an instant lie among the numbers of an end, and how many each has. */
enum { PARTS = 7 };
typedef struct part {
    double *of;
    size_t count;
} part;
static void parts_of(const instant *now, const extent *so_far, const outcome_end *e,
                     part out[PARTS])
{
    const part list[PARTS] = {{now->state->block, e->states},   {so_far->begin->block, e->states},
                              {now->v, e->coordinates},         {now->a, e->coordinates},
                              {now->algorithm, e->coordinates}, {now->strain, 2 * e->strains},
                              {now->ends, e->released}};
    memcpy(out, list, sizeof list);
}

static status copy(const model *m, int analysis, const instant *now, const resume_control *control,
                   outcome_end *out, fault *f)
{
    part of[PARTS];
    *out = (outcome_end){.analysis = analysis,
                         .time = now->time,
                         .path = now->state->path,
                         .step = control->step,
                         .work = now->work,
                         .dissipated = now->dissipated,
                         .largest = control->account.largest,
                         .turned = control->account.turned,
                         .scale = control->extent.scale,
                         .extent = control->extent.largest,
                         .rate = control->extent.rate,
                         .density = control->extent.density,
                         .origin = control->origin,
                         .stress = now->stress,
                         .contraction = now->contraction,
                         .quiet = control->quiet};
    measure(m, now, out);
    out->value = malloc((outcome_end_values(out) + 1) * sizeof *out->value);
    if (out->value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the end of a motion");
    double *to = out->value;
    parts_of(now, &control->extent, out, of);
    for (int i = 0; i < PARTS; i++)
        if (of[i].count > 0) {
            memcpy(to, of[i].of, of[i].count * sizeof *to);
            to += of[i].count;
        }
    turns_put_between(m, now->state, to);
    return STATUS_OK;
}

status resume_keep(const analysis_context *c, int analysis, const instant *now,
                   const resume_control *control, outcome_motion *o, fault *f)
{
    outcome_end end;
    if (is_followed(c->scene, analysis))
        return copy(c->model, analysis, now, control, &o->end, f);
    if (!c->options->keep_ends)
        return STATUS_OK;
    TRY(copy(c->model, analysis, now, control, &end, f));
    const status kept =
        memory_append(&c->result->end, &c->result->ends, &end, sizeof end, "ends of motions", f);
    if (kept != STATUS_OK)
        outcome_end_free(&end);
    return kept;
}

const outcome_end *resume_given(const analysis_context *c, int analysis)
{
    for (int i = 0; i < c->options->restarts; i++)
        if (c->options->restart[i].analysis == analysis)
            return &c->options->restart[i];
    return NULL;
}

status resume_before(const analysis_context *c, int before, const outcome_end **out, fault *f)
{
    const analysis_outcome *all = &c->outcomes[before];
    *out = &outcome_motion_of(all)->end;
    if (all->status != STATUS_OK || (*out)->value == NULL)
        return fault_set(f, STATUS_NOT_CONVERGED, "the motion that this one continues: %s",
                         all->reason);
    return STATUS_OK;
}

status resume_take(const analysis_context *c, const outcome_end *e, instant *now,
                   resume_control *control, fault *f)
{
    outcome_end here;
    part of[PARTS];
    measure(c->model, now, &here);
    if (here.states != e->states || here.coordinates != e->coordinates ||
        here.strains != e->strains || (e->released > 0 && e->released != instant_ends(c->model)))
        return fault_set(f, STATUS_REFUSED,
                         "the motion that this one continues has %zu numbers, this mesh %zu: "
                         "take its formulation and elements",
                         e->states, here.states);
    const double *from = e->value;
    parts_of(now, &control->extent, e, of);
    for (int i = 0; i < PARTS; i++)
        if (of[i].count > 0) {
            memcpy(of[i].of, from, of[i].count * sizeof *from);
            from += of[i].count;
        }
    turns_take_between(c->model, (int)e->between, from, now->state);
    now->ends_known = e->released > 0;
    now->state->path = e->path;
    now->time = e->time;
    now->work = e->work;
    now->dissipated = e->dissipated;
    now->stress = e->stress;
    now->contraction = e->contraction;
    *control =
        (resume_control){e->step,
                         {e->largest, e->turned, e->work},
                         e->origin,
                         e->quiet,
                         {control->extent.begin, 0, e->scale, e->extent, e->rate, e->density, 0}};
    return STATUS_OK;
}
