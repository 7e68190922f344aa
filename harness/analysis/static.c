/* Nonlinear equilibrium along a load path with adaptive steps. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"

/* Prepares the compliances of all analyses about states of `path`. *out is NULL if no such analysis
 * follows the path. */
static status compliance_walk_begin(newton_run *, int path, compliance_walk **out, fault *);

enum { EASY_ITERATIONS = 6, MAX_HALVINGS = 14, SINGULAR_STARTS = 3 };

/* Determines the stability at the end of a step if the pivots do not decide it. Sets *found to a
 * path parameter within the step at which stability differs from that at both ends, or to INFINITY
 * if there is none. last_resort: 1 if the step cannot be shorter. */
static status check_flutter(newton_run *n, flutter_check *flutter, int last_resort,
                            step_record *record, double *found, fault *f)
{
    *found = INFINITY;
    if (flutter == NULL)
        return STATUS_OK;
    if (!last_resort)
        return within_step(flutter, n, record, found, f);
    return record->negative_pivots >= 0 ? STATUS_OK
                                        : flutter_check_state(flutter, n->c, n->state, record, f);
}

static void take_back(newton_run *n, const step_record *record)
{
    history_drop_step(n->c->result, record);
    kinematics_state_copy(n->c->model, n->backup, n->state);
    if (n->predictor != NULL)
        predictor_reset(n->predictor);
    n->c->run->counters.rejected_steps++;
}

/* Returns 1 if a step from a stable to an unstable state has a correction larger than its first
 * one. Newton's method may then have left the path for another solution. */
static int may_have_left_path(const newton_run *n, const step_record *record)
{
    const solve_result *r = n->c->result;
    const iteration_record *iteration = r->iteration + record->first;
    const step_record *before = r->steps > 0 ? &r->step[r->steps - 1] : NULL;
    if (record->negative_pivots <= 0 ||
        (before != NULL && before->analysis == record->analysis && before->negative_pivots != 0))
        return 0;
    for (int i = 1; i < record->iterations; i++)
        if (iteration[i].correction > iteration[0].correction)
            return 1;
    return 0;
}

static status walk_to(newton_run *n, double target, flutter_check *flutter, double *increment,
                      fault *f)
{
    counters *count = &n->c->run->counters;
    const double least = *increment / (1 << MAX_HALVINGS);
    int rejected = 0;
    while (kinematics_state_path(n->state) < target) {
        const double from = kinematics_state_path(n->state);
        const int last = from + *increment * (1 + 1e-9) >= target;
        const double to = last ? target : from + *increment;
        step_record record = {.path = to, .increment = to - from, .rejected = rejected};
        kinematics_commit(n->c->model, n->state);
        kinematics_state_copy(n->c->model, n->state, n->backup);
        if (n->predictor != NULL)
            predictor_guess(&n->c->eq, n->predictor, to, n->state);
        const status outcome = newton_to(n, to, &record, f);
        double found = INFINITY;
        if (outcome == STATUS_OK)
            TRY(check_flutter(n, flutter, to - from <= least, &record, &found, f));
        if (isfinite(found)) {
            take_back(n, &record);
            rejected++;
            *increment = found - from;
            continue;
        }
        const int shorten =
            outcome == STATUS_OK && to - from > least && may_have_left_path(n, &record);
        if (outcome == STATUS_OK && !shorten) {
            TRY(history_add_step(n->c->result, &record, f));
            count->steps++;
            count->negative_pivots = record.negative_pivots > count->negative_pivots
                                         ? record.negative_pivots
                                         : count->negative_pivots;
            if (n->predictor != NULL)
                TRY(predictor_add(&n->c->eq, n->state, record.iterations, n->predictor, f));
            if (record.iterations <= EASY_ITERATIONS && rejected == 0 &&
                to - from >= *increment * (1 - 1e-9))
                *increment *= 2;
            rejected = 0;
            continue;
        }
        const int cannot_converge =
            outcome == STATUS_SINGULAR && record.iterations == 0 && rejected >= SINGULAR_STARTS;
        if (!shorten && (outcome == STATUS_FAULT || outcome == STATUS_REFUSED ||
                         to - from <= least || cannot_converge)) {
            history_drop_step(n->c->result, &record);
            return outcome;
        }
        take_back(n, &record);
        rejected++;
        *increment = (to - from) / 2;
    }
    return STATUS_OK;
}

status static_walk(newton_run *n, double target, double *increment, fault *f)
{
    return walk_to(n, target, NULL, increment, f);
}

static status sample(newton_run *n, double path, fault *f)
{
    step_record record = {.path = path};
    for (int i = 0; i < n->c->options->sample; i++)
        TRY(newton_direction(n, path, &record, f));
    return STATUS_OK;
}

