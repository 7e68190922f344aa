/* The uncondensed system of N section 4: coordinates, strains and stresses of every element at
 * once, as a dense matrix.
 *   [ sum sigma H     0    J^T ] [dx    ]   [ f - J^T sigma ]
 *   [ J              -1    0   ] [de    ] = [ e - D(x)      ]
 *   [ 0              -C    1   ] [dsigma]   [ P'(e) - sigma ]
 * The published algorithm, kept as the baseline that speed is measured against. */
#include "harness/newton/uncondensed.h"
#include "cases/scene/names.h"

#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/distributed.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/loads.h"

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

/* Adds a coefficient of coordinate `column`: unknown, prescribed, or the unknown of a condition. */
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
    model_type(m)->strain(data, x, &(strain_output){.e = D, .J = J, .s = sigma, .H = H});
    const stress_output stresses = {.sigma = P, .C = C};
    status outcome;
    if (!model_takes_loads(m) || !distributed_stress(eq, state, x, i, path, &stresses, &outcome))
        outcome = model_type(m)->stress(data, e, &state->inner[(size_t)i * (size_t)model_inner(m)],
                                        &(stress_output){.sigma = P, .C = C});
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    if (outcome != STATUS_OK)
        return fault_set(f, outcome, "element %d of %s: outside what %s can evaluate", i,
                         scene_called(model_scene(m), SCENE_MEMBERS, el->member).text,
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

/* What loads add to the stiffness. */
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
    discrete_equations(m, state, d, &frame, force, K);
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
