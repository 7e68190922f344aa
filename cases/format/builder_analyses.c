/* Analyses of a scene. */
#include <stdio.h>
#include <string.h>

#include "cases/format/builder.h"

enum { MOST_STEPS = 1000000, MOST_MODES = 1000 };

static scene_rotating_frame frame_of(const fields *f)
{
    scene_rotating_frame frame = {{0}, {0}};
    fields_vector(f, "omega", 3, frame.omega);
    fields_vector(f, "centre", 3, frame.centre);
    return frame;
}

static void add_static(const fields *f)
{
    double *path;
    const fields spin = fields_below(f, "spin");
    const int count = fields_values(f, "stations", &path);
    const int added =
        scene_add_static(f->b->scene, count, path, fields_whole(f, "steps", 1, 1, MOST_STEPS));
    if (spin.map != NULL)
        scene_set_rotating_frame(f->b->scene, added, frame_of(&spin));
}

static void add_rotation(const fields *f)
{
    double *path;
    const int count = fields_values(f, "stations", &path);
    scene_add_rotation(f->b->scene, count, path, fields_whole(f, "steps", 1, 1, MOST_STEPS),
                       fields_whole(f, "wanted", 0, 0, MOST_MODES), frame_of(f));
}

static void add_compliance(const fields *f, int index)
{
    const scene_compliance what = {.node = fields_entry(f, "node", SCENE_NODES),
                                   .moments = (scene_moments)fields_word(
                                       f, "moments", SCENE_MOMENTS_CHOICES, SCENE_MOMENTS_SPATIAL),
                                   .released = fields_words(f, "released", fields_components)};
    scene_add_compliance(f->b->scene, builder_about(f, index), what);
}

static void add_continuation(const fields *f)
{
    double *to;
    const fields control = fields_below(f, "control"), spin = fields_below(f, "spin");
    const int count = fields_values(f, "to", &to);
    const double step = fields_number(f, "step", 1);
    const scene_control how = {.node = fields_entry(&control, "node", SCENE_NODES),
                               .component = fields_word(&control, "component", "ux|uy|uz", 0),
                               .by_arc = fields_word(f, "by", "coordinate|arc", 0),
                               .step = step,
                               .step_max = fields_number(f, "step_max", step),
                               .constant_steps = fields_word(f, "constant", "no|yes", 0)};
    const int added = scene_add_continuation(f->b->scene, count, to, how);
    if (spin.map != NULL)
        scene_set_rotating_frame(f->b->scene, added, frame_of(&spin));
}

void builder_analyses(builder *b)
{
    for (int i = 0; i < b->list[SCENE_ANALYSES].count; i++) {
        const fields entry = fields_of(b, &b->list[SCENE_ANALYSES].entry[i]);
        scene_analysis_kind kind = SCENE_LINEAR;
        while (kind < SCENE_MOTION && !fields_have(&entry, scene_analysis_name(kind)))
            kind++;
        const fields f = fields_below(&entry, scene_analysis_name(kind));
        const int index = b->scene->analyses;
        switch (kind) {
        case SCENE_LINEAR:
            scene_add_linear(b->scene);
            break;
        case SCENE_STATIC:
            add_static(&f);
            break;
        case SCENE_BUCKLING:
            scene_add_buckling(b->scene, builder_about(&f, i));
            break;
        case SCENE_MODAL:
            scene_add_modal(b->scene, builder_about(&f, i));
            break;
        case SCENE_COMPLIANCE:
            add_compliance(&f, i);
            break;
        case SCENE_CONTINUATION:
            add_continuation(&f);
            break;
        case SCENE_MOTION:
            builder_in_time(&f, i);
            break;
        case SCENE_ROTATION:
            add_rotation(&f);
            break;
        }
        builder_call(b, SCENE_ANALYSES, index, i);
    }
}

void builder_no_quantity(const fields *what, const char *analysis, const char *key,
                         scene_analysis_kind is, scene_quantity_kind kind)
{
    char who[128] = "";
    for (int k = SCENE_LINEAR; k <= SCENE_MOTION; k++)
        if (scene_gives((scene_analysis_kind)k, kind)) {
            const size_t used = strlen(who);
            snprintf(who + used, sizeof who - used, "%s%s", used > 0 ? ", " : "",
                     scene_analysis_name((scene_analysis_kind)k));
        }
    document_mistake(what->b->mistakes, document_find(what->map, "analysis"), 0,
                     "'%s' is %s and has no %s; name an analysis that has: %s", analysis,
                     scene_analysis_name(is), key, who);
}
