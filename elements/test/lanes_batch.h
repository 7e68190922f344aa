/* Elements of two kinds in runs of any length, each in a state of its own: what is asked of many at
 * once and of each alone. */
#ifndef BEAMWORK_TEST_LANES_BATCH_H
#define BEAMWORK_TEST_LANES_BATCH_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/nodes.h"
#include "elements/test/sections.h"

enum { MANY = 11, S = ELEMENT_MAX_STRAINS, X = ELEMENT_MAX_COORDINATES, INNER = 24 };

/* All that one element gives, and what of it is asked for. */
typedef struct answers {
    double e[S], J[S * X], H[X * X], energy, sigma[S], C[S * S], residual, memory[INNER * S];
    status outcome;
} answers;

typedef struct batch {
    const element_type *type;
    const char *name;
    double option[ELEMENT_MAX_OPTIONS];
    int nodes, strains;
    element_data *kind[2];
    const element_data *data[MANY];
    node_state x[MANY * ELEMENT_MAX_NODES];
    double weight[MANY][S], inner[MANY][INNER];
    answers alone[MANY];
} batch;

static const double batch_length[2] = {0.13, 0.31}; /* [m] */

static inline element_data *batch_prepare(const element_type *type, const double option[], int kind,
                                          unsigned features)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, 0.05, 0.0007);
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c,
                                     .length = batch_length[kind],
                                     .features = features,
                                     .options = option,
                                     .curvature = {0, kind * 0.2, 0.3},
                                     .strain = {0, 0, kind * 1e-3}};
    fault f;
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, &f) != STATUS_OK, "%s: prepared", type->name);
    return d;
}

/* Kinds by turns: runs of 5, 1, 3 and 2; one element is far outside what can be evaluated. */
static inline void batch_set_up(batch *b, unsigned features)
{
    static const int kind_of[MANY] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1};
    for (int kind = 0; kind < 2; kind++)
        b->kind[kind] = batch_prepare(b->type, b->option, kind, features);
    for (int k = 0; k < MANY; k++) {
        double d[X], weights[X];
        const double size = k == 7 ? 40 : (k % 2 ? 0.3 : 0.003);
        b->data[k] = b->kind[kind_of[k]];
        nodes_increments(b->nodes, batch_length[kind_of[k]], size, 71 + (unsigned)k, d);
        nodes_increments(b->nodes, 1, 2, 171 + (unsigned)k, weights);
        memcpy(b->weight[k], weights, sizeof b->weight[k][0] * (size_t)b->strains);
        nodes_place(b->nodes, batch_length[kind_of[k]], d, b->x + k * b->nodes);
        if (b->type->rest != NULL)
            b->type->rest(b->data[k], b->inner[k]);
        for (int i = 0; i < element_inner(b->type, b->option); i++)
            b->inner[k][i] += 0.1 * size * sin(9.0 * i + k);
        strain_output out = {.e = b->alone[k].e};
        b->type->strain(b->data[k], b->x + k * b->nodes, &out);
    }
}

static inline void batch_free(batch *b)
{
    free(b->kind[0]);
    free(b->kind[1]);
}

/* The features that batches are set up with: by turns. */
enum { BATCH_FEATURES = 3 };
static inline unsigned batch_features(int turn)
{
    const unsigned all = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_GEOMETRIC |
                         FEATURE_LARGE | FEATURE_CURVATURE;
    return (const unsigned[]){all, FEATURE_SHEAR | FEATURE_LARGE | FEATURE_WAGNER_TORQUE,
                              all | FEATURE_WAGNER_TORQUE}[turn];
}

/* options: so many are given, the first ones. */
static inline batch batch_of(const element_type *type, const double option[], int options, int turn)
{
    batch b = {.type = type, .name = type->name};
    for (int i = 0; i < options; i++)
        b.option[i] = option[i];
    b.nodes = element_nodes(type, b.option);
    b.strains = element_strains(type, b.option);
    batch_set_up(&b, batch_features(turn));
    return b;
}

#endif
