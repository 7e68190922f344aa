#include "harness/newton/shapes.h"

#include <stdlib.h>
#include <string.h>

status shapes_alloc(shapes *s, fault *f)
{
    const size_t states = (size_t)s->states + 1;
    s->first = calloc((size_t)s->members + 2, sizeof *s->first);
    s->state = calloc(states, sizeof *s->state);
    s->point = calloc(states * (size_t)s->points + 1, sizeof *s->point);
    s->node = calloc(states * 3 * (size_t)s->nodes + 1, sizeof *s->node);
    return s->first != NULL && s->state != NULL && s->point != NULL && s->node != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for the shapes of %d states", s->states);
}

void shapes_free(shapes *s)
{
    free(s->first);
    free(s->state);
    free(s->point);
    free(s->node);
    memset(s, 0, sizeof *s);
}

const char *shapes_kind_name(shape_kind kind)
{
    static const char *const name[] = {"undeformed", "path", "linear",
                                       "buckling",   "mode", "motion"};
    return name[kind];
}

int shapes_frames(int most)
{
    if (most <= 0)
        return 0;
    return most <= SHAPES_FEW || most >= SHAPES_ALL ? SHAPES_FRAMES : most;
}
