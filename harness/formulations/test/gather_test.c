/* Types that take many elements at once: their differences are, to the bit, those of the same type
 * that takes one after the other, and of failing states too. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/nodes.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"

enum { ELEMENTS = 5, GATHER_M = ELEMENT_MAX_STRAINS, GATHER_N = ELEMENT_MAX_COORDINATES };

static const element_type *gather_source;
static double gather_options[ELEMENT_MAX_OPTIONS];
static int requests, most; /* of many, and the largest */

static void note(int count)
{
    requests++;
    most = count > most ? count : most;
}

static void strain_many(int count, const element_data *const data[], const node_state x[],
                        strain_output out[])
{
    note(count);
    for (int i = 0; i < count; i++)
        gather_source->strain(data[i], x + i * element_nodes(gather_source, gather_options),
                              &out[i]);
}

/* An energy of the strains and its derivatives; none where the first node warps one way. */
static status force(const element_data *d, const node_state x[], force_output *out)
{
    double e[GATHER_M] = {0}, J[GATHER_M * GATHER_N], C[GATHER_M * GATHER_M] = {0},
           work[GATHER_M * GATHER_N];
    const int m = element_strains(gather_source, gather_options),
              n = NODE_COORDINATES * element_nodes(gather_source, gather_options);
    gather_source->strain(d, x, &(strain_output){.e = e, .J = J});
    if (x[0].a > 0)
        return STATUS_NOT_CONVERGED;
    for (int i = 0; i < m; i++)
        C[i * m + i] = 1 + i;
    if (out->energy != NULL)
        *out->energy = dense_quadratic(m, C, e) / 2;
    if (out->F != NULL) {
        memset(out->F, 0, (size_t)n * sizeof *out->F);
        for (int i = 0; i < m; i++)
            e[i] *= 1 + i;
        dense_add_transpose_mul(n, m, 1, J, e, out->F);
    }
    if (out->K != NULL) {
        memset(out->K, 0, (size_t)(n * n) * sizeof *out->K);
        dense_add_congruence(m, n, J, C, out->K, work);
    }
    return STATUS_OK;
}

static void force_many(int count, const element_data *const data[], const node_state x[],
                       force_output out[], status outcome[])
{
    note(count);
    for (int i = 0; i < count; i++)
        outcome[i] = force(data[i], x + i * element_nodes(gather_source, gather_options), &out[i]);
}

/* One type completed twice, and elements of it. */
typedef struct both {
    element_type given[2], type[2];
    element_data *data[2];
    const element_data *list[ELEMENTS];
    node_state x[ELEMENTS * ELEMENT_MAX_NODES];
    int nodes, m, n;
} both;

static void begin(both *b, element_type given)
{
    section_spec spec = sections_steel(SECTION_RECTANGLE);
    spec.width = 0.0367;
    spec.height = 0.0193;
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c,
                                     .length = 0.2385,
                                     .features = given.offers & FEATURE_SHEAR,
                                     .options = gather_options,
                                     .type = &b->given[0]};
    fault f = {""};
    for (int k = 0; k < 2; k++) {
        b->given[k] = given;
        if (given.force != NULL) {
            b->given[k].along = NULL;
            b->given[k].tension = NULL;
        }
        if (k == 1) {
            b->given[k].strain_many = given.strain != NULL ? strain_many : NULL;
            b->given[k].force_many = given.force != NULL ? force_many : NULL;
        }
        element_request own = request;
        own.type = &b->given[k];
        gsl_test(adapters_complete(&b->given[k], gather_options, &b->type[k], &f) != STATUS_OK,
                 "%s: completed: %s", gather_source->name, f.text);
        b->data[k] = calloc(1, b->type[k].data_size(&own));
        gsl_test(b->type[k].prepare(&own, b->data[k], &f) != STATUS_OK, "%s: prepared: %s",
                 gather_source->name, f.text);
    }
    b->nodes = element_nodes(&b->type[0], gather_options);
    b->m = element_strains(&b->type[0], gather_options);
    b->n = NODE_COORDINATES * b->nodes;
    for (int i = 0; i < ELEMENTS; i++) {
        double d[GATHER_N];
        nodes_increments(b->nodes, request.length, 0.4, (unsigned)i + 1, d);
        nodes_place(b->nodes, request.length, d, b->x + i * b->nodes);
        b->list[i] = b->data[1];
    }
    requests = most = 0;
}

