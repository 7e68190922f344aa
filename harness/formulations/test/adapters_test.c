/* Forces and stiffness from finite differences must agree with those from the derivatives that the
 * formulations compute, within 1e-9. Many elements that are evaluated together must give the same
 * digits as single elements. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"

enum { M = ELEMENT_MAX_STRAINS, N = ELEMENT_MAX_COORDINATES };

typedef struct adapters_subject {
    element_type type;
    element_data *data;
    int nodes, strains, coordinates;
} adapters_subject;

static const double length = 0.2385;
static double options[ELEMENT_MAX_OPTIONS];

static void start(const element_type *given, const section *c, adapters_subject *out)
{
    fault f = {""};
    const unsigned features = given->offers & (FEATURE_SHEAR | FEATURE_WARPING | FEATURE_TRAPEZE |
                                               FEATURE_GEOMETRIC | FEATURE_LARGE);
    const element_request request = {
        .section = c, .length = length, .features = features, .options = options, .type = given};
    memset(out, 0, sizeof *out);
    gsl_test(adapters_complete(given, options, &out->type, &f) != STATUS_OK, "%s: completed: %s",
             given->name, f.text);
    out->nodes = element_nodes(&out->type, options);
    out->strains = element_strains(&out->type, options);
    out->coordinates = NODE_COORDINATES * out->nodes;
    out->data = calloc(1, out->type.data_size(&request));
    gsl_test(out->type.prepare(&request, out->data, &f) != STATUS_OK, "%s: prepared: %s",
             given->name, f.text);
}

static status assemble(const adapters_subject *s, const node_state x[], double *energy, double F[],
                       double K[])
{
    const int n = s->coordinates, m = s->strains;
    double e[M], J[M * N], sigma[M], C[M * M], work[M * N];
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J});
    TRY(s->type.stress(s->data, e, NULL,
                       &(stress_output){.energy = energy, .sigma = sigma, .C = C}));
    memset(F, 0, (size_t)n * sizeof *F);
    dense_add_transpose_mul(n, m, 1, J, sigma, F);
    s->type.strain(s->data, x, &(strain_output){.s = sigma, .H = K});
    dense_add_congruence(m, n, J, C, K, work);
    return STATUS_OK;
}

static adapters_subject source;

static status force_of_source(const element_data *d, const node_state x[], force_output *out)
{
    double energy, F[N], K[N * N];
    (void)d;
    TRY(assemble(&source, x, &energy, F, K));
    const size_t n = (size_t)source.coordinates;
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->F != NULL)
        memcpy(out->F, F, n * sizeof *F);
    if (out->K != NULL)
        memcpy(out->K, K, n * n * sizeof *K);
    return STATUS_OK;
}

/* Returns the largest difference relative to the largest entry. unit[]: factors that give all
 * entries the same dimension. */
static double departure(int n, const double a[], const double b[], const double unit[])
{
    double apart = 0, most = 0;
    for (int i = 0; i < n; i++) {
        apart = fmax(apart, fabs(a[i] - b[i]) * unit[i]);
        most = fmax(most, fabs(a[i]) * unit[i]);
    }
    return apart / most;
}

static void units(int rows, int columns, double out[])
{
    static const double power[NODE_COORDINATES] = {1, 1, 1, 0, 0, 0, -1};
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            out[i * columns + j] =
                pow(length, (rows > 1 ? power[i % NODE_COORDINATES] : 0) +
                                (columns > 1 || rows == 1 ? power[j % NODE_COORDINATES] : 0));
}

static void deformed(const adapters_subject *s, unsigned seed, node_state x[])
{
    double d[N];
    const double turn[3] = {0.7, -1.1, 0.4};
    nodes_increments(s->nodes, length, 0.1, seed, d);
    nodes_place(s->nodes, length, d, x);
    for (int k = 0; k < s->nodes; k++) {
        double r[3], axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        nodes_turn(x[k].R, turn);
        nodes_turn(axes, turn);
        mat3_mul_vec(axes, x[k].r, r);
        for (int i = 0; i < 3; i++) {
            x[k].u[i] += r[i] - x[k].r[i];
            x[k].r[i] = r[i];
        }
    }
}

