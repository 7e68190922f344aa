/* A frame that rotates at a constant rate: its effect on elements, and the matrices of small
 * motions in this frame (J Eq. 76). */
#include "harness/newton/newton_impl.h"

#include <string.h>

#include "cases/scene/scene.h"
#include "elements/field/field.h"
#include "elements/math/dense.h"

int rotating_frame_lumps(const equations *eq)
{
    return model_scene(eq->m)->lumped || eq->loading.lumps != LUMPS_NOTHING;
}

static status inertia_at(const equations *eq, const node_state x[], int i, double path,
                         inertia_output *out, fault *f)
{
    const model *m = eq->m;
    const element_rotating_frame frame = loading_frame(&eq->loading, path);
    const mesh_kind *kind = model_kind_of(m, i);
    const element_rotating_frame *turning = eq->loading.rotates ? &frame : NULL;
    status outcome;
    if (rotating_frame_lumps(eq)) {
        const lumped_mass whole =
            lumped_of(model_section(m, kind->section), model_features(m), kind->length);
        outcome =
            lumped_element(&whole, model_nodes(m), model_element(m, i)->share, x, turning, out);
        inertia_widen(NODE_COORDINATES * model_nodes(m), model_own_coordinates(m), out);
    } else {
        outcome = model_type(m)->inertia(kind->data, x, turning, out);
    }
    eq->run->counters.inertia_evaluations++;
    if (outcome == STATUS_REFUSED)
        return fault_set(f, outcome,
                         "formulation %s: its 'inertia' does not support %s; give mass: lumped, or "
                         "use another formulation",
                         model_formulation(m),
                         turning != NULL ? "rotating frames" : "this element");
    if (outcome != STATUS_OK)
        return fault_set(
            f, outcome,
            "element %d of %s: its inertia cannot be evaluated; use smaller steps or more elements",
            i, scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text);
    return STATUS_OK;
}

status rotating_frame_add(const equations *eq, const node_state x[], int i, double path,
                          double force[], double K[], fault *f)
{
    const model *m = eq->m;
    double centrifugal[ELEMENT_MAX_COORDINATES],
        N[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    if (!eq->loading.rotates)
        return STATUS_OK;
    TRY(inertia_at(eq, x, i, path,
                   &(inertia_output){.force = centrifugal, .N = K != NULL ? N : NULL}, f));
    for (int k = 0; k < model_own_coordinates(m); k++)
        force[k] -= centrifugal[k];
    if (K != NULL)
        for (int k = 0; k < model_own_coordinates(m) * model_own_coordinates(m); k++)
            K[k] += N[k];
    return STATUS_OK;
}

status rotating_frame_inertia(const equations *eq, const model_state *state, double path, sparse *M,
                              sparse *G, fault *f)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, path);
    const model *m = eq->m;
    const model_state *s = state != NULL ? state : kinematics_rest(m);
    const mesh_pattern *p = assemble_of(eq->run->patterns, M);
    double mass[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
        gyroscopic[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
    sparse_zero(M);
    if (G != NULL)
        sparse_zero(G);
    for (int i = 0; i < model_elements(m); i++) {
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, model_element(m, i), x);
        TRY(inertia_at(eq, x, i, path,
                       &(inertia_output){.M = mass, .G = G != NULL ? gyroscopic : NULL}, f));
        eliminate_matrix(m, s, model_element(m, i), NULL, mass);
        assemble_matrix(p, i, mass, M);
        if (G == NULL)
            continue;
        eliminate_matrix(m, s, model_element(m, i), NULL, gyroscopic);
        assemble_matrix(p, i, gyroscopic, G);
    }
    discrete_inertia(m, s, &frame, M, G);
    return STATUS_OK;
}

/* Transforms a vector from global axes to the axes of an element, which are the mean of the axes at
 * its ends. */
static void in_axes(const mesh_element *el, const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int i = 0; i < 3; i++)
            out[k] += (el->triad[0][3 * i + k] + el->triad[1][3 * i + k]) / 2 * v[i];
    }
}

double rotating_frame_inner(const model *m, const double x[])
{
    double sum = 0;
    for (int e = 0; e < model_elements(m); e++) {
        const mesh_element *el = model_element(m, e);
        const double *B = model_kind(m, el->kind)->inner;
        double local[ELEMENT_MAX_COORDINATES], own[FIELD_INNER];
        if (B == NULL)
            continue;
        kinematics_local(m, kinematics_rest(m), el, x, local);
        for (int node = 0; node < 2; node++) {
            const int at = NODE_COORDINATES * node;
            in_axes(el, local + at, own + at);
            in_axes(el, local + at + 3, own + at + 3);
            own[at + 6] = local[at + 6];
        }
        sum += dense_quadratic(FIELD_INNER, B, own);
    }
    return sum;
}