static void end(both *b)
{
    free(b->data[0]);
    free(b->data[1]);
}

static void same(const both *b, const char *what, const double mine[], const double other[],
                 int count)
{
    gsl_test(memcmp(mine, other, (size_t)count * sizeof *mine) != 0, "%s: %s of many, to the bit",
             b->given[0].name, what);
}

/* J and H of all elements in one call, beside those of each. */
static void strains(unsigned leaves)
{
    both b;
    element_type given = *gather_source;
    static double e[2][ELEMENTS][GATHER_M], J[2][ELEMENTS][GATHER_M * GATHER_N],
        H[2][ELEMENTS][GATHER_N * GATHER_N], s[ELEMENTS][GATHER_M];
    strain_output out[ELEMENTS];
    given.leaves = leaves;
    begin(&b, given);
    for (int i = 0; i < ELEMENTS; i++) {
        for (int k = 0; k < b.m; k++)
            s[i][k] = 1 + sin(3.7 * k + i);
        out[i] = (strain_output){.e = e[1][i], .J = J[1][i], .s = s[i], .H = H[1][i]};
        b.type[0].strain(b.data[0], b.x + i * b.nodes,
                         &(strain_output){.e = e[0][i], .J = J[0][i], .s = s[i], .H = H[0][i]});
    }
    b.type[1].strain_many(ELEMENTS, b.list, b.x, out);
    for (int i = 0; i < ELEMENTS; i++) {
        same(&b, "e", e[1][i], e[0][i], b.m);
        same(&b, "J", J[1][i], J[0][i], b.m * b.n);
        same(&b, "H", H[1][i], H[0][i], b.n * b.n);
    }
    const int states = leaves & LEAVES_J ? 6 * b.n * ELEMENTS : 1;
    gsl_test(most < states || requests > 5, "%s: %d requests, the largest of %d states",
             gather_source->name, requests, most);
    end(&b);
}

/* Energy, stresses and stiffness. */
static void stresses(unsigned leaves)
{
    both b;
    element_type given = *gather_source;
    static double e[ELEMENTS][GATHER_M], sigma[2][ELEMENTS][GATHER_M],
        C[2][ELEMENTS][GATHER_M * GATHER_M];
    double energy[2][ELEMENTS];
    const double *at[ELEMENTS], *inner[ELEMENTS] = {NULL};
    stress_output out[ELEMENTS];
    status outcome[ELEMENTS];
    int failed = 0;
    given.leaves = leaves;
    given.strain = NULL;
    given.stress = NULL;
    given.force = force;
    begin(&b, given);
    for (int i = 0; i < ELEMENTS; i++) {
        b.type[0].strain(b.data[0], b.x + i * b.nodes, &(strain_output){.e = e[i]});
        at[i] = e[i];
        out[i] = (stress_output){.energy = &energy[1][i], .sigma = sigma[1][i], .C = C[1][i]};
    }
    b.type[1].stress_many(ELEMENTS, b.list, at, inner, out, outcome);
    for (int i = 0; i < ELEMENTS; i++) {
        const status alone = b.type[0].stress(
            b.data[0], e[i], NULL,
            &(stress_output){.energy = &energy[0][i], .sigma = sigma[0][i], .C = C[0][i]});
        gsl_test_int(outcome[i], alone, "%s: outcome of element %d", gather_source->name, i);
        failed += alone != STATUS_OK;
        if (alone != STATUS_OK)
            continue;
        same(&b, "energy", &energy[1][i], &energy[0][i], 1);
        same(&b, "stresses", sigma[1][i], sigma[0][i], b.m);
        same(&b, "stiffness", C[1][i], C[0][i], b.m * b.m);
    }
    gsl_test(failed == 0 || failed == ELEMENTS, "%s: %d of %d elements fail, some do",
             gather_source->name, failed, ELEMENTS);
    end(&b);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        gather_source = registry_formulations[i];
        parameter_defaults(gather_source->options, gather_options);
        strains(LEAVES_J);
        strains(LEAVES_H);
        stresses(LEAVES_FORCE);
        stresses(LEAVES_TANGENT);
        stresses(0);
    }
    return gsl_test_summary();
}
