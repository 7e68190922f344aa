#include "harness/newton/newton_impl.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static void free_motion(outcome_motion *m)
{
    for (int i = 0; m->at_station != NULL && i < m->path.stations; i++)
        free(m->at_station[i].rate);
    for (int i = 0; i < m->abouts; i++) {
        outcome_about *one = &m->about[i];
        kinematics_state_free(one->state);
        free(one->rate);
        sparse_free_values(&one->K);
        sparse_free_values(&one->M);
        sparse_free_values(&one->C);
        sparse_free_values(&one->G);
    }
    free(m->about);
    free(m->at_station);
    free(m->passing);
    free(m->undefined);
    free(m->slope);
    free(m->step);
    free_path(&m->path);
    free_path(&m->frames);
    outcome_end_free(&m->end);
}

static void free_side(outcome_side *side)
{
    free(side->value);
    free(side->mode);
    free(side->error);
    free(side->shape);
}

int outcome_has_path(const analysis_outcome *o)
{
    return o->kind == SCENE_STATIC || o->kind == SCENE_COMPLIANCE ||
           o->kind == SCENE_CONTINUATION || o->kind == SCENE_ROTATION || o->kind == SCENE_MOTION ||
           o->kind == SCENE_HARMONIC;
}

int outcome_has_spectrum(const analysis_outcome *o)
{
    return o->kind == SCENE_BUCKLING || o->kind == SCENE_MODAL;
}

const outcome_linear *outcome_linear_of(const analysis_outcome *o)
{
    assert(o->kind == SCENE_LINEAR);
    return &o->left.linear;
}

const double *outcome_displacements(const analysis_outcome *o, int acting)
{
    const outcome_linear *l = outcome_linear_of(o);
    for (int i = 0; l->x != NULL && i < l->solutions; i++)
        if (l->acting[i] == acting)
            return l->x + (size_t)i * l->coordinates;
    return NULL;
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
    case SCENE_HARMONIC:
        return &o->left.harmonic.path;
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

const outcome_about *outcome_about_at(const analysis_outcome *o, double time)
{
    const outcome_motion *m = outcome_motion_of(o);
    for (int i = 0; i < m->abouts; i++)
        if (m->about[i].time == time && m->about[i].state != NULL)
            return &m->about[i];
    return NULL;
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
        free(o->left.linear.acting);
        free(o->left.linear.x);
        break;
    case SCENE_MOTION:
        free_motion(&o->left.motion);
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
    case SCENE_HARMONIC:
        free(o->left.harmonic.response);
        free(o->left.harmonic.bound);
        free(o->left.harmonic.peak);
        free(o->left.harmonic.path.value);
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
        snprintf(
            to->reason, sizeof to->reason,
            "the geometric stiffness is only round-off; apply a load that stresses the members");
    from->mu = from->mode = from->error = NULL;
}

status outcome_stations(outcome_path *p, int stations, fault *f)
{
    p->stations = stations;
    p->value = calloc((size_t)stations + 1, sizeof *p->value);
    p->state = calloc((size_t)stations + 1, sizeof(model_state *));
    return p->value == NULL || p->state == NULL ? fault_memory(f, "a path") : STATUS_OK;
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

status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f)
{
    const int first = step->iterations == 0;
    const double start = first ? energy : step->energy;
    iteration_record entry = *one;
    entry.residual = energy == 0 ? 0 : sqrt(energy / start);
    TRY(memory_append(&r->iteration, &r->iterations, &entry, sizeof entry, "step records", f));
    if (first) {
        step->first = r->iterations - 1;
        step->energy = energy;
    }
    step->iterations++;
    step->residual = entry.residual;
    step->correction = one->correction;
    step->incompatibility = one->incompatibility;
    return STATUS_OK;
}

void history_drop_step(solve_result *r, const step_record *step)
{
    if (step->iterations > 0)
        r->iterations = step->first;
}

history_mark history_here(const solve_result *r)
{
    return (history_mark){r->steps, r->iterations, r->ends};
}

void history_go_back(solve_result *r, const history_mark *mark)
{
    while (r->ends > mark->ends)
        outcome_end_free(&r->end[--r->ends]);
    r->steps = mark->steps;
    r->iterations = mark->iterations;
}

status history_add_step(solve_result *r, const step_record *record, fault *f)
{
    return memory_append(&r->step, &r->steps, record, sizeof *record, "step records", f);
}

/* Returns the stability of a state with an unsymmetric tangent. Without mass, the state is unstable
 * if an eigenvalue has crossed zero; with mass, if an odd number has. Otherwise, with mass,
 * frequencies decide (`judged`). */
static step_stability without_symmetry(const scene *s, const step_record *one)
{
    const int massive = scene_has_mass(s);
    if (one->by_eigenvalues && one->passed > 0 && (!massive || one->passed % 2 != 0))
        return STEP_UNSTABLE;
    if (massive || !one->by_eigenvalues || one->passed < 0)
        return one->judged;
    return STEP_NO_DIVERGENCE;
}

void history_evaluate_steps(solve_result *r, const scene *s, int analysis, int first)
{
    const scene_analysis *a = &s->analysis[analysis];
    for (int i = first; i < r->steps; i++) {
        step_record *one = &r->step[i];
        one->analysis = analysis;
        one->stability = without_symmetry(s, one);
        if (a->kind == SCENE_MOTION || one->negative_pivots < 0)
            continue;
        if (one->negative_pivots == 0)
            one->stability = STEP_STABLE;
        else if (a->kind != SCENE_ROTATION && !scene_rotates(a))
            one->stability = STEP_UNSTABLE;
        else if (one->negative_pivots % 2 != 0)
            /* an odd number cannot be stabilised: det(s^2 M + s G + K) is negative at s = 0 and
             * positive for large s */
            one->stability = STEP_GROWS;
    }
}

void history_evaluate_station(solve_result *r, int analysis, double path, step_stability found)
{
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis && r->step[i].path == path &&
            r->step[i].stability == STEP_OPEN)
            r->step[i].stability = found;
}

step_stability history_stability_at(const solve_result *r, int analysis, double path)
{
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis && r->step[i].path == path)
            return r->step[i].stability;
    return STEP_OPEN;
}

status history_add_event(solve_result *r, const path_event *event, fault *f)
{
    return memory_append(&r->event, &r->events, event, sizeof *event, "events", f);
}

status history_add_motion(solve_result *r, int analysis, double path, const outcome_motion *o,
                          fault *f)
{
    motion_record *more = realloc(r->motion, (size_t)(r->motions + o->steps + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "the steps of a motion");
    r->motion = more;
    for (int i = 0; i < o->steps; i++)
        r->motion[r->motions++] = (motion_record){analysis, path, o->step[i]};
    return STATUS_OK;
}