static void turn_inner(const mesh_element *el, const double B[], double out[])
{
    double T[FIELD_INNER * FIELD_INNER] = {0}, half[FIELD_INNER * FIELD_INNER];
    for (int at = 0; at < FIELD_INNER; at += NODE_COORDINATES) {
        for (int block = 0; block < 6; block += 3)
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++)
                    T[FIELD_INNER * (at + block + k) + at + block + i] =
                        (el->triad[0][3 * i + k] + el->triad[1][3 * i + k]) / 2;
        T[(FIELD_INNER + 1) * (at + 6)] = 1;
    }
    dense_mul(FIELD_INNER, FIELD_INNER, FIELD_INNER, B, T, half);
    dense_add_transpose_mul(FIELD_INNER, FIELD_INNER, FIELD_INNER, T, half, out);
}

int rotating_frame_inner_matrix(const equations *eq, sparse *out)
{
    const model *m = eq->m;
    const mesh_pattern *p = assemble_of(eq->run->patterns, out);
    int any = 0;
    sparse_zero(out);
    for (int e = 0; e < model_elements(m); e++) {
        const double *B = model_kind_of(m, e)->inner;
        double E[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        if (B == NULL)
            continue;
        memset(E, 0, FIELD_INNER * FIELD_INNER * sizeof *E);
        turn_inner(model_element(m, e), B, E);
        dense_widen(FIELD_INNER, model_own_coordinates(m), E);
        eliminate_matrix(m, kinematics_rest(m), model_element(m, e), NULL, E);
        assemble_matrix(p, e, E, out);
        any = 1;
    }
    return any;
}

void rotating_frame_load_stiffness(const equations *eq, const model_state *s, double path,
                                   sparse *out)
{
    sparse_zero(out);
    loads_subtract_stiffness(eq, s, path, out);
}

/* The uncondensed system of N section 4: coordinates, strains and stresses of every element at
 * once, as a dense matrix.
 *   [ sum sigma H     0    J^T ] [dx    ]   [ f - J^T sigma ]
 *   [ J              -1    0   ] [de    ] = [ e - D(x)      ]
 *   [ 0              -C    1   ] [dsigma]   [ P'(e) - sigma ] */

int uncondensed_size(const model *m)
{
    return model_unknowns(m) + 2 * model_strains(m) * model_elements(m);
}

typedef struct uncondensed {
    int size, conditions;
    double *A, *b; /* column-major */
    const double *drive;
    const model_condition *condition;
} uncondensed;

/* Adds a coefficient of the coordinate `column`, which is an unknown, a prescribed coordinate, or
 * an unknown driver. */
static void put(const model *m, uncondensed *s, int row, int column, double value)
{
    if (row < 0 || column < 0)
        return;
    for (int c = 0; c < s->conditions; c++)
        if (s->condition[c].unknown == column) {
            s->A[(size_t)(s->size - s->conditions + c) * (size_t)s->size + (size_t)row] += value;
            return;
        }
    if (column < model_unknowns(m))
        s->A[(size_t)column * (size_t)s->size + (size_t)row] += value;
    else
        s->b[row] -= value * s->drive[column];
}

static status add_element(const equations *eq, const model_state *state, int i, double path,
                          uncondensed *s, fault *f)
{
    const model *m = eq->m;
    enum { E = ELEMENT_MAX_STRAINS, X = MODEL_MAX_COORDINATES };
    const mesh_element *el = model_element(m, i);
    const element_data *data = model_kind(m, el->kind)->data;
    const int n = el->columns, strains = model_strains(m),
              first_e = model_unknowns(m) + strains * i,
              first_s = model_unknowns(m) + strains * (model_elements(m) + i);
    const double *e = &state->e[(size_t)i * (size_t)strains],
                 *sigma = &state->sigma[(size_t)i * (size_t)strains];
    double D[E], J[E * X], H[X * X], P[E], C[E * E], force[X] = {0}, along[X] = {0};
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, state, el, x);
    model_type(m)->strain(
        data, x,
        &(strain_output){
            .e = D, .J = J, .s = sigma, .H = H, .history = model_history_of(m, state, i)});
    free_strain_subtract(eq, i, path, D);
    const stress_output stresses = {.sigma = P, .C = C};
    status outcome;
    if (!model_takes_loads(m) || !distributed_stress(eq, state, x, i, path, &stresses, &outcome))
        outcome = model_type(m)->stress(
            free_strain_data(eq, i, path), e, &state->inner[(size_t)i * (size_t)model_inner(m)],
            &(stress_output){.sigma = P, .C = C, .history = model_history_of(m, state, i)});
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    if (outcome != STATUS_OK)
        return fault_set(f, outcome,
                         "element %d of %s: its state is outside the range that %s can evaluate; "
                         "use smaller steps or more elements",
                         i, scene_called(model_scene(m), SCENE_MEMBERS, el->member).text,
                         model_type(m)->name);
    dense_add_transpose_mul(model_own_coordinates(m), strains, 1, J, sigma, force);
    TRY(rotating_frame_add(eq, x, i, path, force, H, f));
    distributed_add(eq, state, x, i, path, along, H);
    for (int k = 0; k < model_own_coordinates(m); k++)
        force[k] -= along[k];
    eliminate_matrix(m, state, el, force, H);
    eliminate_forces(m, state, el, force);
    for (int a = 0; a < n; a++) {
        const int row = el->index[a] < model_unknowns(m) ? el->index[a] : NONE;
        if (row != NONE)
            s->b[row] -= force[a];
        for (int c = 0; c < n; c++)
            put(m, s, row, el->index[c], H[n * a + c]);
    }
    for (int k = 0; k < strains; k++) {
        double row[X];
        memcpy(row, J + model_own_coordinates(m) * k,
               (size_t)model_own_coordinates(m) * sizeof *row);
        eliminate_forces(m, state, el, row);
        s->b[first_e + k] += e[k] - D[k];
        s->b[first_s + k] += P[k] - sigma[k];
        s->A[(size_t)(first_e + k) * (size_t)s->size + (size_t)(first_e + k)] -= 1;
        s->A[(size_t)(first_s + k) * (size_t)s->size + (size_t)(first_s + k)] += 1;
        for (int c = 0; c < n; c++) {
            put(m, s, first_e + k, el->index[c], row[c]);
            if (el->index[c] >= 0 && el->index[c] < model_unknowns(m))
                s->A[(size_t)(first_s + k) * (size_t)s->size + (size_t)el->index[c]] += row[c];
        }
        for (int l = 0; l < strains; l++)
            s->A[(size_t)(first_e + l) * (size_t)s->size + (size_t)(first_s + k)] -=
                C[strains * k + l];
    }
    return STATUS_OK;
}

