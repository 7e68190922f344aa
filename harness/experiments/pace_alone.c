#include "harness/experiments/pace_alone.h"

#include <math.h>

static int is_held(const scene_node *n)
{
    for (int i = 0; i < 3; i++)
        if (n->translation[i] != SCENE_FREE || n->angle[i] != SCENE_FREE)
            return 1;
    return n->rotation != SCENE_ROTATION_SPATIAL;
}

/* Zero wherever it is looked at. */
static int is_over(const scene_function *f, double from)
{
    static const double later[] = {0, 0.37, 1, 7.3, 61};
    for (size_t i = 0; i < sizeof later / sizeof later[0]; i++) {
        double value[3];
        function_at(f, from + later[i], value);
        if (value[0] != 0 || value[1] != 0)
            return 0;
    }
    return 1;
}

static double load_until(const scene_load *load)
{
    const scene_function *f = &load->function;
    if (!scene_load_acts(load))
        return 0;
    if (f->pieces > 0) {
        const double from = f->pieces > 1 ? f->piece[f->pieces - 2].until : 0;
        return is_over(f, from) ? from : INFINITY;
    }
    if (load->stations > 0 && load->factor[load->stations - 1] == 0)
        return load->path[load->stations - 1];
    return INFINITY;
}

double pace_alone_from(const scene *s)
{
    double from = 0;
    for (int i = 0; i < s->nodes; i++)
        if (is_held(&s->node[i]))
            return INFINITY;
    for (int i = 0; i < s->springs; i++)
        if (s->spring[i].p == SCENE_NONE || s->spring[i].q == SCENE_NONE)
            return INFINITY;
    for (int i = 0; i < s->loads; i++)
        from = fmax(from, load_until(&s->load[i]));
    return from;
}