/* Returns 1 if loads or drivers are not zero at path 0, or if there are stress-free strains. */
static int begins_loaded(const analysis_context *c)
{
    const scene *s = c->scene;
    int acts = model_frees(c->model);
    for (int i = 0; i < s->loads; i++)
        acts |= applied_factor(&c->eq, &s->load[i], 0) != 0;
    for (int i = 0; i < s->drivers; i++)
        acts |= s->driver[i].value != NULL && loads_driver_value(&c->eq, &s->driver[i], 0) != 0;
    for (int i = 0; i < s->members; i++)
        acts |= vec3_norm(s->member[i].strain) > 0;
    return acts;
}

static status equilibrate(newton_run *n, flutter_check *flutter, fault *f)
{
    step_record record = {.path = 0};
    double found = INFINITY;
    status outcome = newton_to(n, 0, &record, f);
    if (outcome == STATUS_OK)
        outcome = check_flutter(n, flutter, 1, &record, &found, f);
    if (outcome != STATUS_OK) {
        history_drop_step(n->c->result, &record);
        return outcome;
    }
    TRY(history_add_step(n->c->result, &record, f));
    n->c->run->counters.steps++;
    return STATUS_OK;
}

static status walk(newton_run *n, int analysis, flutter_check *flutter, compliance_walk *on_the_way,
                   outcome_path *o, fault *f)
{
    analysis_context *c = n->c;
    const scene_walk *a = scene_walk_of(&c->scene->analysis[analysis]);
    const int between =
        c->options->steps_between > 0 ? c->options->steps_between : a->steps_between;
    const int steps = between > 0 ? between : 1;
    double increment = 0;
    for (int i = 0; i < a->path.stations; i++) {
        const double from = i > 0 ? a->path.value[i - 1] : 0;
        increment = fmax(increment, (a->path.value[i] - from) / steps);
        if (i == 0 && a->path.value[0] <= kinematics_state_path(n->state) && begins_loaded(c))
            TRY(equilibrate(n, flutter, f));
        TRY(walk_to(n, a->path.value[i], flutter, &increment, f));
        if (c->options->newton != NEWTON_DENSE && n->condensed == NULL)
            context_count_condition(c, n->factor, &n->K);
        TRY(compliance_walk_take(on_the_way, n, i, f));
        TRY(outcome_keep(o, c->model, n->state, extract_path_whole(c, analysis, i),
                         a->path.value[i], f));
    }
    return STATUS_OK;
}

static status solve(analysis_context *c, int analysis, newton_run *n, predictor *t,
                    flutter_check *flutter, compliance_walk **on_the_way, outcome_path *o, fault *f)
{
    const scene_walk *a = scene_walk_of(&c->scene->analysis[analysis]);
    TRY(newton_alloc(c, 1, n, f));
    TRY(predictor_alloc(c->model, t, f));
    n->predictor = t;
    TRY(outcome_stations(o, a->path.stations, f));
    if (c->options->sample > 0)
        return sample(n, a->path.value[0], f);
    TRY(compliance_walk_begin(n, analysis, on_the_way, f));
    return walk(n, analysis, flutter, *on_the_way, o, f);
}

status static_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    newton_run n;
    predictor t = {0};
    compliance_walk *on_the_way = NULL;
    flutter_check flutter = {0};
    const scene_analysis *a = &c->scene->analysis[analysis];
    const int checks_flutter =
        c->options->checks_flutter && a->kind != SCENE_ROTATION && !scene_rotates(a);
    const status result = solve(c, analysis, &n, &t, checks_flutter ? &flutter : NULL, &on_the_way,
                                outcome_walk(o), f);
    flutter_check_free(&flutter);
    compliance_walk_end(on_the_way);
    predictor_free(&t);
    newton_free(&n);
    return result;
}

/* Returns the columns of the compliance or stiffness that quantities request, one bit each. */
static unsigned wanted_columns(const analysis_context *c, int analysis)
{
    unsigned wanted = 0;
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (scene_requests(q, analysis, SCENE_COMPLIANCE_ENTRY) ||
            scene_requests(q, analysis, SCENE_STIFFNESS_ENTRY))
            wanted |= 1u << scene_entry_of(q)->column;
    }
    return wanted;
}

static void clear_columns(unsigned known, double C[36])
{
    for (int i = 0; i < 36; i++)
        if (!(known >> i % 6 & 1u))
            C[i] = NAN;
}

/* Computes the reaction on the node: its force [N], and the moment [N m] that causes its
 * rotation. */
