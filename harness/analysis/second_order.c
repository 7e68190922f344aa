/* Linear models about states. Their inputs are those that the quantities of the scene name, and the
 * loads of the scene. Their outputs are those that the quantities name. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"

enum { MOST_COORDINATES = 1000 };

static status no_memory(fault *f)
{
    return fault_memory(f, "a state space");
}

static int same_input(const system_input *a, const system_input *b)
{
    return a->load == b->load && a->driver == b->driver && a->node == b->node &&
           a->component == b->component && a->reference == b->reference;
}

static int same_output(const scene_response *a, const scene_response *b)
{
    return a->node == b->node && a->component == b->component && a->from == b->from &&
           a->of == b->of;
}

static void add_input(system_matrices *s, const system_input *one)
{
    for (int i = 0; i < s->inputs; i++)
        if (same_input(&s->input[i], one))
            return;
    s->input[s->inputs++] = *one;
}

static void add_output(system_matrices *s, int quantity, const scene_response *as)
{
    for (int i = 0; i < s->outputs; i++)
        if (same_output(&s->output[i].as, as))
            return;
    s->output[s->outputs++] = (system_output){quantity, *as};
}

/* Lists the inputs and outputs of responses and displacements, then the loads and the feedback
 * references. */
status second_order_list(const scene *of, system_matrices *s, fault *f)
{
    s->input = calloc((size_t)of->quantities + 2 * (size_t)of->loads + 1, sizeof *s->input);
    s->output = calloc((size_t)of->quantities + 1, sizeof *s->output);
    if (s->input == NULL || s->output == NULL)
        return no_memory(f);
    for (int i = 0; i < of->quantities; i++) {
        const scene_extract *what = &of->quantity[i].what;
        scene_response as = what->of.response;
        if (what->kind == SCENE_COORDINATE) {
            const scene_component *c = scene_component_of(&of->quantity[i]);
            as = (scene_response){.node = c->node,
                                  .component = c->component,
                                  .from = SCENE_NONE,
                                  .driver = SCENE_NONE,
                                  .reference = SCENE_NONE,
                                  .unbalanced = SCENE_NONE};
        } else if (what->kind != SCENE_RESPONSE)
            continue;
        add_output(s, i, &as);
        for (int k = 0; k < 2 && what->kind == SCENE_RESPONSE && as.unbalanced != SCENE_NONE; k++)
            add_input(s, &(system_input){.load = SCENE_NONE,
                                         .driver = SCENE_NONE,
                                         .node = as.unbalanced,
                                         .component = scene_unbalance_along(&as, k)});
        if (what->kind == SCENE_RESPONSE && (as.driver != SCENE_NONE || as.forced != SCENE_NONE))
            add_input(s,
                      &(system_input){.load = SCENE_NONE,
                                      .driver = as.driver,
                                      .node = as.driver == SCENE_NONE ? as.forced : SCENE_NONE,
                                      .component = as.driver == SCENE_NONE ? as.forced_along : 0});
    }
    for (int i = 0; i < of->loads; i++)
        add_input(s, &(system_input){.load = i, .driver = SCENE_NONE, .node = SCENE_NONE});
    for (int i = 0; i < of->loads; i++)
        if (of->load[i].feedback.node != SCENE_NONE)
            add_input(s, &(system_input){
                             .load = i, .driver = SCENE_NONE, .node = SCENE_NONE, .reference = 1});
    return STATUS_OK;
}

/* Returns the position of each coordinate of the model in the linear model, [all]; -1: the
 * coordinate does not move. */
static int *positions(const vibration *v, const system_matrices *s)
{
    int *out = calloc((size_t)v->all + 1, sizeof *out), motions = 0;
    for (int i = 0; out != NULL && i < v->all; i++)
        out[i] = i < v->free ? i : -1;
    for (int i = 0; out != NULL && i < s->inputs; i++)
        if (s->input[i].driver != SCENE_NONE)
            out[model_driver_coordinate(v->c->model, s->input[i].driver)] = v->free + motions++;
    return out;
}

/* Adds the rows of the free coordinates of `a` to out[free x size]. at: positions. */
static void add_matrix(const vibration *v, const sparse *a, int skew, const int at[], int size,
                       double out[])
{
    for (int j = 0; j < v->all; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            if (i < v->free && at[j] >= 0)
                out[(size_t)i * (size_t)size + (size_t)at[j]] += a->value[k];
            if (a->symmetric && i != j && j < v->free && at[i] >= 0)
                out[(size_t)j * (size_t)size + (size_t)at[i]] += skew ? -a->value[k] : a->value[k];
        }
}

