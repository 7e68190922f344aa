/* Many elements at once have the bits of one at a time, with and without AVX2: of two kinds in
 * runs of any length, each in a state of its own. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "elements/beamw/lanes.h"
#include "elements/exact/lanes.h"
#include "elements/math/dense.h"
#include "elements/sheet/lanes.h"
#include "elements/test/nodes.h"
#include "elements/test/sections.h"

extern const element_type element_beamw, element_beamw_vlasov, element_beamw_first,
    element_beamw_consistent;
extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed, element_collocation,
    element_geometrically_exact;

typedef void strains_function(int count, const element_data *const data[], const node_state x[],
                              strain_output out[]);
typedef void stresses_function(int count, const element_data *const data[], const double *const e[],
                               const double *const inner[], stress_output out[], status outcome[]);

typedef void equations_function(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[]);

/* What a family exports beside the functions that its types choose for the processor. */
static const struct {
    const element_type *type;
    strains_function *strain;
    stresses_function *stress;
    equations_function *equations;
    double option[3]; /* the first ones */
} family[] = {
    {&element_beamw, beamw_lanes_modes_plain, beamw_lanes_modified_plain, NULL, {0}},
    {&element_beamw_vlasov, beamw_lanes_modes_plain, beamw_lanes_modified_plain, NULL, {0}},
    {&element_beamw_first, beamw_lanes_modes_plain, beamw_lanes_modified_plain, NULL, {0}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     NULL,
     {0}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     NULL,
     {0, 0, 1}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     NULL,
     {0, 1, 1}},
    {&element_sheet_second,
     sheet_lanes_strain_plain,
     sheet_lanes_second_plain,
     sheet_lanes_second_equations_plain,
     {0}},
    {&element_sheet_second_consistent,
     sheet_lanes_strain_plain,
     sheet_lanes_second_plain,
     sheet_lanes_second_equations_plain,
     {0}},
    {&element_sheet_third,
     sheet_lanes_strain_plain,
     sheet_lanes_third_plain,
     sheet_lanes_third_equations_plain,
     {0}},
    {&element_sheet_third_printed,
     sheet_lanes_strain_plain,
     sheet_lanes_third_plain,
     sheet_lanes_third_equations_plain,
     {0}},
    {&element_collocation,
     exact_lanes_stages_strain_plain,
     exact_lanes_stages_stress_plain,
     NULL,
     {2}},
    {&element_collocation,
     exact_lanes_stages_strain_plain,
     exact_lanes_stages_stress_plain,
     NULL,
     {5}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     NULL,
     {0}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     NULL,
     {1}},
};

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

static const double length[2] = {0.13, 0.31}; /* [m] */

static element_data *prepare(const element_type *type, const double option[], int kind,
                             unsigned features)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, 0.05, 0.0007);
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c,
                                     .length = length[kind],
                                     .features = features,
                                     .options = option,
                                     .curvature = {0, kind * 0.2, 0.3},
                                     .strain = {0, 0, kind * 1e-3}};
    fault f;
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, &f) != STATUS_OK, "%s: prepared", type->name);
    return d;
}

/* The strains wanted: e, J and H by the bits of what. */
static strain_output strain_of(const batch *b, int k, answers *a, int what)
{
    return (strain_output){.e = what & 1 ? a->e : NULL,
                           .J = what & 2 ? a->J : NULL,
                           .s = what & 4 ? b->weight[k] : NULL,
                           .H = what & 4 ? a->H : NULL};
}

static stress_output stress_of(const batch *b, answers *a, int what)
{
    return (stress_output){.energy = what & 1 ? &a->energy : NULL,
                           .sigma = what & 2 ? a->sigma : NULL,
                           .C = what & 4 ? a->C : NULL,
                           .residual = what & 1 ? &a->residual : NULL,
                           .memory = what & 4 && b->type->memory != NULL ? a->memory : NULL};
}

/* Elements [first, first + count) at once. */
static void strains(batch *b, strains_function *many, int first, int count, int what)
{
    strain_output out[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++)
        out[k] = strain_of(b, first + k, &together[k], what);
    many(count, b->data + first, b->x + first * b->nodes, out);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        strain_output one = strain_of(b, first + k, &alone, what);
        b->type->strain(b->data[first + k], b->x + (first + k) * b->nodes, &one);
        different += memcmp(&alone, &together[k], sizeof alone) != 0;
    }
    gsl_test_int(different, 0, "%s: elements of other strains, %d at once, wanted %d", b->name,
                 count, what);
}

static void stresses(batch *b, stresses_function *many, int first, int count, int what)
{
    stress_output out[MANY];
    const double *e[MANY] = {NULL}, *inner[MANY];
    status outcome[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++) {
        out[k] = stress_of(b, &together[k], what);
        e[k] = b->alone[first + k].e;
        inner[k] = b->inner[first + k];
    }
    many(count, b->data + first, e, inner, out, outcome);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        stress_output one = stress_of(b, &alone, what);
        const status ended = b->type->stress(b->data[first + k], e[k], inner[k], &one);
        different += ended != outcome[k] ||
                     (ended == STATUS_OK && memcmp(&alone, &together[k], sizeof alone) != 0);
    }
    gsl_test_int(different, 0, "%s: elements of other stresses, %d at once, wanted %d", b->name,
                 count, what);
}

/* Equations of one element. */
typedef struct whole {
    double J[S * X], C[S * S], incompatibility[S], sigma[S], force[X], present[X], K[X * X];
    status outcome;
} whole;