static void compare(const adapters_subject *whole, const adapters_subject *part, const char *what,
                    double bound)
{
    const int n = whole->coordinates;
    double worst[3] = {0}, one[N], two[N * N];
    units(1, n, one);
    units(n, n, two);
    for (unsigned seed = 1; seed <= 5; seed++) {
        double energy[2], F[2][N], K[2][N * N];
        node_state x[ELEMENT_MAX_NODES];
        deformed(whole, seed, x);
        gsl_test(assemble(whole, x, &energy[0], F[0], K[0]) != STATUS_OK ||
                     assemble(part, x, &energy[1], F[1], K[1]) != STATUS_OK,
                 "%s, %s: has a state", whole->type.name, what);
        worst[0] = fmax(worst[0], fabs(energy[1] / energy[0] - 1));
        worst[1] = fmax(worst[1], departure(n, F[0], F[1], one));
        worst[2] = fmax(worst[2], departure(n * n, K[0], K[1], two));
    }
    gsl_test(!(worst[0] < 1e-12 && worst[1] < bound && worst[2] < bound),
             "%s, %s: energy, forces and stiffness agree (%.1e, %.1e, %.1e)", whole->type.name,
             what, worst[0], worst[1], worst[2]);
}

/* Computes the geometric stiffness [n x n] of linear buckling about the undeformed element,
 * prestressed by small motions v[n] of its nodes. Returns the axial force at the last node. */
static double prestressed(const adapters_subject *s, const double v[], double K[])
{
    const int n = s->coordinates, m = s->strains;
    const double none[N] = {0};
    double e[M], J[M * N], strain[M], sigma[M], C[M * M], G[M * M] = {0}, work[M * N];
    node_state x[ELEMENT_MAX_NODES];
    nodes_place(s->nodes, length, none, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J});
    dense_mul_vec(m, n, J, v, strain);
    gsl_test(s->type.stress(s->data, e, NULL, &(stress_output){.C = C}) != STATUS_OK, "at rest");
    dense_mul_vec(m, m, C, strain, sigma);
    s->type.strain(s->data, x, &(strain_output){.s = sigma, .H = K});
    if (s->type.geometric != NULL)
        s->type.geometric(s->data, sigma, G);
    dense_add_congruence(m, n, J, G, K, work);
    double F[N] = {0};
    dense_add_transpose_mul(n, m, 1, J, sigma, F);
    return F[n - NODE_COORDINATES];
}

static void twists_as(const adapters_subject *whole, const adapters_subject *part, const char *what,
                      double bound)
{
    const int n = whole->coordinates, last = n - NODE_COORDINATES;
    double v[N] = {0}, K[2][N * N], worst = 0;
    v[last] = 1e-3 * length;
    if (whole->nodes == 3)
        v[NODE_COORDINATES] = v[last] / 2;
    const double force = prestressed(whole, v, K[0]);
    prestressed(part, v, K[1]);
    for (int k = 0; k < whole->nodes; k++)
        worst = fmax(worst, fabs(K[1][3 * n + NODE_COORDINATES * k + 3] -
                                 K[0][3 * n + NODE_COORDINATES * k + 3]));
    gsl_test(!(worst < bound * force * length && force > 0),
             "%s, %s: geometric stiffness against twist agrees (%.1e of %.1e)", whole->type.name,
             what, worst, K[0][3 * n + 3]);
}

static void without(const element_type *given, const section *c, unsigned leaves, const char *what)
{
    element_type bare = *given;
    adapters_subject whole, part;
    bare.leaves = leaves;
    start(given, c, &whole);
    start(&bare, c, &part);
    compare(&whole, &part, what, 1e-9);
    free(whole.data);
    free(part.data);
}

static void loaded(const adapters_subject *s, double out[M + ELEMENT_ALONG_COORDINATES])
{
    const double none[N] = {0};
    const element_data *data = s->data;
    double force[3 * ELEMENT_ALONG_POINTS];
    node_state x[ELEMENT_MAX_NODES];
    along_output load = {.force = force, .sigma = out};
    status outcome = STATUS_FAULT;
    for (int i = 0; i < 3 * ELEMENT_ALONG_POINTS; i++)
        force[i] = 2.385 + i % 3;
    nodes_place(s->nodes, length, none, x);
    s->type.along(1, &data, x, &load, &outcome);
    gsl_test(outcome != STATUS_OK, "%s: takes a load", s->type.name);
    memcpy(out + M, load.ends, sizeof load.ends);
}

