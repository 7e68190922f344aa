#include "harness/newton/newton_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/real.h"

/* Smallest number of elements that one call evaluates faster than separate calls (measured for
 * sheets and collocation). Without AVX2, four lanes occupy two vectors, and separate calls are
 * always faster. */
enum { together_from_avx2 = 2, together_from_plain = CHUNK_MOST + 1 };

int chunk_size(const model *m)
{
    const element_type *t = model_type(m);
    if (t->lanes < 2 || t->strain_many == NULL)
        return 1;
    return t->lanes < CHUNK_MOST ? t->lanes : CHUNK_MOST;
}

int chunk_next(const model *m, int first, int end, unsigned char done[], int index[CHUNK_MOST])
{
    const int most = chunk_size(m);
    int count = 0, i = first;
    while (i < end && done[i - first])
        i++;
    for (int k = i; k < end && count < most; k++)
        if (!done[k - first] && model_element(m, k)->kind == model_element(m, i)->kind) {
            done[k - first] = 1;
            index[count++] = k;
        }
    return count;
}

static double *of_strains(const model *m, double *all, int element)
{
    return all + (size_t)element * (size_t)model_strains(m);
}

static const double *inner_of(const model *m, const model_state *s, int element)
{
    return &s->inner[(size_t)element * (size_t)model_inner(m)];
}

/* Returns the stresses of the state; NULL: they contain forces of dampers within the element, which
 * no function of the type computes. */
static const double *stresses_of(const equations *eq, const model_state *s, int element)
{
    return eq->run->damping == NULL ? of_strains(eq->m, s->sigma, element) : NULL;
}

static void strains_one_by_one(const equations *eq, const linear_memory *memory,
                               const model_state *s, int count, chunk_element element[],
                               double deformed[][ELEMENT_MAX_STRAINS])
{
    const model *m = eq->m;
    for (int k = 0; k < count; k++) {
        chunk_element *c = &element[k];
        const model_slot w = linearise_slot(m, memory, c->index);
        ahead_strain(eq, c->index, c->x,
                     &(strain_output){.e = deformed[k],
                                      .J = w.J,
                                      .s = c->K != NULL ? of_strains(m, s->sigma, c->index) : NULL,
                                      .H = c->K,
                                      .history = model_history_of(m, s, c->index)});
    }
}

static void stresses_one_by_one(const equations *eq, const linear_memory *memory,
                                const model_state *s, double path, int count,
                                chunk_element element[])
{
    const model *m = eq->m;
    for (int k = 0; k < count; k++) {
        const int i = element[k].index;
        const model_slot w = linearise_slot(m, memory, i);
        if (element[k].along.acts)
            continue;
        element[k].outcome = ahead_stress(
            eq, i, free_strain_data(eq, i, path), of_strains(m, s->e, i), inner_of(m, s, i),
            &(stress_output){.sigma = w.sigma,
                             .C = w.C,
                             .memory = model_memory(m) > 0 ? w.memory : NULL,
                             .history = model_history_of(m, s, i),
                             .state = stresses_of(eq, s, i)});
    }
}

static void strains_together(const model *m, const linear_memory *memory, const model_state *s,
                             int count, chunk_element element[],
                             double deformed[][ELEMENT_MAX_STRAINS])
{
    const element_data *data[CHUNK_MOST];
    node_state x[CHUNK_MOST * ELEMENT_MAX_NODES];
    strain_output out[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        const chunk_element *c = &element[k];
        data[k] = model_kind_of(m, c->index)->data;
        memcpy(x + k * model_nodes(m), c->x, (size_t)model_nodes(m) * sizeof *x);
        out[k] = (strain_output){.e = deformed[k],
                                 .J = linearise_slot(m, memory, c->index).J,
                                 .s = c->K != NULL ? of_strains(m, s->sigma, c->index) : NULL,
                                 .H = c->K,
                                 .history = model_history_of(m, s, c->index)};
    }
    model_type(m)->strain_many(count, data, x, out);
}