/* Adds row c of `a` to a row of `out`. at: positions. */
static void add_row(const vibration *v, const sparse *a, int skew, int c, const int at[],
                    double out[])
{
    for (int j = 0; j < v->all; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            if (i == c && at[j] >= 0)
                out[at[j]] += a->value[k];
            else if (a->symmetric && j == c && at[i] >= 0)
                out[at[i]] += skew ? -a->value[k] : a->value[k];
        }
}

/* Computes the forces of a unit input on all coordinates; zero for a motion or a reference
 * value. */
static void forces_of(const vibration *v, const system_input *in, double out[])
{
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    memset(out, 0, (size_t)v->all * sizeof *out);
    if (in->reference)
        return;
    if (in->load != SCENE_NONE) {
        const scene_load *load = &v->c->scene->load[in->load];
        loads_add_one(&v->c->eq, v->state, load, 1, out);
        loads_add_temperature(&v->c->eq, v->state, load, 1, out);
    } else if (in->driver == SCENE_NONE) {
        const int count =
            kinematics_node_jacobian(v->c->model, v->state, in->node, KINEMATICS_MOST, index, T);
        for (int k = 0; k < count; k++)
            out[index[k]] += T[in->component * count + k];
    }
}

static void add_motion(const vibration *v, int node, int component, double times, const int at[],
                       double out[])
{
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        if (at[index[k]] >= 0)
            out[at[index[k]]] += times * T[component * count + k];
}

static void fill_measured(const vibration *v, const system_matrices *s, const int at[],
                          second_order *m)
{
    const size_t N = (size_t)m->n + (size_t)m->motions;
    for (int l = 0; l < v->loops; l++)
        for (int i = 0; i < v->all; i++)
            for (int rate = 0; rate < 2 && at[i] >= 0; rate++)
                if (rate == 0 || v->loop[l].gains->derivative != 0)
                    m->L[rate][((size_t)s->outputs + 2 * (size_t)l + (size_t)rate) * N +
                               (size_t)at[i]] += v->loop[l].measured[i];
}

/* Adds C of the damping ratios, U U^T, which acts on the motion relative to the static motion of
 * the base. */
static void add_ratios(const vibration *v, const system_matrices *s, second_order *m, double r[])
{
    const double *U;
    const int more = harmonic_modes_damped(v->modes, &U), n = m->n, size = n + m->motions;
    for (int i = 0; i < more; i++)
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++)
                m->C[(size_t)j * (size_t)size + (size_t)k] +=
                    U[(size_t)i * (size_t)n + (size_t)j] * U[(size_t)i * (size_t)n + (size_t)k];
    for (int u = 0; u < s->inputs && more > 0; u++) {
        if (m->motion_of[u] < 0)
            continue;
        harmonic_modes_carried(v, model_driver_coordinate(v->c->model, s->input[u].driver), r);
        for (int i = 0; i < more; i++)
            for (int j = 0; j < n; j++)
                m->C[(size_t)j * (size_t)size + (size_t)(n + m->motion_of[u])] -=
                    U[(size_t)i * (size_t)n + (size_t)j] * r[i];
    }
}

static void add_ratios_to_reaction(const vibration *v, const system_matrices *s, second_order *m,
                                   int c, double L[], double r[])
{
    const double *U;
    const int more = harmonic_modes_damped(v->modes, &U), n = m->n;
    double *const own = r + more;
    if (more == 0)
        return;
    harmonic_modes_carried(v, c, own);
    for (int i = 0; i < more; i++)
        for (int k = 0; k < n; k++)
            L[k] -= own[i] * U[(size_t)i * (size_t)n + (size_t)k];
    for (int u = 0; u < s->inputs; u++) {
        if (m->motion_of[u] < 0)
            continue;
        harmonic_modes_carried(v, model_driver_coordinate(v->c->model, s->input[u].driver), r);
        for (int i = 0; i < more; i++)
            L[n + m->motion_of[u]] += own[i] * r[i];
    }
}