typedef struct load_part {
    const model *m;
    uncondensed *s;
} load_part;

static void put_load(void *context, int row, int column, double value)
{
    const load_part *part = context;
    put(part->m, part->s, row < model_unknowns(part->m) ? row : NONE, column, -value);
}

static void add_discrete(const equations *eq, const model_state *state, const mesh_discrete *d,
                         double path, uncondensed *s)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, path);
    const model *m = eq->m;
    const int n = d->el.columns;
    double force[ELEMENT_MAX_COORDINATES], K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    discrete_equations(m, state, d, &frame, NULL, force, K);
    for (int a = 0; a < n; a++) {
        const int row = d->el.index[a] < model_unknowns(m) ? d->el.index[a] : NONE;
        if (row != NONE)
            s->b[row] -= force[a];
        for (int c = 0; c < n; c++)
            put(m, s, row, d->el.index[c], K[n * a + c]);
    }
}

status uncondensed_system(const equations *eq, const model_state *state, double path,
                          const double drive[], int conditions, const model_condition condition[],
                          double A[], double b[], double load[], fault *f)
{
    const model *m = eq->m;
    uncondensed s = {uncondensed_size(m) + conditions, conditions, A, b, drive, condition};
    memset(A, 0, (size_t)s.size * (size_t)s.size * sizeof *A);
    memset(b, 0, (size_t)s.size * sizeof *b);
    memset(load, 0, (size_t)model_all_coordinates(m) * sizeof *load);
    loads_add_at_vertices(eq, state, path, load);
    memcpy(b, load, (size_t)model_unknowns(m) * sizeof *b);
    memset(load, 0, (size_t)model_all_coordinates(m) * sizeof *load);
    loads_add(eq, state, path, load);
    for (int i = 0; i < model_elements(m); i++) {
        TRY(add_element(eq, state, i, path, &s, f));
    }
    loads_stiffness_at_vertices(eq, state, path, put_load, &(load_part){m, &s});
    for (int i = 0; i < model_discretes(m); i++) {
        add_discrete(eq, state, model_discrete(m, i), path, &s);
    }
    for (int c = 0; c < conditions; c++) {
        const int row = s.size - conditions + c;
        A[(size_t)condition[c].coordinate * (size_t)s.size + (size_t)row] = 1;
        b[row] = condition[c].increment;
    }
    return STATUS_OK;
}
