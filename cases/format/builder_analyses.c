/* Analyses of a scene. */
#include <stdio.h>
#include <string.h>

#include "cases/format/builder.h"

/* What its table does not say. */
static void complete(const fields *f, int index, scene_analysis *a)
{
    const fields control = fields_below(f, "continuation"), motion = fields_below(f, "motion"),
                 what = fields_below(f, scene_analysis_name(a->kind));
    if (a->kind == SCENE_CONTINUATION) {
        scene_control *how = &a->of.continuation.control;
        how->step_max = fields_number(&control, "step_max", how->step);
    }
    if (a->kind == SCENE_MOTION)
        builder_in_time(&motion, &a->of.motion);
    if (a->follows >= index) {
        document_mistake(f->b->mistakes, document_find(what.map, "about"), 0,
                         "'%s' does not stand before this one; move it up",
                         fields_text(&what, "about", ""));
        a->follows = SCENE_NONE;
    }
}

void builder_analyses(builder *b)
{
    for (int i = 0; i < b->list[SCENE_ANALYSES].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_ANALYSES].entry[i]);
        const int index = scene_add_linear(b->scene);
        if (index < 0)
            return;
        builder_call(b, SCENE_ANALYSES, index, i);
        fields_read(&f, entry_analysis, &b->scene->analysis[index]);
        complete(&f, index, &b->scene->analysis[index]);
    }
}

void builder_no_quantity(const fields *what, const char *key, const scene_quantity *q)
{
    const scene_analysis *a = &what->b->scene->analysis[q->analysis];
    char who[128] = "";
    for (int k = SCENE_LINEAR; k <= SCENE_MOTION; k++)
        if (scene_gives((scene_analysis_kind)k, q)) {
            const size_t used = strlen(who);
            snprintf(who + used, sizeof who - used, "%s%s", used > 0 ? ", " : "",
                     scene_analysis_name((scene_analysis_kind)k));
        }
    document_mistake(what->b->mistakes, document_find(what->map, "analysis"), 0,
                     "'%s' is %s and has no %s; name an analysis that has: %s", a->name,
                     scene_analysis_name(a->kind), key, who);
}