static void passes_on(const element_type *given, const section *c)
{
    const double sigma[M] = {2.385};
    double by[2][M + ELEMENT_ALONG_COORDINATES] = {{0}};
    element_type bare = *given;
    adapters_subject whole, part;
    bare.inertia = NULL;
    start(given, c, &whole);
    start(&bare, c, &part);
    gsl_test(part.type.equations_many != NULL, "%s: equations by strains and stresses",
             given->name);
    if (given->tension != NULL)
        gsl_test(part.type.tension(part.data, sigma) != whole.type.tension(whole.data, sigma),
                 "%s: tension", given->name);
    if (given->along != NULL) {
        loaded(&whole, by[0]);
        loaded(&part, by[1]);
        gsl_test(memcmp(by[0], by[1], sizeof by[0]) != 0, "%s: loads along", given->name);
    }
    free(whole.data);
    free(part.data);
}

static element_type by_force(const element_type *given, unsigned leaves)
{
    element_type out = *given;
    out.strain = NULL;
    out.stress = NULL;
    out.strains = NULL;
    out.geometric = NULL;
    out.along = NULL;
    out.tension = NULL;
    out.force = force_of_source;
    out.leaves = leaves;
    return out;
}

static void forces_only(const element_type *given, const section *c)
{
    static const struct {
        unsigned leaves;
        const char *what;
        double bound, buckling;
    } way[] = {{0, "force and tangent", 1e-10, 1e-9},
               {LEAVES_TANGENT, "force", 1e-9, 1e-9},
               {LEAVES_FORCE | LEAVES_TANGENT, "energy", 1e-9, 1e-7}};
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        const element_type bare = by_force(given, way[i].leaves);
        adapters_subject part;
        start(given, c, &source);
        start(&bare, c, &part);
        compare(&source, &part, way[i].what, way[i].bound);
        twists_as(&source, &part, way[i].what, way[i].buckling);
        free(part.data);
        free(source.data);
    }
}

static double no_tension(const element_data *d, const double sigma[])
{
    (void)d;
    return 0 * sigma[0];
}

static void refusals(const element_type *given)
{
    element_type completed, bad = *given;
    fault f;
    bad.force = force_of_source;
    gsl_test(adapters_complete(&bad, options, &completed, &f) != STATUS_REFUSED,
             "strains and a force: refused");
    bad = *given;
    bad.stress = NULL;
    gsl_test(adapters_complete(&bad, options, &completed, &f) != STATUS_REFUSED,
             "strains without stresses: refused");
    bad = by_force(given, 0);
    bad.tension = no_tension;
    gsl_test(adapters_complete(&bad, options, &completed, &f) != STATUS_REFUSED,
             "a tension of stresses that a force has not: refused");
    bad = *given;
    bad.prepare = NULL;
    gsl_test(adapters_complete(&bad, options, &completed, &f) != STATUS_REFUSED,
             "nothing of the section: refused");
}

static void adapters_tests(void)
{
    section_spec spec = section_spec_rectangle(210e9, 80.7e9, 0.0371, 0.0123);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    spec.density = 7850;
    const section c = sections_computed(&spec);
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *given = registry_formulations[i];
        element_type completed;
        fault f;
        parameter_defaults(given->options, options);
        gsl_test(adapters_complete(given, options, &completed, &f) != STATUS_OK ||
                     completed.strain != given->strain || adapters_words(given)[0] != '\0',
                 "%s: nothing is left out, nothing is made", given->name);
        passes_on(given, &c);
        if (element_inner(given, options) > 0)
            continue;
        without(given, &c, LEAVES_H, "without second derivatives");
        without(given, &c, LEAVES_J, "without derivatives");
        forces_only(given, &c);
    }
    refusals(registry_formulations[0]);
}

enum { ELEMENTS = 5, GATHER_M = ELEMENT_MAX_STRAINS, GATHER_N = ELEMENT_MAX_COORDINATES };

static const element_type *gather_source;
static double gather_options[ELEMENT_MAX_OPTIONS];
static int requests,
    most; /* calls for several elements, and largest number of elements in a call */

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

static void gather_tests(void)
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
}

int main(void)
{
    adapters_tests();
    gather_tests();
    return gsl_test_summary();
}