/* From its strains and stresses, by the sums of elements/math/dense.h. */
static void alone_of(const batch *b, int k, const double e[], int tangent, whole *out)
{
    const int n = b->strains, columns = NODE_COORDINATES * b->nodes;
    double more[S], work[S * X];
    memset(out, 0, sizeof *out);
    strain_output strain = {.e = out->incompatibility,
                            .J = out->J,
                            .s = tangent ? b->weight[k] : NULL,
                            .H = tangent ? out->K : NULL};
    stress_output stress = {.sigma = out->sigma, .C = out->C};
    b->type->strain(b->data[k], b->x + k * b->nodes, &strain);
    out->outcome = b->type->stress(b->data[k], e, NULL, &stress);
    for (int i = 0; i < n; i++)
        out->incompatibility[i] -= e[i];
    dense_mul_vec(n, n, out->C, out->incompatibility, more);
    for (int i = 0; i < n; i++)
        out->sigma[i] += more[i];
    dense_add_transpose_mul(columns, n, 1, out->J, out->sigma, out->force);
    dense_add_transpose_mul(columns, n, 1, out->J, b->weight[k], out->present);
    if (tangent)
        dense_add_congruence(n, columns, out->J, out->C, out->K, work);
}

/* Other numbers; zero has no sign here: that of a sum of nothing is anyone's. */
static int differs(const whole *a, const whole *b)
{
    const double *p = a->J, *q = b->J;
    int different = a->outcome != b->outcome;
    for (size_t i = 0; i < offsetof(whole, outcome) / sizeof *p && a->outcome == STATUS_OK; i++)
        different |= p[i] != q[i];
    return different;
}

static void equations(batch *b, equations_function *many, int first, int count, int tangent)
{
    equations_output out[MANY];
    const double *e[MANY], *s[MANY], *inner[MANY] = {NULL};
    double at[MANY][S];
    status outcome[MANY];
    static whole together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++) {
        whole *w = &together[k];
        for (int i = 0; i < b->strains; i++)
            at[k][i] = 0.93 * b->alone[first + k].e[i];
        e[k] = at[k];
        s[k] = b->weight[first + k];
        out[k] = (equations_output){.J = w->J,
                                    .C = w->C,
                                    .incompatibility = w->incompatibility,
                                    .sigma = w->sigma,
                                    .force = w->force,
                                    .present = w->present,
                                    .K = tangent ? w->K : NULL};
    }
    many(count, b->data + first, b->x + first * b->nodes, e, inner, s, out, outcome);
    for (int k = 0; k < count; k++) {
        together[k].outcome = outcome[k];
        alone_of(b, first + k, e[k], tangent, &alone);
        different += differs(&alone, &together[k]);
    }
    gsl_test_int(different, 0, "%s: elements of other equations, %d at once, tangent %d", b->name,
                 count, tangent);
}

static void compare_equations(batch *b, equations_function *many)
{
    for (int count = 1; count <= MANY && many != NULL; count++)
        for (int first = 0; first + count <= MANY; first++)
            for (int tangent = 0; tangent < 2; tangent++)
                equations(b, many, first, count, tangent);
}

static void compare(batch *b, strains_function *strain, stresses_function *stress)
{
    for (int what = 1; what < 8; what++)
        for (int count = 1; count <= MANY; count++)
            for (int first = 0; first + count <= MANY; first += 3) {
                if (strain != NULL)
                    strains(b, strain, first, count, what);
                if (stress != NULL)
                    stresses(b, stress, first, count, what);
            }
}

/* Kinds by turns: runs of 5, 1, 3 and 2; one element is far outside what can be evaluated. */
static void set_up(batch *b, unsigned features)
{
    static const int kind_of[MANY] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1};
    for (int kind = 0; kind < 2; kind++)
        b->kind[kind] = prepare(b->type, b->option, kind, features);
    for (int k = 0; k < MANY; k++) {
        double d[X], weights[X];
        const double size = k == 7 ? 40 : (k % 2 ? 0.3 : 0.003);
        b->data[k] = b->kind[kind_of[k]];
        nodes_increments(b->nodes, length[kind_of[k]], size, 71 + (unsigned)k, d);
        nodes_increments(b->nodes, 1, 2, 171 + (unsigned)k, weights);
        memcpy(b->weight[k], weights, sizeof b->weight[k][0] * (size_t)b->strains);
        nodes_place(b->nodes, length[kind_of[k]], d, b->x + k * b->nodes);
        if (b->type->rest != NULL)
            b->type->rest(b->data[k], b->inner[k]);
        for (int i = 0; i < element_inner(b->type, b->option); i++)
            b->inner[k][i] += 0.1 * size * sin(9.0 * i + k);
        strain_output out = {.e = b->alone[k].e};
        b->type->strain(b->data[k], b->x + k * b->nodes, &out);
    }
}

int main(void)
{
    const unsigned all = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_GEOMETRIC |
                         FEATURE_LARGE | FEATURE_CURVATURE,
                   features[] = {all, FEATURE_SHEAR | FEATURE_LARGE | FEATURE_WAGNER_TORQUE,
                                 all | FEATURE_WAGNER_TORQUE};
    for (size_t i = 0; i < sizeof family / sizeof family[0]; i++)
        for (int k = 0; k < 3; k++) {
            batch b = {.type = family[i].type, .name = family[i].type->name};
            memcpy(b.option, family[i].option, sizeof family[i].option);
            b.nodes = element_nodes(b.type, b.option);
            b.strains = element_strains(b.type, b.option);
            set_up(&b, features[k]);
            compare(&b, b.type->strain_many, b.type->stress_many);
            compare_equations(&b, b.type->equations_many);
            b.name = "without AVX2";
            compare(&b, family[i].strain, family[i].stress);
            compare_equations(&b, family[i].equations);
            free(b.kind[0]);
            free(b.kind[1]);
        }
    return gsl_test_summary();
}