static status reaction_of(analysis_context *c, const scene_compliance *what, const model_state *s,
                          node_tangent *t, double reaction[6], fault *f)
{
    double load[6];
    linearise_node_force(&c->eq, s, NULL, what->node, reaction);
    loads_at_node(&c->eq, s, kinematics_state_path(s), what->node, load);
    for (int i = 0; i < 6; i++)
        reaction[i] -= load[i];
    return tangent_driven_moment(c, s, what->node, t, reaction + 3, f);
}

static status matrices_of(analysis_context *c, const scene_compliance *what, double reaction[6],
                          node_tangent *t, unsigned wanted, station_matrices *out, fault *f)
{
    movable motions;
    tangent_movable(c->model, t, &motions);
    tangent_prescribed(t, reaction + 3);
    const unsigned turns = motions.components & 0x38, held = 0x3f & ~motions.components;
    const scene_moments own = coordinates_held_turn(c->model, what->node) == NONE
                                  ? SCENE_MOMENTS_SEMITANGENTIAL
                                  : SCENE_MOMENTS_SPATIAL;
    if (turns && convention_changes(own, what->moments, reaction + 3))
        wanted = 0x3f;
    TRY(tangent_compliance(c, t, wanted, motions.components, out->C, f));
    if (motions.count > 0 && (wanted | held) == 0x3f)
        return convention_apply(own, what->moments, &motions, reaction + 3, out->C, out->K, f);
    clear_columns(wanted | held, out->C);
    clear_columns(0, out->K);
    return STATUS_OK;
}

static status compliance_at(analysis_context *c, const scene_compliance *what, const model_state *s,
                            node_tangent *t, unsigned wanted, station_matrices *out, fault *f)
{
    double reaction[6];
    TRY(reaction_of(c, what, s, t, reaction, f));
    TRY(tangent_at(c, what, s, reaction, t, f));
    return matrices_of(c, what, reaction, t, wanted, out, f);
}

/* Evaluates the analysis at a state that Newton's method has just reached, with its last tangent if
 * this is accurate. */
static status compliance_take(analysis_context *c, int analysis, const newton_run *n,
                              node_tangent *t, station_matrices *out, fault *f)
{
    const scene_compliance *what = scene_compliance_of(&c->scene->analysis[analysis]);
    double reaction[6];
    TRY(reaction_of(c, what, n->state, t, reaction, f));
    if (!newton_convergence_tangent_stands(&n->newton_convergence))
        TRY(tangent_at(c, what, n->state, reaction, t, f));
    else if (n->condensed != NULL)
        TRY(tangent_take_condensed(c, what, n->state, reaction, n->condensed, t, f));
    else
        TRY(tangent_take(c, what, n->state, reaction, t->border.count > 0 ? &n->whole : &n->K,
                         &n->K, n->factor, t, f));
    return matrices_of(c, what, reaction, t, wanted_columns(c, analysis), out, f);
}

static status matrices_alloc(solve_result *r, const scene_compliance *what, int stations,
                             nodal_matrices **out, fault *f)
{
    nodal_matrices *more = realloc(r->matrices, ((size_t)r->matrix_sets + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "a compliance");
    r->matrices = more;
    *out = &more[r->matrix_sets++];
    **out = (nodal_matrices){.node = what->node, .moments = what->moments};
    (*out)->path = calloc((size_t)stations + 1, sizeof *(*out)->path);
    (*out)->compliance = calloc((size_t)stations * 36 + 1, sizeof *(*out)->compliance);
    (*out)->stiffness = calloc((size_t)stations * 36 + 1, sizeof *(*out)->stiffness);
    return (*out)->path == NULL || (*out)->compliance == NULL || (*out)->stiffness == NULL
               ? fault_memory(f, "a compliance")
               : STATUS_OK;
}

/* Sets *state to the unloaded state, which is undeformed except for stress-free strains. */
static status unloaded(analysis_context *c, newton_run *n, const model_state **state, fault *f)
{
    step_record unused = {0};
    *state = kinematics_rest(c->model);
    if (linear_initial(c->model) == 0)
        return STATUS_OK;
    TRY(newton_alloc(c, 0, n, f));
    *state = n->state;
    return newton_to(n, 0, &unused, f);
}

static status compliance_solve(analysis_context *c, int analysis, node_tangent *t, newton_run *n,
                               outcome_compliance *out, fault *f)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    const scene_compliance *what = scene_compliance_of(a);
    const outcome_path *path =
        a->follows == SCENE_NONE ? NULL : outcome_path_of(&c->outcomes[a->follows]);
    const int reached = path != NULL ? path->reached : 1;
    const unsigned wanted = wanted_columns(c, analysis);
    outcome_path *o = &out->path;
    const model_state *alone = NULL;
    nodal_matrices *m = NULL;
    if (path == NULL)
        TRY(unloaded(c, n, &alone, f));
    o->stations = path != NULL ? path->stations : 1;
    TRY(tangent_alloc(c, what, NULL, t, f));
    TRY(matrices_alloc(c->result, what, o->stations, &m, f));
    out->matrix = m->compliance;
    o->value = calloc((size_t)o->stations + 1, sizeof *o->value);
    if (o->value == NULL)
        return fault_memory(f, "a compliance");
    for (int i = 0; i < reached; i++) {
        const model_state *s = path != NULL ? path->state[i] : alone;
        station_matrices at = {0};
        if (out->taken != NULL && out->taken[i].known)
            at = out->taken[i];
        else if (path == NULL || extract_path_needs(c, analysis, path->stations, path->value, i))
            TRY(compliance_at(c, what, s, t, wanted, &at, f));
        memcpy(m->compliance + 36 * (size_t)i, at.C, sizeof at.C);
        memcpy(m->stiffness + 36 * (size_t)i, at.K, sizeof at.K);
        o->value[i] = m->path[i] = path != NULL ? path->value[i] : 0;
        m->stations = ++o->reached;
    }
    return STATUS_OK;
}

