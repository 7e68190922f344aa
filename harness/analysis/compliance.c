/* Compliance and stiffness of a node in a deformed state.  Prescribed motion that is released is
 * replaced by its reactions: dead forces, and moments of the analysis' convention. */
#include "harness/analysis/compliance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/analysis/extract_path.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* Loads whose response some quantity asks for. */
static unsigned wanted_columns(const analysis_context *c, int analysis)
{
    unsigned wanted = 0;
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (scene_asks(q, analysis, SCENE_COMPLIANCE_ENTRY) ||
            scene_asks(q, analysis, SCENE_STIFFNESS_ENTRY))
            wanted |= 1u << scene_entry_of(q)->column;
    }
    return wanted;
}

static void forget_columns(unsigned known, double C[36])
{
    for (int i = 0; i < 36; i++)
        if (!(known >> i % 6 & 1u))
            C[i] = NAN;
}

/* What is prescribed at the node exerts on it: force and moment [6]. The moment of a fork is that
 * of guides, which turn with the node: it is not of the convention's. */
static void reaction_of(const analysis_context *c, const scene_compliance *what,
                        const model_state *s, double reaction[6])
{
    double load[6];
    linearise_node_force(&c->eq, s, NULL, what->node, reaction);
    loads_at_node(&c->eq, s, kinematics_state_path(s), what->node, load);
    for (int i = 0; i < 6; i++)
        reaction[i] -= load[i];
    if (c->scene->node[what->node].rotation == SCENE_ROTATION_FORK)
        memset(reaction + 3, 0, 3 * sizeof *reaction);
}

/* From the tangent about the node; columns of C that nothing asks for, and with them K, are not
 * numbers. */
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
    forget_columns(wanted | held, out->C);
    forget_columns(0, out->K);
    return STATUS_OK;
}

static status compliance_at(analysis_context *c, const scene_compliance *what, const model_state *s,
                            node_tangent *t, unsigned wanted, station_matrices *out, fault *f)
{
    double reaction[6];
    reaction_of(c, what, s, reaction);
    TRY(tangent_at(c, what, s, reaction, t, f));
    return matrices_of(c, what, reaction, t, wanted, out, f);
}

status compliance_take(analysis_context *c, int analysis, const newton_run *n, node_tangent *t,
                       station_matrices *out, fault *f)
{
    const scene_compliance *what = scene_compliance_of(&c->scene->analysis[analysis]);
    double reaction[6];
    reaction_of(c, what, n->state, reaction);
    if (!arrival_tangent_stands(&n->arrival))
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
        return fault_set(f, STATUS_FAULT, "out of memory for a compliance");
    r->matrices = more;
    *out = &more[r->matrix_sets++];
    **out = (nodal_matrices){.node = what->node, .moments = what->moments};
    (*out)->path = calloc((size_t)stations + 1, sizeof *(*out)->path);
    (*out)->compliance = calloc((size_t)stations * 36 + 1, sizeof *(*out)->compliance);
    (*out)->stiffness = calloc((size_t)stations * 36 + 1, sizeof *(*out)->stiffness);
    return (*out)->path == NULL || (*out)->compliance == NULL || (*out)->stiffness == NULL
               ? fault_set(f, STATUS_FAULT, "out of memory for a compliance")
               : STATUS_OK;
}

/* The state without loads: undeformed, but for strains that members have by themselves. */
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

/* With what compliance_analysis frees; at the stations that the path has reached. */
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
        return fault_set(f, STATUS_FAULT, "out of memory for a compliance");
    for (int i = 0; i < reached; i++) {
        const model_state *s = path != NULL ? path->state[i] : alone;
        station_matrices at = {0};
        if (out->taken != NULL && out->taken[i].known)
            at = out->taken[i];
        else if (path == NULL || extract_path_wants(c, analysis, path->stations, path->value, i))
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
