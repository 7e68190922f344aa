/* A straight cantilever of equal elements along x, solved with dense matrices, independently of the
 * harness. The root is clamped with warping restrained. */
#ifndef BEAMWORK_TEST_CHAIN_H
#define BEAMWORK_TEST_CHAIN_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/test/kit.h"

enum {
    CHAIN_MAX_ELEMENTS = 40,
    CHAIN_MAX_NODES = 81,
    CHAIN_MAX_INNER = 128,
    CHAIN_MAX_MEMORY = 2048
};

typedef struct chain {
    const element_type *type;
    double options[ELEMENT_MAX_OPTIONS], length;
    section section;
    unsigned features;
    int elements, per_element, nodes, coordinates, strains;
    int iterations;
    int held[7]; /* 1 if this coordinate of the tip is prescribed */
    union {
        double align;
        unsigned char bytes[1 << 16];
    } store;
    node_state x[CHAIN_MAX_NODES];
    double e[CHAIN_MAX_ELEMENTS][ELEMENT_MAX_STRAINS],
        sigma[CHAIN_MAX_ELEMENTS][ELEMENT_MAX_STRAINS];
    double inner[CHAIN_MAX_ELEMENTS][CHAIN_MAX_INNER];
} chain;

enum { CHAIN_MOST = ELEMENT_MAX_COORDINATES };

static int chain_start(chain *c, const element_type *type, const double option[], const section *s,
                       double length, int elements, unsigned features)
{
    fault f;
    memset(c, 0, sizeof *c);
    c->type = type;
    c->section = *s;
    c->features = features;
    c->elements = elements;
    c->length = length / elements;
    for (int i = 0; i < parameter_count(type->options); i++)
        c->options[i] = option != NULL ? option[i] : parameter_at(type->options, i)->value;
    c->per_element = element_nodes(type, c->options);
    c->strains = element_strains(type, c->options);
    c->coordinates = NODE_COORDINATES * c->per_element;
    c->nodes = elements * (c->per_element - 1) + 1;
    const element_request request = {
        .section = &c->section, .length = c->length, .features = features, .options = c->options};
    gsl_test(type->data_size(&request) > sizeof c->store || c->nodes > CHAIN_MAX_NODES ||
                 element_inner(type, c->options) > CHAIN_MAX_INNER ||
                 element_memory(type, c->options) > CHAIN_MAX_MEMORY,
             "%s: fits into the test's arrays", type->name);
    if (type->prepare(&request, (element_data *)c->store.bytes, &f) != STATUS_OK)
        return -1;
    nodes_straight(c->nodes, length, c->x);
    if (type->rest != NULL)
        for (int i = 0; i < elements; i++)
            type->rest((element_data *)c->store.bytes, c->inner[i]);
    return 0;
}

static const element_data *chain_data(const chain *c)
{
    return (const element_data *)c->store.bytes;
}

typedef struct chain_linearised {
    double J[ELEMENT_MAX_STRAINS * CHAIN_MOST], C[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS],
        sigma[ELEMENT_MAX_STRAINS], incompatibility[ELEMENT_MAX_STRAINS], memory[CHAIN_MAX_MEMORY];
} chain_linearised;

static void chain_linearise(const chain *c, int i, chain_linearised *w, double K[], double force[],
                            int *failures)
{
    const int n = c->strains, m = c->coordinates;
    double e[ELEMENT_MAX_STRAINS], more[ELEMENT_MAX_STRAINS],
        work[ELEMENT_MAX_STRAINS * CHAIN_MOST];
    c->type->strain(chain_data(c), &c->x[i * (c->per_element - 1)],
                    &(strain_output){.e = e, .J = w->J, .s = c->sigma[i], .H = K});
    *failures +=
        c->type->stress(chain_data(c), c->e[i], c->inner[i],
                        &(stress_output){.sigma = w->sigma, .C = w->C, .memory = w->memory}) !=
        STATUS_OK;
    for (int k = 0; k < n; k++)
        w->incompatibility[k] = e[k] - c->e[i][k];
    dense_mul_vec(n, n, w->C, w->incompatibility, more);
    for (int k = 0; k < n; k++)
        w->sigma[k] += more[k];
    dense_add_congruence(n, m, w->J, w->C, K, work);
    memset(force, 0, (size_t)m * sizeof *force);
    dense_add_transpose_mul(m, n, 1, w->J, w->sigma, force);
}

static void chain_assemble(const chain *c, chain_linearised *w, double *K, double *force,
                           int *failures)
{
    const int n = NODE_COORDINATES * (c->nodes - 1), m = c->coordinates;
    memset(K, 0, (size_t)(n * n) * sizeof *K);
    memset(force, 0, (size_t)n * sizeof *force);
    for (int e = 0; e < c->elements; e++) {
        double local[CHAIN_MOST * CHAIN_MOST], f[CHAIN_MOST];
        chain_linearise(c, e, &w[e], local, f, failures);
        const int first = NODE_COORDINATES * (e * (c->per_element - 1) - 1);
        for (int i = 0; i < m; i++) {
            if (first + i < 0)
                continue;
            force[first + i] += f[i];
            for (int j = 0; j < m; j++)
                if (first + j >= 0)
                    K[(first + i) * n + first + j] += local[i * m + j];
        }
    }
    if (!(c->features & FEATURE_WARPING))
        for (int i = 6; i < n; i += 7)
            K[i * (n + 1)] = 1;
}

