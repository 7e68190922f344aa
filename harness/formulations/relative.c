/* Stresses of an element that is defined by its force or energy. The stresses are the derivatives
 * of the energy with respect to the relative positions of its nodes (formulations_impl.h). The
 * first node is at rest. */
#include "harness/formulations/formulations_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/formulations/adapted.h"

/* State at which finite differences of energies and forces are computed. */
typedef struct relative_place {
    const element_data *data;
    const double *e;
    const double *F;
    gather *together;
} relative_place;

static void moved(const relative_place *at, int i, double si, int j, double sj, double e[])
{
    memcpy(e, at->e, (size_t)at->data->strains * sizeof *e);
    e[i] += si * at->data->length;
    e[j] += sj * at->data->length;
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const relative_place *at = context;
    double e[PLACES_MOST];
    node_state x[ELEMENT_MAX_NODES];
    moved(at, i, si, j, sj, e);
    places_nodes(at->data, e, x);
    return (int)forces_of(at->data, at->together, x, &(force_output){.energy = values});
}

static status stresses_of(const relative_place *at, double energy[], double sigma[]);

static int stresses_at(const void *context, int i, double si, int j, double sj, double values[])
{
    double e[PLACES_MOST];
    relative_place there = *(const relative_place *)context;
    moved(context, i, si, j, sj, e);
    there.e = e;
    return (int)stresses_of(&there, NULL, values);
}

/* Computes B^T F for fixed F. */
static int carried_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const relative_place *at = context;
    const int m = at->data->strains;
    double e[PLACES_MOST], B[ELEMENT_MAX_COORDINATES * PLACES_MOST];
    moved(at, i, si, j, sj, e);
    places_motion(at->data, e, B);
    memset(values, 0, (size_t)m * sizeof *values);
    dense_add_transpose_mul(m, adapted_coordinates(at->data), 1, B, at->F, values);
    return 0;
}

static status energy_differences(const relative_place *at, double energy[], double sigma[])
{
    const element_data *d = at->data;
    double now;
    int outcome = energy_at(at, 0, 0, 0, 0, &now);
    if (energy != NULL)
        *energy = now;
    for (int i = 0; i < d->strains && outcome == 0 && sigma != NULL; i++) {
        outcome = stencil_first(energy_at, at, 1, i, &sigma[i]);
        sigma[i] /= d->length;
    }
    return (status)outcome;
}

static status stresses_of(const relative_place *at, double energy[], double sigma[])
{
    const element_data *d = at->data;
    if (d->given->leaves & LEAVES_FORCE)
        return energy_differences(at, energy, sigma);
    double F[ELEMENT_MAX_COORDINATES], B[ELEMENT_MAX_COORDINATES * PLACES_MOST];
    node_state x[ELEMENT_MAX_NODES];
    places_nodes(d, at->e, x);
    TRY(forces_of(at->data, at->together, x, &(force_output){.energy = energy, .F = F}));
    if (sigma == NULL)
        return STATUS_OK;
    places_motion(d, at->e, B);
    memset(sigma, 0, (size_t)d->strains * sizeof *sigma);
    dense_add_transpose_mul(d->strains, adapted_coordinates(d), 1, B, F, sigma);
    return STATUS_OK;
}

static void make_symmetric(int m, double C[])
{
    for (int i = 0; i < m; i++)
        for (int j = 0; j < i; j++)
            C[i * m + j] = C[j * m + i] = (C[i * m + j] + C[j * m + i]) / 2;
}

/* Adds df/de of a function f [strains] to C. */
static int add_columns(const element_data *d, stencil_function *f, const relative_place *at,
                       double C[])
{
    const int m = d->strains;
    double column[PLACES_MOST];
    int outcome = 0;
    for (int j = 0; j < m && outcome == 0; j++) {
        outcome = stencil_first(f, at, m, j, column);
        for (int i = 0; i < m && outcome == 0; i++)
            C[i * m + j] += column[i] / d->length;
    }
    return outcome;
}

/* Computes C = B^T K B + d(B^T F)/de, where F is constant in the second term. */
static status given_tangent(const relative_place *here, double C[])
{
    const element_data *d = here->data;
    const int n = adapted_coordinates(d), m = d->strains;
    double F[ELEMENT_MAX_COORDINATES], K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    double B[ELEMENT_MAX_COORDINATES * PLACES_MOST], work[ELEMENT_MAX_COORDINATES * PLACES_MOST];
    node_state x[ELEMENT_MAX_NODES];
    const relative_place at = {.data = d, .e = here->e, .F = F};
    places_nodes(d, here->e, x);
    TRY(forces_of(d, here->together, x, &(force_output){.F = F, .K = K}));
    places_motion(d, here->e, B);
    dense_add_congruence(n, m, B, K, C, work);
    return (status)add_columns(d, carried_at, &at, C);
}

static status second_energies(const element_data *d, const relative_place *at, double C[])
{
    const int m = d->strains;
    int outcome = 0;
    for (int i = 0; i < m; i++)
        for (int j = 0; j <= i && outcome == 0; j++) {
            outcome = stencil_second(energy_at, at, 1, i, j, &C[i * m + j]);
            C[i * m + j] /= d->length * d->length;
            C[j * m + i] = C[i * m + j];
        }
    return (status)outcome;
}

