#include "harness/experiments/extreme_sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const cell_result *extreme_sweep_cell(const extreme_sweep *s, const extreme_outcome *o)
{
    return &s->first.series[o->series].cell[0];
}

const scene_quantity *extreme_sweep_quantity(const extreme_sweep *s, const extreme_outcome *o)
{
    const scene *all = &s->first.point[o->point].scene;
    for (int i = 0; i < all->quantities; i++)
        if (strcmp(all->quantity[i].name, extremes[o->extreme].quantity[o->quantity].name) == 0)
            return &all->quantity[i];
    return NULL;
}

const quantity_result *extreme_sweep_result(const extreme_sweep *s, const extreme_outcome *o,
                                            const cell_result *cell)
{
    const ptrdiff_t index = extreme_sweep_quantity(s, o) - s->first.point[o->point].scene.quantity;
    return index < cell->solve.quantities ? &cell->solve.quantity[index] : NULL;
}

double extreme_sweep_value(const extreme_sweep *s, const extreme_outcome *o, int refinement)
{
    if (refinement > 0 && o->neighbours < 0)
        return NAN;
    const cell_result *cell = refinement == 0
                                  ? extreme_sweep_cell(s, o)
                                  : &s->neighbours.series[o->neighbours].cell[refinement - 1];
    const quantity_result *r = extreme_sweep_result(s, o, cell);
    return r != NULL && r->status == STATUS_OK ? r->value : NAN;
}

extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o)
{
    for (int i = 0; i < s->outcomes; i++) {
        extreme_outcome *b = &s->outcome[i];
        if (b->extreme == o->extreme && b->formulation == o->formulation &&
            b->quantity == o->quantity && b->x == extremes[o->extreme].same_as)
            return b;
    }
    return NULL;
}

int extreme_sweep_exit(const extreme_sweep *s)
{
    int tried = 0;
    for (int i = 0; i < s->formulations; i++)
        tried += s->count[i].tried;
    if (tried == 0)
        return 3;
    return s->unexpected > 0 || s->unobserved > 0;
}

void extreme_sweep_free(extreme_sweep *s)
{
    for (int i = 0; i < s->findings; i++) {
        extreme_finding *r = &s->finding[i];
        char *const all[] = {r->extreme, r->formulation, r->quantity, r->outcome, r->proof};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    truths_free(&s->truths);
    sweep_free(&s->first);
    sweep_free(&s->neighbours);
    free(s->finding);
    free(s->formulation);
    free(s->outcome);
    free(s->count);
    memset(s, 0, sizeof *s);
}
