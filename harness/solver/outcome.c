#include "harness/solver/outcome.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/kinematics.h"

void outcome_modes_free(rotation_modes *m)
{
    free(m->frequency);
    free(m->shape);
    memset(m, 0, sizeof *m);
}

static void free_states(int count, model_state **state)
{
    if (state != NULL)
        for (int i = 0; i < count; i++)
            kinematics_state_free(state[i]);
    free(state);
}

void outcome_free(analysis_outcome *o)
{
    free_states(o->reached, o->state);
    free_states(o->points, o->point_state);
    free(o->path);
    free(o->x);
    free(o->factor);
    free(o->control);
    outcome_side *const sides[] = {&o->positive, &o->negative};
    for (int i = 0; i < 2; i++) {
        free(sides[i]->value);
        free(sides[i]->mode);
        free(sides[i]->error);
    }
    if (o->modes != NULL)
        for (int i = 0; i < o->stations; i++)
            outcome_modes_free(&o->modes[i]);
    free(o->modes);
}

void outcome_take(eigen_side *from, outcome_side *to)
{
    to->count = from->count;
    to->value = from->mu;
    to->mode = from->mode;
    to->error = from->error;
    to->status = from->status;
    snprintf(to->reason, sizeof to->reason, "%s", from->reason);
    if (from->rounding > 0 && from->status == STATUS_OK)
        snprintf(to->reason, sizeof to->reason, "geometric stiffness is round-off");
    from->mu = from->mode = from->error = NULL;
}

status outcome_stations(analysis_outcome *o, int stations, fault *f)
{
    o->stations = stations;
    o->path = calloc((size_t)stations + 1, sizeof *o->path);
    o->state = calloc((size_t)stations + 1, sizeof(model_state *));
    return o->path == NULL || o->state == NULL
               ? fault_set(f, STATUS_FAULT, "out of memory for a path")
               : STATUS_OK;
}

status outcome_keep(analysis_outcome *o, const model *m, const model_state *s, double path,
                    fault *f)
{
    TRY(kinematics_state_alloc(m, &o->state[o->reached], f));
    kinematics_state_copy(m, s, o->state[o->reached]);
    o->path[o->reached++] = path;
    return STATUS_OK;
}
