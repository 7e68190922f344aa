#include "harness/newton/ahead.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

/* Bytes of an array, so that the next one is aligned. */
static size_t bytes(size_t count, size_t size)
{
    const size_t unit = _Alignof(max_align_t);
    return (count * size + unit - 1) / unit * unit;
}

static void *part(char **from, size_t count, size_t size)
{
    void *here = *from;
    *from += bytes(count, size);
    return here;
}

/* All arrays in one block. 0: no memory. */
static int allocate(const equations *eq)
{
    const model *m = eq->m;
    const size_t n = (size_t)model_elements(m), s = (size_t)model_strains(m),
                 c = (size_t)model_own_coordinates(m), nodes = (size_t)model_nodes(m),
                 memory = (size_t)model_memory(m);
    const size_t size = bytes(1, sizeof(run_ahead)) + 3 * bytes(n, sizeof(void *)) +
                        bytes(n * nodes, sizeof(node_state)) + bytes(n, sizeof(strain_output)) +
                        bytes(n, sizeof(stress_output)) + bytes(n, sizeof(status)) +
                        2 * bytes(n * s, sizeof(double)) + bytes(n * s * c, sizeof(double)) +
                        bytes(n * c * c, sizeof(double)) + bytes(n * s * s, sizeof(double)) +
                        bytes(n * memory, sizeof(double));
    char *block = eq->run->ahead == NULL ? malloc(size) : NULL;
    if (block == NULL)
        return eq->run->ahead != NULL;
    run_ahead *a = eq->run->ahead = part(&block, 1, sizeof *a);
    memset(a, 0, sizeof *a);
    a->data = part(&block, n, sizeof(void *));
    a->at = part(&block, n, sizeof(void *));
    a->inner = part(&block, n, sizeof(void *));
    a->x = part(&block, n * nodes, sizeof *a->x);
    a->strain = part(&block, n, sizeof *a->strain);
    a->stress = part(&block, n, sizeof *a->stress);
    a->outcome = part(&block, n, sizeof *a->outcome);
    a->e = part(&block, n * s, sizeof *a->e);
    a->sigma = part(&block, n * s, sizeof *a->sigma);
    a->J = part(&block, n * s * c, sizeof *a->J);
    a->H = part(&block, n * c * c, sizeof *a->H);
    a->C = part(&block, n * s * s, sizeof *a->C);
    a->memory = part(&block, n * memory, sizeof *a->memory);
    for (int i = 0; i < model_elements(m); i++)
        a->data[i] = model_kind_of(m, i)->data;
    return 1;
}

void ahead_strains(const equations *eq, const model_state *s, int what, const double sigma[])
{
    const model *m = eq->m;
    if (model_type(m)->strain_many == NULL || model_type(m)->lanes > 0 || model_elements(m) == 0 ||
        !allocate(eq))
        return;
    run_ahead *a = eq->run->ahead;
    const int n = model_strains(m), c = model_own_coordinates(m);
    for (int i = 0; i < model_elements(m); i++) {
        kinematics_gather(m, s, model_element(m, i), a->x + i * model_nodes(m));
        a->strain[i] = (strain_output){.e = what & AHEAD_E ? a->e + i * n : NULL,
                                       .J = what & AHEAD_J ? a->J + i * n * c : NULL,
                                       .s = what & AHEAD_H ? sigma + i * n : NULL,
                                       .H = what & AHEAD_H ? a->H + i * c * c : NULL};
    }
    model_type(m)->strain_many(model_elements(m), a->data, a->x, a->strain);
    a->what = what;
}

void ahead_stresses(const equations *eq, const double e[], const double inner[])
{
    const model *m = eq->m;
    if (model_type(m)->stress_many == NULL || model_type(m)->lanes > 0 || model_elements(m) == 0 ||
        !allocate(eq))
        return;
    run_ahead *a = eq->run->ahead;
    const int n = model_strains(m);
    if (e == NULL && !(a->what & AHEAD_E))
        return;
    for (int i = 0; i < model_elements(m); i++) {
        a->at[i] = (e != NULL ? e : a->e) + i * n;
        a->inner[i] = inner + i * model_inner(m);
        a->stress[i] =
            (stress_output){.sigma = a->sigma + i * n,
                            .C = a->C + i * n * n,
                            .memory = model_memory(m) > 0 ? a->memory + i * model_memory(m) : NULL};
    }
    model_type(m)->stress_many(model_elements(m), a->data, a->at, a->inner, a->stress, a->outcome);
    a->stresses = 1;
}

void ahead_end(const equations *eq)
{
    if (eq->run->ahead != NULL)
        eq->run->ahead->what = eq->run->ahead->stresses = 0;
}

static void copy(double *to, const double *from, int count)
{
    if (to != NULL)
        memcpy(to, from, (size_t)count * sizeof *to);
}

void ahead_copy_strain(const equations *eq, int i, const strain_output *out)
{
    const model *m = eq->m;
    const run_ahead *a = eq->run->ahead;
    const int n = model_strains(m), c = model_own_coordinates(m);
    copy(out->e, a->e + i * n, n);
    copy(out->J, a->J + i * n * c, n * c);
    if (out->s != NULL)
        copy(out->H, a->H + i * c * c, c * c);
}

status ahead_copy_stress(const equations *eq, int i, const stress_output *out)
{
    const model *m = eq->m;
    const run_ahead *a = eq->run->ahead;
    const int n = model_strains(m);
    copy(out->sigma, a->sigma + i * n, n);
    copy(out->C, a->C + i * n * n, n * n);
    copy(out->memory, a->memory + i * model_memory(m), model_memory(m));
    return a->outcome[i];
}