static status tangent_of(const relative_place *at, double C[])
{
    const element_data *d = at->data;
    memset(C, 0, (size_t)(d->strains * d->strains) * sizeof *C);
    if (d->given->leaves & LEAVES_FORCE)
        return second_energies(d, at, C);
    TRY(d->given->leaves & LEAVES_TANGENT ? (status)add_columns(d, stresses_at, at, C)
                                          : given_tangent(at, C));
    make_symmetric(d->strains, C);
    return STATUS_OK;
}

static status stress_at(const relative_place *at, stress_output *out)
{
    if (out->residual != NULL)
        *out->residual = 0;
    if (out->energy != NULL || out->sigma != NULL)
        TRY(stresses_of(at, out->energy, out->sigma));
    return out->C != NULL ? tangent_of(at, out->C) : STATUS_OK;
}

typedef struct relative_many {
    const element_data *const *data;
    const double *const *e;
    stress_output *out;
    status *outcome;
} relative_many;

static void stress_of_one(void *context, gather *together, int i)
{
    const relative_many *all = context;
    const relative_place at = {.data = all->data[i], .e = all->e[i], .together = together};
    all->outcome[i] = stress_at(&at, &all->out[i]);
}

static void evaluate_states(void *context, gather *g, int first, int count)
{
    const relative_many *all = context;
    forces_evaluate(all->data[0], g, first, count);
}

void relative_stress_many(int count, const element_data *const data[], const double *const e[],
                          const double *const inner[], stress_output out[], status outcome[])
{
    relative_many all = {data, e, out, outcome};
    (void)inner;
    if (count == 0)
        return;
    gather_run(count, data[0]->nodes, forces_size(data[0]), stress_of_one, evaluate_states, &all);
}

status relative_stress(const element_data *d, const double e[], const double inner[],
                       stress_output *out)
{
    const relative_place at = {.data = d, .e = e};
    status outcome;
    if (d->given->force_many == NULL)
        return stress_at(&at, out);
    relative_stress_many(1, &d, &e, &inner, out, &outcome);
    return outcome;
}

/* Computes e = C^-1 sigma and overwrites C. e is zero in directions without stiffness. */
static status flexible(int m, double C[], const double sigma[], double e[])
{
    int pivot[PLACES_MOST];
    double most = 0;
    for (int i = 0; i < m; i++)
        most = fmax(most, fabs(C[i * m + i]));
    memcpy(e, sigma, (size_t)m * sizeof *e);
    for (int i = 0; i < m; i++)
        if (fabs(C[i * m + i]) <=
            1e-14 * most) { /* inactive: warping strain of an element without warping */
            C[i * m + i] = most;
            e[i] = 0;
        }
    if (dense_lu(m, C, pivot) != 0)
        return STATUS_SINGULAR;
    dense_lu_solve(m, 1, C, pivot, e);
    return STATUS_OK;
}

/* Computes C at si units from the undeformed state, in the direction e. */
static int tangent_at(const void *context, int i, double si, int j, double sj, double values[])
{
    double e[PLACES_MOST];
    relative_place there = *(const relative_place *)context;
    (void)i;
    (void)j;
    for (int k = 0; k < there.data->strains; k++)
        e[k] = (si + sj) * there.e[k];
    there.e = e;
    return (int)tangent_of(&there, values);
}

typedef struct tangents {
    relative_many all;
    double *C;
    status outcome;
} tangents;

static void tangent_there(void *context, gather *together, int i)
{
    tangents *t = context;
    const relative_place at = {.data = t->all.data[i], .e = t->all.e[i], .together = together};
    t->outcome = tangent_of(&at, t->C);
}

static void tangent_change(void *context, gather *together, int i)
{
    tangents *t = context;
    const relative_place at = {.data = t->all.data[i], .e = t->all.e[i], .together = together};
    t->outcome =
        (status)stencil_first(tangent_at, &at, at.data->strains * at.data->strains, 0, t->C);
}

static status tangents_of(const element_data *d, const double e[], gather_element *what, double C[])
{
    tangents t = {.all = {.data = &d, .e = &e}, .C = C};
    if (d->given->force_many != NULL)
        gather_run(1, d->nodes, forces_size(d), what, evaluate_states, &t);
    else
        what(&t, NULL, 0);
    return t.outcome;
}

void relative_geometric(const element_data *d, const double sigma[], double G[])
{
    const int m = d->strains;
    const double rest[PLACES_MOST] = {0};
    double C[PLACES_MOST * PLACES_MOST], e[PLACES_MOST] = {0}, most = 0;
    status outcome = tangents_of(d, rest, tangent_there, C);
    memset(G, 0, (size_t)(m * m) * sizeof *G);
    if (outcome == STATUS_OK)
        outcome = flexible(m, C, sigma, e);
    for (int i = 0; i < m; i++)
        most = fmax(most, fabs(e[i]) / d->length);
    if (outcome == STATUS_OK && most > 0) {
        for (int i = 0; i < m; i++)
            e[i] /= most;
        outcome = tangents_of(d, e, tangent_change, G);
    }
    for (int i = 0; i < m * m; i++)
        G[i] = outcome == STATUS_OK ? most * G[i] : NAN;
}
