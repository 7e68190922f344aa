/* Analyses of a scene file. */
#include "cases/format/write_impl.h"

static int turns(const scene_rotating_frame *frame)
{
    for (int i = 0; i < 3; i++)
        if (frame->omega[i] != 0 || frame->centre[i] != 0)
            return 1;
    return 0;
}

static void write_frame(writer *w, const scene_rotating_frame *frame)
{
    if (!turns(frame))
        return;
    fputs(", spin: {omega: ", w->to);
    write_values_numbers(w, 3, frame->omega);
    fputs(", centre: ", w->to);
    write_values_numbers(w, 3, frame->centre);
    fputc('}', w->to);
}

static void write_walk(writer *w, const scene_analysis *a)
{
    const scene_walk *walk = scene_walk_of(a);
    const int rotation = a->kind == SCENE_ROTATION;
    if (rotation) {
        fputs("rotation: {omega: ", w->to);
        write_values_numbers(w, 3, walk->frame.omega);
        fputs(", centre: ", w->to);
        write_values_numbers(w, 3, walk->frame.centre);
    }
    fputs(rotation ? ", stations: " : "static: {stations: ", w->to);
    write_values_numbers(w, walk->path.stations, walk->path.value);
    write_values_if(w, "steps", walk->steps_between, 1);
    if (rotation)
        write_values_if(w, "wanted", walk->modes, 0);
    else
        write_frame(w, &walk->frame);
}

static void write_compliance(writer *w, const scene_analysis *a)
{
    const scene_compliance *c = scene_compliance_of(a);
    int count = 0;
    write_values_named(w, "compliance: {node: ", SCENE_NODES, c->node);
    fprintf(w->to, ", moments: %s", scene_moments_name(c->moments));
    for (int i = 0; i < 6; i++)
        if (c->released >> i & 1u)
            fprintf(w->to, "%s%s", count++ == 0 ? ", released: [" : ", ",
                    write_values_component[i]);
    fputs(count > 0 ? "]" : "", w->to);
    if (a->follows != SCENE_NONE)
        write_values_named(w, ", about: ", SCENE_ANALYSES, a->follows);
}

static void write_continuation(writer *w, const scene_analysis *a)
{
    const scene_continuation *c = scene_continuation_of(a);
    write_values_named(w, "continuation: {control: {node: ", SCENE_NODES, c->control.node);
    fprintf(w->to, ", component: %s}, by: %s, to: ", write_values_component[c->control.component],
            c->control.by_arc ? "arc" : "coordinate");
    write_values_numbers(w, c->path.stations, c->path.value);
    fputs(", step: ", w->to);
    write_values_number(w, c->control.step);
    write_values_if(w, "step_max", c->control.step_max, c->control.step);
    fputs(c->control.constant_steps ? ", constant: yes" : "", w->to);
    write_frame(w, &c->frame);
}

static void write_start(writer *w, const scene_start *start)
{
    const struct {
        const char *key;
        const double *value;
    } part[] = {{"velocity", start->velocity}, {"spin", start->spin}, {"centre", start->centre}};
    int count = 0;
    for (int i = 0; i < 3; i++)
        if (write_values_any(3, part[i].value)) {
            fprintf(w->to, "%s%s: ", count++ == 0 ? ", start: {" : ", ", part[i].key);
            write_values_numbers(w, 3, part[i].value);
        }
    fputs(count > 0 ? "}" : "", w->to);
}

static void write_motion(writer *w, const scene_analysis *a)
{
    static const char *const scheme[] = {"alpha", "conserving", "radau", "explicit"};
    const scene_motion *m = scene_motion_of(a);
    const double alpha[2] = {m->alpha.mass, m->alpha.force};
    fputs("motion: {stations: ", w->to);
    write_values_numbers(w, m->path.stations, m->path.value);
    fprintf(w->to, ", integrator: %s, step: ", scheme[m->scheme]);
    write_values_number(w, m->step);
    write_values_if(w, "tolerance", m->tolerance, 0);
    if (m->scheme == SCENE_ALPHA) {
        fputs(", parameters: ", w->to);
        write_values_numbers(w, 2, alpha);
    }
    if (m->mass != SCENE_MASS_USUAL)
        fputs(m->mass == SCENE_CONSISTENT ? ", mass: consistent" : ", mass: lumped", w->to);
    if (a->follows != SCENE_NONE)
        write_values_named(w, ", about: ", SCENE_ANALYSES, a->follows);
    write_start(w, &m->start);
}

void write_analyses(writer *w)
{
    fputs("analyses:\n", w->to);
    for (int i = 0; i < w->scene->analyses; i++) {
        const scene_analysis *a = &w->scene->analysis[i];
        write_values_named(w, "  ", SCENE_ANALYSES, i);
        fputs(": {", w->to);
        switch (a->kind) {
        case SCENE_LINEAR:
            fputs("linear: {", w->to);
            break;
        case SCENE_BUCKLING:
        case SCENE_MODAL:
            fputs(a->kind == SCENE_MODAL ? "modal: {" : "buckling: {", w->to);
            if (a->follows != SCENE_NONE)
                write_values_named(w, "about: ", SCENE_ANALYSES, a->follows);
            break;
        case SCENE_STATIC:
        case SCENE_ROTATION:
            write_walk(w, a);
            break;
        case SCENE_MOTION:
            write_motion(w, a);
            break;
        case SCENE_COMPLIANCE:
            write_compliance(w, a);
            break;
        case SCENE_CONTINUATION:
            write_continuation(w, a);
            break;
        }
        fputs("}}\n", w->to);
    }
}