static void chain_advance(chain *c, chain_linearised *w, const double dx[])
{
    const int n = c->strains, m = c->coordinates;
    for (int e = 0; e < c->elements; e++) {
        double local[CHAIN_MOST], de[ELEMENT_MAX_STRAINS], more[ELEMENT_MAX_STRAINS];
        const int first = NODE_COORDINATES * (e * (c->per_element - 1) - 1);
        for (int i = 0; i < m; i++)
            local[i] = first + i < 0 ? 0 : dx[first + i];
        dense_mul_vec(n, m, w[e].J, local, de);
        dense_mul_vec(n, n, w[e].C, de, more);
        for (int k = 0; k < n; k++) {
            c->sigma[e][k] = w[e].sigma[k] + more[k];
            de[k] += w[e].incompatibility[k];
            c->e[e][k] += de[k];
        }
        if (c->type->update != NULL)
            c->type->update(chain_data(c), de, w[e].memory, c->inner[e]);
    }
    nodes_move(c->nodes - 1, 1, dx, c->x + 1);
}

/* Solves by the mixed Newton iteration (N section 4). Prescribed coordinates of the tip move by
 * `step` [7]. A dead load [7], with moments about fixed axes, acts on the coordinates that are not
 * prescribed. Returns the size of the last correction, or INFINITY if an element or the tangent
 * failed. */
static double chain_solve(chain *c, const double step[7], const double load[7])
{
    const int n = NODE_COORDINATES * (c->nodes - 1), tip = n - NODE_COORDINATES;
    double *K = malloc((size_t)(n * n) * sizeof *K), *force = malloc((size_t)n * sizeof *force),
           size = 1;
    chain_linearised *w = malloc((size_t)c->elements * sizeof *w);
    int pivot[NODE_COORDINATES * CHAIN_MAX_NODES], failures = 0;
    for (c->iterations = 0; c->iterations < 40 && size > 1e-11; c->iterations++) {
        chain_assemble(c, w, K, force, &failures);
        for (int i = 0; i < n; i++)
            force[i] = (i >= tip ? load[i - tip] : 0) - force[i];
        for (int k = 0; k < 7; k++) {
            if (!c->held[k])
                continue;
            const double move = c->iterations == 0 ? step[k] : 0;
            for (int i = 0; i < n; i++) {
                force[i] -= K[i * n + tip + k] * move;
                K[i * n + tip + k] = K[(tip + k) * n + i] = 0;
            }
            K[(tip + k) * (n + 1)] = 1;
            force[tip + k] = move;
        }
        failures += dense_lu(n, K, pivot) != 0;
        dense_lu_solve(n, 1, K, pivot, force);
        chain_advance(c, w, force);
        size = 0;
        for (int i = 0; i < n; i++) {
            const double length = c->length * c->elements,
                         scale[7] = {length, length, length, 1, 1, 1, 1 / length};
            size = fmax(size, fabs(force[i]) / scale[i % 7]);
        }
    }
    free(K);
    free(force);
    free(w);
    return failures > 0 ? INFINITY : size;
}

static inline void chain_compliance(chain *c, double C[36])
{
    const int n = NODE_COORDINATES * (c->nodes - 1), tip = n - NODE_COORDINATES;
    double *K = malloc((size_t)(n * n) * sizeof *K), *force = malloc((size_t)n * sizeof *force),
           *X = calloc((size_t)n * 6, sizeof *X);
    chain_linearised *w = malloc((size_t)c->elements * sizeof *w);
    int pivot[NODE_COORDINATES * CHAIN_MAX_NODES], failures = 0;
    chain_assemble(c, w, K, force, &failures);
    /* a spatial moment m adds -1/2 m~ to the tangent in the exponential chart */
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        K[(tip + 3 + i) * n + tip + 3 + j] += force[tip + 3 + k] / 2;
        K[(tip + 3 + j) * n + tip + 3 + i] -= force[tip + 3 + k] / 2;
    }
    if (c->held[6])
        for (int i = 0; i < n; i++)
            K[(tip + 6) * n + i] = K[i * n + tip + 6] = i == tip + 6;
    for (int k = 0; k < 6; k++)
        X[(tip + k) * 6 + k] = 1;
    failures += dense_lu(n, K, pivot) != 0;
    gsl_test(failures, "%s: tip compliance evaluated", c->type->name);
    dense_lu_solve(n, 6, K, pivot, X);
    memcpy(C, &X[tip * 6], 36 * sizeof *C);
    free(K);
    free(force);
    free(X);
    free(w);
}

#endif
