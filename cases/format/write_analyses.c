/* Analyses of a scene file. */
#include "cases/format/write_impl.h"

static void write_largest(writer *w, const void *entry)
{
    const scene_control *c = &scene_continuation_of(entry)->control;
    write_values_if(w, "step_max", c->step_max, c->step);
}

static void write_integrator(writer *w, const void *entry)
{
    write_values_key(w, "integrator");
    write_values_word(w, SCENE_SCHEME_CHOICES, (int)scene_motion_of(entry)->scheme);
}

static void write_parameters(writer *w, const void *entry)
{
    const scene_motion *m = scene_motion_of(entry);
    if (m->scheme != SCENE_ALPHA)
        return;
    write_values_key(w, "parameters");
    write_values_numbers(w, 2, (const double[]){m->alpha.mass, m->alpha.force});
}

void write_analyses(writer *w)
{
    static const write_own own[] = {{"step_max", write_largest},
                                    {"integrator", write_integrator},
                                    {"parameters", write_parameters},
                                    {NULL, NULL}};
    fputs("analyses:\n", w->to);
    for (int i = 0; i < w->scene->analyses; i++) {
        write_values_named(w, "  ", SCENE_ANALYSES, i);
        fputs(": ", w->to);
        write_entry(w, entry_analysis, &w->scene->analysis[i], own);
        fputc('\n', w->to);
    }
}