static status fill_output(const vibration *v, const sparse *G, const system_matrices *s, int y,
                          const int at[], second_order *m, double room[], fault *f)
{
    const scene_response *as = &s->output[y].as;
    const size_t N = (size_t)m->n + (size_t)m->motions;
    int c;
    TRY(harmonic_check_rates(v, as, f));
    if (as->of != SCENE_REACTING) {
        double *L = m->L[as->of] + (size_t)y * N; /* displacement, velocity, acceleration */
        add_motion(v, as->node, as->component, 1, at, L);
        if (as->from != SCENE_NONE)
            add_motion(v, as->from, as->component, -1, at, L);
        return STATUS_OK;
    }
    TRY(harmonic_reacting(v, as, &c, f));
    add_row(v, &v->K, 0, c, at, m->L[0] + (size_t)y * N);
    add_row(v, &v->M, 0, c, at, m->L[2] + (size_t)y * N);
    if (v->damped)
        add_row(v, &v->C, 0, c, at, m->L[1] + (size_t)y * N);
    if (G != NULL)
        add_row(v, G, 1, c, at, m->L[1] + (size_t)y * N);
    add_ratios_to_reaction(v, s, m, c, m->L[1] + (size_t)y * N, room);
    for (int u = 0; u < s->inputs; u++) {
        forces_of(v, &s->input[u], room);
        m->D[(size_t)y * (size_t)m->inputs + (size_t)u] -= room[c];
    }
    return STATUS_OK;
}

static status fill_model(const vibration *v, const sparse *G, const system_matrices *s,
                         const int at[], double room[], second_order *m, fault *f)
{
    const int size = m->n + m->motions;
    int motion = 0;
    add_matrix(v, &v->K, 0, at, size, m->K);
    add_matrix(v, &v->M, 0, at, size, m->M);
    if (v->damped)
        add_matrix(v, &v->C, 0, at, size, m->C);
    if (G != NULL)
        add_matrix(v, G, 1, at, size, m->C);
    for (int u = 0; u < s->inputs; u++) {
        m->motion_of[u] = s->input[u].driver != SCENE_NONE ? motion++ : -1;
        if (m->motion_of[u] >= 0) {
            const size_t row = (size_t)m->n + (size_t)m->motion_of[u];
            m->M[row * (size_t)size + row] = 1;
            m->B[row * (size_t)m->inputs + (size_t)u] = 1;
            continue;
        }
        forces_of(v, &s->input[u], room);
        for (int i = 0; i < m->n; i++)
            m->B[(size_t)i * (size_t)m->inputs + (size_t)u] = room[i];
    }
    add_ratios(v, s, m, room);
    for (int y = 0; y < s->outputs; y++)
        TRY(fill_output(v, G, s, y, at, m, room, f));
    fill_measured(v, s, at, m);
    return STATUS_OK;
}

status second_order_keep(const vibration *v, const sparse *G, const system_matrices *s,
                         state_matrices *to, fault *f)
{
    linear_model *const out = &to->model;
    int motions = 0;
    if (v->free > MOST_COORDINATES)
        return fault_set(f, STATUS_REFUSED,
                         "a state space of %d coordinates is too large (at most %d); use fewer "
                         "elements, or remove --state-space",
                         v->free, MOST_COORDINATES);
    for (int i = 0; i < s->inputs; i++)
        if (s->input[i].driver != SCENE_NONE) {
            TRY(harmonic_check_motion(v, s->input[i].driver, f));
            motions++;
        }
    second_order m = {0};
    int *at = positions(v, s);
    double *room = calloc(2 * (size_t)v->all + 1, sizeof *room);
    status outcome = at != NULL && room != NULL ? STATUS_OK : no_memory(f);
    if (outcome == STATUS_OK)
        outcome = second_order_alloc(v->free, motions, s->inputs, s->outputs + 2 * v->loops, &m, f);
    if (outcome == STATUS_OK)
        outcome = fill_model(v, G, s, at, room, &m, f);
    if (outcome == STATUS_OK)
        outcome = second_order_take(&m, s->outputs, out, f);
    if (outcome == STATUS_OK)
        outcome = second_order_state_space(v, s, &m, 0, out, f);
    if (outcome == STATUS_OK && v->c->options->reduce != NULL)
        outcome = second_order_keep_reduced(v, s, &m, &to->reduced, f);
    second_order_free(&m);
    free(room);
    free(at);
    return outcome;
}
