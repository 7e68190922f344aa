#include "harness/newton/outcome.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

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
    free(p->value);
}

static void free_rotation(outcome_rotation *r)
{
    if (r->modes != NULL)
        for (int i = 0; i < r->path.stations; i++)
            outcome_modes_free(&r->modes[i]);
    free(r->modes);
    free_path(&r->path);
}

static void free_continuation(outcome_continuation *c)
{
    free_states(c->points, c->state);
    free(c->factor);
    free(c->control);
    free_path(&c->path);
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
           o->kind == SCENE_CONTINUATION || o->kind == SCENE_ROTATION || o->kind == SCENE_MOTION;
}

int outcome_has_spectrum(const analysis_outcome *o)
{
    return o->kind == SCENE_BUCKLING || o->kind == SCENE_MODAL;
}

const double *outcome_displacements(const analysis_outcome *o)
{
    assert(o->kind == SCENE_LINEAR);
    return o->left.x;
}

const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *o)
{
    assert(outcome_has_spectrum(o));
    return &o->left.spectrum;
}

const outcome_path *outcome_path_of(const analysis_outcome *o)
{
    switch (o->kind) {
    case SCENE_COMPLIANCE:
        return &o->left.compliance.path;
    case SCENE_CONTINUATION:
        return &o->left.continuation.path;
    case SCENE_ROTATION:
        return &o->left.rotation.path;
    case SCENE_MOTION:
        return &o->left.motion.path;
    default:
        assert(o->kind == SCENE_STATIC);
        return &o->left.path;
    }
}

const outcome_compliance *outcome_compliance_of(const analysis_outcome *o)
{
    assert(o->kind == SCENE_COMPLIANCE);
    return &o->left.compliance;
}

const outcome_rotation *outcome_rotation_of(const analysis_outcome *o)
{
    assert(o->kind == SCENE_ROTATION);
    return &o->left.rotation;
}

const outcome_motion *outcome_motion_of(const analysis_outcome *o)
{
    assert(o->kind == SCENE_MOTION);
    return &o->left.motion;
}

outcome_motion *outcome_motion_in(analysis_outcome *o)
{
    assert(o->kind == SCENE_MOTION);
    return &o->left.motion;
}

const outcome_continuation *outcome_continuation_of(const analysis_outcome *o)
{
    assert(o->kind == SCENE_CONTINUATION);
    return &o->left.continuation;
}

outcome_path *outcome_walk(analysis_outcome *o)
{
    assert(o->kind == SCENE_STATIC || o->kind == SCENE_ROTATION);
    return o->kind == SCENE_STATIC ? &o->left.path : &o->left.rotation.path;
}

size_t outcome_end_values(const outcome_end *e)
{
    return 2 * e->states + 3 * e->coordinates + 2 * e->strains + e->released + 5 * e->between;
}

void outcome_end_free(outcome_end *e)
{
    free(e->value);
    e->value = NULL;
}

void outcome_free(analysis_outcome *o)
{
    switch (o->kind) {
    case SCENE_LINEAR:
        free(o->left.x);
        break;
    case SCENE_MOTION:
        for (int i = 0; o->left.motion.instant != NULL && i < o->left.motion.path.stations; i++)
            free(o->left.motion.instant[i].rate);
        free(o->left.motion.instant);
        free(o->left.motion.passing);
        free(o->left.motion.step);
        free_path(&o->left.motion.path);
        free_path(&o->left.motion.frames);
        outcome_end_free(&o->left.motion.end);
        break;
    case SCENE_STATIC:
        free_path(&o->left.path);
        break;
    case SCENE_BUCKLING:
    case SCENE_MODAL:
        free_side(&o->left.spectrum.positive);
        free_side(&o->left.spectrum.negative);
        free(o->left.spectrum.strained);
        break;
    case SCENE_COMPLIANCE:
        free(o->left.compliance.taken);
        free_path(&o->left.compliance.path);
        break;
    case SCENE_CONTINUATION:
        free_continuation(&o->left.continuation);
        break;
    case SCENE_ROTATION:
        free_rotation(&o->left.rotation);
        break;
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

status outcome_keep(outcome_path *p, const model *m, const model_state *s, int whole, double path,
                    fault *f)
{
    model_state **kept = &p->state[p->reached];
    TRY(whole ? kinematics_state_alloc(m, kept, f) : kinematics_nodes_alloc(m, s, kept, f));
    if (whole)
        kinematics_state_copy(m, s, *kept);
    p->value[p->reached++] = path;
    return STATUS_OK;
}
