/* Newton's equations of many elements at once have the numbers of one at a time, with and without
 * AVX2. */
#include <stddef.h>

#include "elements/math/dense.h"
#include "elements/sheet/lanes.h"
#include "elements/test/lanes_batch.h"

extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed;

typedef void equations_function(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[]);

static const struct {
    const element_type *type;
    equations_function *equations; /* beside the one that the type chooses for the processor */
} family[] = {{&element_sheet_second, sheet_lanes_second_equations_plain},
              {&element_sheet_second_consistent, sheet_lanes_second_equations_plain},
              {&element_sheet_third, sheet_lanes_third_equations_plain},
              {&element_sheet_third_printed, sheet_lanes_third_equations_plain}};

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
    for (int count = 1; count <= MANY; count++)
        for (int first = 0; first + count <= MANY; first++)
            for (int tangent = 0; tangent < 2; tangent++)
                equations(b, many, first, count, tangent);
}

int main(void)
{
    for (size_t i = 0; i < sizeof family / sizeof family[0]; i++)
        for (int k = 0; k < BATCH_FEATURES; k++) {
            batch b = batch_of(family[i].type, NULL, 0, k);
            compare_equations(&b, b.type->equations_many);
            b.name = "without AVX2";
            compare_equations(&b, family[i].equations);
            batch_free(&b);
        }
    return gsl_test_summary();
}