static void stresses_together(const equations *eq, const linear_memory *memory,
                              const model_state *s, int count, chunk_element element[])
{
    const model *m = eq->m;
    const element_data *data[CHUNK_MOST];
    const double *e[CHUNK_MOST], *inner[CHUNK_MOST];
    stress_output out[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    int own[CHUNK_MOST], owned = 0;
    for (int k = 0; k < count; k++) {
        const int i = element[k].index;
        const model_slot w = linearise_slot(m, memory, i);
        if (element[k].along.acts)
            continue;
        data[owned] = model_kind_of(m, i)->data;
        e[owned] = of_strains(m, s->e, i);
        inner[owned] = inner_of(m, s, i);
        out[owned] = (stress_output){.sigma = w.sigma,
                                     .C = w.C,
                                     .memory = model_memory(m) > 0 ? w.memory : NULL,
                                     .history = model_history_of(m, s, i),
                                     .state = stresses_of(eq, s, i)};
        own[owned++] = k;
    }
    if (owned > 0)
        model_type(m)->stress_many(owned, data, e, inner, out, outcome);
    for (int k = 0; k < owned; k++)
        element[own[k]].outcome = outcome[k];
}

static void stresses_under_loads(const equations *eq, const linear_memory *memory,
                                 const model_state *s, double path, int count,
                                 chunk_element element[])
{
    const model *m = eq->m;
    const element_data *data[CHUNK_MOST];
    node_state x[2 * CHUNK_MOST];
    along_output out[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    int own[CHUNK_MOST], owned = 0;
    for (int k = 0; k < count; k++) {
        chunk_element *c = &element[k];
        const model_slot w = linearise_slot(m, memory, c->index);
        if (!c->along.acts)
            continue;
        data[owned] = free_strain_data(eq, c->index, path);
        memcpy(x + (ptrdiff_t)2 * owned, c->x, 2 * sizeof *x);
        out[owned] = c->along.out;
        out[owned].e = of_strains(m, s->e, c->index);
        out[owned].inner = inner_of(m, s, c->index);
        out[owned].sigma = w.sigma;
        out[owned].C = w.C;
        out[owned].memory = w.memory;
        out[owned].mixed = w.along + SLOT_MIXED;
        out[owned].followed = w.along + slot_followed(m);
        out[owned].H = c->K != NULL ? c->along.H : NULL;
        own[owned++] = k;
    }
    if (owned == 0)
        return;
    model_type(m)->along(owned, data, x, out, outcome);
    for (int k = 0; k < owned; k++) {
        element[own[k]].along.out = out[k];
        memcpy(linearise_slot(m, memory, element[own[k]].index).along + SLOT_TURN, out[k].turn,
               sizeof out[k].turn);
        element[own[k]].outcome = outcome[k];
    }
}

static void equations_together(const model *m, const linear_memory *memory, const model_state *s,
                               int count, chunk_element element[])
{
    const element_data *data[CHUNK_MOST];
    const double *e[CHUNK_MOST], *inner[CHUNK_MOST], *sigma[CHUNK_MOST];
    node_state x[CHUNK_MOST * ELEMENT_MAX_NODES];
    equations_output out[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        chunk_element *c = &element[k];
        const model_slot w = linearise_slot(m, memory, c->index);
        data[k] = model_kind_of(m, c->index)->data;
        memcpy(x + k * model_nodes(m), c->x, (size_t)model_nodes(m) * sizeof *x);
        e[k] = of_strains(m, s->e, c->index);
        sigma[k] = of_strains(m, s->sigma, c->index);
        inner[k] = inner_of(m, s, c->index);
        out[k] = (equations_output){.J = w.J,
                                    .C = w.C,
                                    .memory = w.memory,
                                    .incompatibility = w.incompatibility,
                                    .sigma = w.sigma,
                                    .force = c->force,
                                    .present = c->present,
                                    .K = c->K};
        c->complete = 1;
    }
    model_type(m)->equations_many(count, data, x, e, inner, sigma, out, outcome);
    for (int k = 0; k < count; k++)
        element[k].outcome = outcome[k];
}

/* Computes sigma = stress(e) + C (D(x) - e), given the strains D(x). */
static void mix(const model *m, const linear_memory *memory, const model_state *s, int index,
                const double deformed[])
{
    const model_slot w = linearise_slot(m, memory, index);
    const double *e = of_strains(m, s->e, index);
    double more[ELEMENT_MAX_STRAINS];
    for (int i = 0; i < model_strains(m); i++)
        w.incompatibility[i] = deformed[i] - e[i];
    dense_mul_vec(model_strains(m), model_strains(m), w.C, w.incompatibility, more);
    for (int i = 0; i < model_strains(m); i++)
        w.sigma[i] += more[i];
}

static void damp(const equations *eq, const linear_memory *memory, const model_state *s, int index)
{
    const model *m = eq->m;
    const run_damping *d = eq->run->damping;
    const size_t n = (size_t)model_strains(m), first = (size_t)index * n;
    const double *V = run_damping_of(d, m, index);
    const model_slot w = linearise_slot(m, memory, index);
    double rate[ELEMENT_MAX_STRAINS], more[ELEMENT_MAX_STRAINS];
    if (V == NULL)
        return;
    for (size_t k = 0; k < n; k++)
        rate[k] = d->known[first + k] +
                  d->g * (s->e[first + k] + w.incompatibility[k] - d->from[first + k]);
    dense_mul_vec(model_strains(m), model_strains(m), V, rate, more);
    for (size_t k = 0; k < n; k++)
        w.sigma[k] += more[k];
    for (size_t k = 0; k < n * n; k++)
        w.C[k] += d->g * V[k];
}

void chunk_evaluate(const equations *eq, const linear_memory *memory, const model_state *s,
                    double path, int count, chunk_element element[])
{
    const model *m = eq->m;
    double deformed[CHUNK_MOST][ELEMENT_MAX_STRAINS];
    const int together = count >= REAL_CHOSEN(together_from) && chunk_size(m) > 1;
    for (int k = 0; k < count; k++) {
        kinematics_gather(m, s, model_element(m, element[k].index), element[k].x);
        element[k].complete = 0;
        element[k].along.acts = 0;
        if (model_takes_loads(m))
            distributed_take(eq, element[k].index, path, &element[k].along);
        if (model_takes_loads(m))
            linearise_slot(m, memory, element[k].index).along[SLOT_TAKES] = element[k].along.acts;
    }
    if (together && model_type(m)->equations_many != NULL && !eq->loading.rotates &&
        eq->run->damping == NULL && !model_takes_loads(m) && !model_frees(m)) {
        equations_together(m, memory, s, count, element);
        return;
    }
    if (together)
        strains_together(m, memory, s, count, element, deformed);
    else
        strains_one_by_one(eq, memory, s, count, element, deformed);
    if (together && model_type(m)->stress_many != NULL && eq->run->free_strain == NULL)
        stresses_together(eq, memory, s, count, element);
    else
        stresses_one_by_one(eq, memory, s, path, count, element);
    if (model_takes_loads(m))
        stresses_under_loads(eq, memory, s, path, count, element);
    for (int k = 0; k < count; k++)
        free_strain_subtract(eq, element[k].index, path, deformed[k]);
    for (int k = 0; k < count; k++)
        mix(m, memory, s, element[k].index, deformed[k]);
    for (int k = 0; k < count && eq->run->damping != NULL; k++)
        damp(eq, memory, s, element[k].index);
}

void chunk_second_derivatives(const equations *eq, const model_state *s, int count,
                              const int element[], node_state x[], double H[])
{
    const model *m = eq->m;
    const size_t size = (size_t)model_own_coordinates(m) * (size_t)model_own_coordinates(m);
    const element_data *data[CHUNK_MOST];
    strain_output out[CHUNK_MOST];
    int together = count > 1 && chunk_size(m) >= count;
    for (int k = 0; k < count; k++) {
        const int i = element[k];
        kinematics_gather(m, s, model_element(m, i), x + k * model_nodes(m));
        data[k] = model_kind_of(m, i)->data;
        together = together && model_element(m, i)->kind == model_element(m, element[0])->kind;
        out[k] = (strain_output){.s = of_strains(m, s->sigma, i),
                                 .H = H + (size_t)k * size,
                                 .history = model_history_of(m, s, i)};
    }
    if (together)
        model_type(m)->strain_many(count, data, x, out);
    else
        for (int k = 0; k < count; k++)
            ahead_strain(eq, element[k], x + k * model_nodes(m), &out[k]);
}