status compliance_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    node_tangent t = {0};
    newton_run n = {0};
    analysis_context unloaded = context_unloaded(c);
    const int alone = c->scene->analysis[analysis].follows == SCENE_NONE;
    const status result =
        compliance_solve(alone ? &unloaded : c, analysis, &t, &n, &o->left.compliance, f);
    tangent_free(&t);
    newton_free(&n);
    return result;
}

typedef struct follower {
    int analysis;
    node_tangent tangent;
} follower;

struct compliance_walk {
    const scene_path *path;
    int count;
    follower of[];
};

static int follows(const analysis_context *c, int analysis, int path)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    return a->kind == SCENE_COMPLIANCE && a->follows == path && context_runs(c, analysis);
}

static status add(newton_run *n, int analysis, compliance_walk *w, fault *f)
{
    analysis_context *c = n->c;
    outcome_compliance *o = &c->outcomes[analysis].left.compliance;
    follower *of = &w->of[w->count++];
    of->analysis = analysis;
    TRY(tangent_alloc(c, scene_compliance_of(&c->scene->analysis[analysis]), n->condensed,
                      &of->tangent, f));
    if (of->tangent.border.count > 0 && n->condensed == NULL)
        TRY(newton_keep_driven(n, f));
    o->taken = calloc((size_t)w->path->stations + 1, sizeof *o->taken);
    return o->taken == NULL ? fault_memory(f, "a compliance") : STATUS_OK;
}

static status compliance_walk_begin(newton_run *n, int path, compliance_walk **out, fault *f)
{
    const scene *s = n->c->scene;
    int count = 0;
    *out = NULL;
    for (int i = 0; i < s->analyses; i++)
        count += follows(n->c, i, path);
    if (count == 0 || n->c->options->newton == NEWTON_DENSE || scene_rotates(&s->analysis[path]))
        return STATUS_OK;
    compliance_walk *w = calloc(1, sizeof *w + (size_t)count * sizeof w->of[0]);
    if (w == NULL)
        return fault_memory(f, "a compliance");
    *out = w;
    w->path = &scene_walk_of(&s->analysis[path])->path;
    for (int i = 0; i < s->analyses; i++)
        if (follows(n->c, i, path))
            TRY(add(n, i, w, f));
    return STATUS_OK;
}

status compliance_walk_take(compliance_walk *w, const newton_run *n, int station, fault *f)
{
    analysis_context *c = n->c;
    if (w == NULL ||
        (n->condensed == NULL && !newton_convergence_tangent_stands(&n->newton_convergence)))
        return STATUS_OK;
    for (int i = 0; i < w->count; i++) {
        follower *of = &w->of[i];
        if (!extract_path_needs(c, of->analysis, w->path->stations, w->path->value, station))
            continue;
        station_matrices *out = &c->outcomes[of->analysis].left.compliance.taken[station];
        fault why = {""};
        const status outcome = compliance_take(c, of->analysis, n, &of->tangent, out, &why);
        if (outcome == STATUS_FAULT)
            return fault_set(f, outcome, "%s", why.text);
        out->known = outcome == STATUS_OK;
    }
    return STATUS_OK;
}

void compliance_walk_end(compliance_walk *w)
{
    for (int i = 0; w != NULL && i < w->count; i++)
        tangent_free(&w->of[i].tangent);
    free(w);
}
