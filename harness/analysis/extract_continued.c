#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>

#include "harness/time/time.h"

/* Relative difference below which two times count as equal. */
static const double same_instant = 1e-9;

/* Returns 1 if the value depends on states before the time from which the motion continues. */
static int reaches_back(const scene *s, const scene_quantity *q, const outcome_end *e, double begin)
{
    const double near = same_instant * e->time;
    if (scene_is_passed(q, SCENE_MOTION))
        return begin < e->time - near;
    if (q->transform != SCENE_HISTORY)
        return e->omits > 0 && e->omitted >= begin - near;
    return q->reduction == SCENE_AT &&
           q->at < e->time - same_instant * scene_motion_of(&s->analysis[q->analysis])->step;
}

int extract_continued(const analysis_context *c, const scene_quantity *q, quantity_result *r)
{
    const scene *s = c->scene;
    const outcome_end *e =
        s->analysis[q->analysis].kind == SCENE_MOTION ? resume_given(c, q->analysis) : NULL;
    char why[FAULT_TEXT], window[100] = "";
    if (e == NULL)
        return 0;
    const int at = q->reduction == SCENE_AT;
    const double begin = fmax(q->passing.from, scene_motion_begin(s, q->analysis));
    if (q->reduction == SCENE_CURVE && q->transform == SCENE_HISTORY && e->omits > 0)
        snprintf(r->meaning, sizeof r->meaning,
                 "begins at %.10g s, where this run continues another run", e->time);
    if (!reaches_back(s, q, e, begin))
        return 0;
    if (!at && (q->passing.until == 0 || q->passing.until > e->time))
        snprintf(window, sizeof window, ", or let its window ('when') begin at %.10g s or later",
                 e->time);
    snprintf(
        why, sizeof why,
        "needs the motion %s %.10g s, but this run continues from %.10g s: run without --restart%s",
        at ? "at" : "from", at ? q->at : begin, e->time, window);
    quantity_no_value(r, STATUS_NO_VALUE, why);
    return 1;
}
