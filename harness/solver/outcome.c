#include "harness/solver/outcome.h"

#include <assert.h>
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

static void free_path(outcome_path *p)
{
    free_states(p->reached, p->state);
    free_states(p->points, p->point_state);
    free(p->value);
    free(p->factor);
    free(p->control);
    if (p->modes != NULL)
        for (int i = 0; i < p->stations; i++)
            outcome_modes_free(&p->modes[i]);
    free(p->modes);
}

static void free_side(outcome_side *side)
{
    free(side->value);
    free(side->mode);
    free(side->error);
}

int outcome_has_path(const analysis_outcome *o)
{
    return o->kind == SCENE_STATIC || o->kind == SCENE_COMPLIANCE ||
           o->kind == SCENE_CONTINUATION || o->kind == SCENE_ROTATION;
}

int outcome_has_spectrum(const analysis_outcome *o)
{
    return o->kind == SCENE_BUCKLING || o->kind == SCENE_MODAL;
}

const double *outcome_displacements(const analysis_outcome *o)
{
    assert(o->kind == SCENE_LINEAR);
    return o->of.x;
}

const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *o)
{
    assert(outcome_has_spectrum(o));
    return &o->of.spectrum;
}

const outcome_path *outcome_path_of(const analysis_outcome *o)
{
    assert(outcome_has_path(o));
    return &o->of.path;
}

void outcome_free(analysis_outcome *o)
{
    if (outcome_has_path(o)) {
        free_path(&o->of.path);
    } else if (outcome_has_spectrum(o)) {
        free_side(&o->of.spectrum.positive);
        free_side(&o->of.spectrum.negative);
    } else {
        free(o->of.x);
    }
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

status outcome_stations(outcome_path *p, int stations, fault *f)
{
    p->stations = stations;
    p->value = calloc((size_t)stations + 1, sizeof *p->value);
    p->state = calloc((size_t)stations + 1, sizeof(model_state *));
    return p->value == NULL || p->state == NULL
               ? fault_set(f, STATUS_FAULT, "out of memory for a path")
               : STATUS_OK;
}

status outcome_keep(outcome_path *p, const model *m, const model_state *s, double path, fault *f)
{
    TRY(kinematics_state_alloc(m, &p->state[p->reached], f));
    kinematics_state_copy(m, s, p->state[p->reached]);
    p->value[p->reached++] = path;
    return STATUS_OK;
}
