/* Compares J and H with sixth-order finite differences. */
#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

enum { M = TEST_ELEMENT_STRAINS, N = TEST_ELEMENT_COORDINATES };

/* allowed error, relative to the largest entry for the same strain */
static const double allowed = 1e-9;
static const char *const J_name = "J is the derivative of the strains",
                         *const H_name = "H is the second derivative of the strains";

static int strains_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    at->s->type.strain(at->s->data, x, &(strain_output){.e = values, .history = at->s->history});
    return 0;
}

static int jacobian_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    at->s->type.strain(at->s->data, x, &(strain_output){.J = values, .history = at->s->history});
    return 0;
}

static double largest(int n, const double a[])
{
    double out = 0;
    for (int i = 0; i < n; i++)
        out = fmax(out, fabs(a[i]));
    return out;
}

static void compare_J(const test_element *s, int strain, int c, double given, double found,
                      double size, check_result *one)
{
    char where[TEST_ELEMENT_WORDS];
    const double unit = test_element_unit(s, c);
    checks_deviation(one, size > 0 ? fabs(given - found) / size : fabs(given - found),
                     "J: the derivative of strain %d with respect to coordinate %d (%s) is %.6g, "
                     "but finite differences give %.6g; correct J or the strain%s",
                     strain + 1, c + 1, test_element_coordinate(s, c, where), given / unit,
                     found / unit, s->words);
}

static void check_J(const test_element *s, const node_state x[], check_result *one)
{
    const test_element_stencil at = {s, x};
    const int n = s->coordinates;
    double J[M * N], found[N][M];
    for (int c = 0; c < n; c++)
        stencil_first(strains_at, &at, s->strains, c, found[c]);
    s->type.strain(s->data, x, &(strain_output){.J = J, .history = s->history});
    for (int i = 0; i < s->strains; i++) {
        double row[N], differences[N];
        for (int c = 0; c < n; c++) {
            row[c] = J[i * n + c] * test_element_unit(s, c);
            differences[c] = found[c][i];
        }
        const double size = fmax(largest(n, row), largest(n, differences));
        for (int c = 0; c < n; c++)
            compare_J(s, i, c, row[c], differences[c], size, one);
    }
}

/* Compares H with the symmetric part of the derivative of J. The symmetric part corresponds to the
 * exponential chart. change[c]: change of J along coordinate c, per unit of the coordinate. */
static void compare_H(const test_element *s, int strain, const double H[],
                      const double change[][M * N], double size, check_result *one)
{
    const int n = s->coordinates;
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const double ub = test_element_unit(s, b), ua = test_element_unit(s, a);
            const double found =
                (change[a][strain * n + b] * ub + change[b][strain * n + a] * ua) / 2;
            const double given = H[a * n + b] * ua * ub;
            checks_deviation(
                one, checks_relative(fabs(given - found), size),
                "H: the second derivative of strain %d with respect to coordinates %d and %d (%s, "
                "%s) is %.6g, but finite differences of J give %.6g; correct H%s",
                strain + 1, a + 1, b + 1, test_element_coordinate(s, a, first),
                test_element_coordinate(s, b, other), H[a * n + b], found / (ua * ub), s->words);
        }
}

static void check_H(const test_element *s, const node_state x[], check_result *one)
{
    double change[N][M * N];
    const test_element_stencil at = {s, x};
    const int n = s->coordinates;
    double J[M * N], H[N * N], weight[M] = {0}, size = 0;
    s->type.strain(s->data, x, &(strain_output){.J = J, .history = s->history});
    for (int c = 0; c < n; c++)
        stencil_first(jacobian_at, &at, s->strains * n, c, change[c]);
    for (int i = 0; i < s->strains; i++)
        for (int c = 0; c < n; c++)
            size = fmax(size, fabs(J[i * n + c]) * test_element_unit(s, c));
    for (int i = 0; i < s->strains; i++) {
        memset(weight, 0, sizeof weight);
        weight[i] = 1;
        s->type.strain(s->data, x, &(strain_output){.s = weight, .H = H, .history = s->history});
        compare_H(s, i, H, (const double(*)[M * N]) change, size, one);
    }
}

static void check(const test_element *s, check_results *c)
{
    static const double sizes[] = {0, 0.3, 0.3};
    const unsigned leaves = s->made.given->leaves;
    for (unsigned k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        static const double turn[3] = {0.71, -1.93, 1.37};
        node_state x[ELEMENT_MAX_NODES], carried[ELEMENT_MAX_NODES];
        test_element_state(s, sizes[k], 7 + k, x);
        test_element_rigid_motion(s, turn, x, carried);
        const node_state *at = k == 1 ? carried : x;
        if (!(leaves & LEAVES_J)) {
            checks_current(c, "strain with J%s", s->words);
            check_J(s, at, checks_open(c, J_name, allowed));
        }
        if (!(leaves & (LEAVES_J | LEAVES_H)) &&
            checks_open(c, J_name, allowed)->outcome == CHECK_PASSED) {
            checks_current(c, "strain with H%s", s->words);
            check_H(s, at, checks_open(c, H_name, allowed));
        }
    }
}

void checks_derivatives(const formulation *chosen, check_results *out)
{
    const element_type *t = chosen->type;
    if (t->force != NULL) {
        checks_not_made(out, J_name, "the element provides forces instead of strains");
        return;
    }
    if (t->leaves & LEAVES_J)
        checks_not_made(out, J_name, "computed by differences");
    if (t->leaves & (LEAVES_J | LEAVES_H))
        checks_not_made(out, H_name, "computed by differences");
    if (!(t->leaves & LEAVES_J))
        test_elements_each(chosen, out, check);
    if (checks_open(out, J_name, allowed)->outcome == CHECK_FAILED)
        checks_not_made(out, H_name, "not checked until J is correct");
}

enum { MANY_M = TEST_ELEMENT_STRAINS, MANY_N = TEST_ELEMENT_COORDINATES, MANY = 5 };

static const double longer = 1.7 * 0.2385;
static const char *const check_name = "many elements at once give the same results as each alone";

typedef struct many_answers {
    status outcome;
    double e[MANY_M], J[MANY_M * MANY_N], H[MANY_N * MANY_N], energy, sigma[MANY_M],
        C[MANY_M * MANY_M];
} many_answers;

typedef struct many_batch {
    const test_element *of[MANY];
    const element_data *data[MANY];
    node_state x[MANY * ELEMENT_MAX_NODES];
    double weight[MANY_M], inner[TEST_ELEMENT_INNER];
    many_answers alone[MANY], together[MANY];
} many_batch;

static void gather(const test_element *s, const test_element *other, many_batch *b)
{
    const test_element *const order[MANY] = {s, s, other, s, other};
    memset(b, 0, sizeof *b);
    for (int k = 0; k < MANY; k++) {
        b->of[k] = order[k];
        b->data[k] = order[k]->data;
        test_element_state(order[k], 0.04, 91 + (unsigned)k, b->x + (ptrdiff_t)k * s->nodes);
    }
    for (int i = 0; i < s->strains; i++)
        b->weight[i] = cos(3.7 * i + 0.3);
    test_element_rest(s, b->inner);
}

static strain_output strain_of(const many_batch *b, int k, many_answers *a)
{
    const unsigned leaves = b->of[0]->made.given->leaves;
    strain_output out = {.e = a->e, .history = b->of[k]->history};
    if (!(leaves & LEAVES_J))
        out.J = a->J;
    if (!(leaves & (LEAVES_J | LEAVES_H))) {
        out.s = b->weight;
        out.H = a->H;
    }
    return out;
}

static stress_output many_stress_of(const many_batch *b, int k, many_answers *a)
{
    const unsigned leaves = b->of[0]->made.given->leaves;
    stress_output out = {.history = b->of[k]->history};
    if (!test_element_lacks_energy(b->of[k]))
        out.energy = &a->energy;
    if (!(leaves & LEAVES_FORCE))
        out.sigma = a->sigma;
    if (!(leaves & (LEAVES_FORCE | LEAVES_TANGENT)))
        out.C = a->C;
    return out;
}

static void differ(const many_batch *b, int k, const char *what, const char *entry, double alone,
                   double together, double size, check_result *one)
{
    checks_deviation(one, fabs(together - alone) / (size > 0 ? size : 1),
                     "many at once: the %s differ from those of single evaluations (element %d of "
                     "%d, %s: %.9g instead of %.9g); compute separate values for each element%s",
                     what, k + 1, MANY, entry, together, alone, b->of[k]->words);
}

static double many_largest(int count, const double v[])
{
    double out = 0;
    for (int i = 0; i < count; i++)
        out = fmax(out, fabs(v[i]));
    return out;
}

static void compare_strains(const many_batch *b, int k, check_result *one)
{
    const many_answers *a = &b->alone[k], *t = &b->together[k];
    const int n = b->of[k]->coordinates;
    const double l = b->of[k]->request.length;
    char what[TEST_ELEMENT_WORDS];
    for (int i = 0; i < b->of[k]->strains; i++) {
        snprintf(what, sizeof what, "strain %d", i + 1);
        differ(b, k, "strains", what, a->e[i], t->e[i], l, one);
        snprintf(what, sizeof what, "J of strain %d", i + 1);
        for (int j = 0; j < n; j++)
            differ(b, k, "strains", what, a->J[i * n + j], t->J[i * n + j],
                   l / test_element_unit(b->of[k], j), one);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            differ(b, k, "strains", "H", a->H[i * n + j], t->H[i * n + j],
                   l / (test_element_unit(b->of[k], i) * test_element_unit(b->of[k], j)), one);
}

static void strains(const test_element *s, many_batch *b, check_result *one)
{
    strain_output out[MANY];
    for (int k = 0; k < MANY; k++) {
        out[k] = strain_of(b, k, &b->alone[k]);
        s->type.strain(b->data[k], b->x + (ptrdiff_t)k * s->nodes, &out[k]);
    }
    if (s->type.strain_many == NULL)
        return;
    for (int k = 0; k < MANY; k++)
        out[k] = strain_of(b, k, &b->together[k]);
    s->type.strain_many(MANY, b->data, b->x, out);
    for (int k = 0; k < MANY; k++)
        compare_strains(b, k, one);
}

static void compare_stresses(const many_batch *b, int k, check_result *one)
{
    const many_answers *a = &b->alone[k], *t = &b->together[k];
    const int m = b->of[k]->strains;
    const double sigma = many_largest(m, a->sigma), C = many_largest(m * m, a->C);
    char what[TEST_ELEMENT_WORDS];
    checks_require(one, a->outcome == t->outcome,
                   "many at once: the status of element %d of %d is '%s', but '%s' if the element "
                   "is evaluated alone; return the same status%s",
                   k + 1, MANY, status_name(t->outcome), status_name(a->outcome), b->of[k]->words);
    if (a->outcome != STATUS_OK || t->outcome != STATUS_OK)
        return;
    differ(b, k, "energies", "energy", a->energy, t->energy, fabs(a->energy), one);
    for (int i = 0; i < m; i++) {
        snprintf(what, sizeof what, "sigma %d", i + 1);
        differ(b, k, "stresses", what, a->sigma[i], t->sigma[i], sigma, one);
    }
    for (int i = 0; i < m * m; i++)
        differ(b, k, "stresses", "C", a->C[i], t->C[i], C, one);
}

static void stresses(const test_element *s, many_batch *b, check_result *one)
{
    stress_output out[MANY];
    const double *e[MANY], *inner[MANY];
    status outcome[MANY];
    for (int k = 0; k < MANY; k++) {
        out[k] = many_stress_of(b, k, &b->alone[k]);
        e[k] = b->alone[k].e;
        inner[k] = b->inner;
        b->alone[k].outcome = s->type.stress(b->data[k], e[k], b->inner, &out[k]);
    }
    for (int k = 0; k < MANY; k++)
        out[k] = many_stress_of(b, k, &b->together[k]);
    s->type.stress_many(MANY, b->data, e, inner, out, outcome);
    for (int k = 0; k < MANY; k++) {
        b->together[k].outcome = outcome[k];
        compare_stresses(b, k, one);
    }
}

static void many_check(const test_element *s, check_results *c)
{
    static many_batch b;
    test_element other;
    test_element_request what = s->made;
    fault f = {""};
    if (s->type.strain_many == NULL && s->type.stress_many == NULL)
        return;
    check_result *one = checks_open(c, check_name, 1e-12);
    what.length = longer;
    if (test_element_make(&what, &other, &f) == STATUS_OK) {
        snprintf(other.words, sizeof other.words, "%s", s->words);
        gather(s, &other, &b);
        checks_current(c, "strain, one by one and many at once%s", s->words);
        strains(s, &b, one);
        checks_current(c, "stress, one by one and many at once%s", s->words);
        if (s->type.stress_many != NULL)
            stresses(s, &b, one);
    }
    test_element_free(&other);
}

void checks_many(const formulation *chosen, check_results *out)
{
    const element_type *t = chosen->type;
    if (t->strain_many == NULL && t->stress_many == NULL && t->force_many == NULL)
        checks_not_made(out, check_name, "the formulation evaluates one element at a time");
    else
        test_elements_each(chosen, out, many_check);
}
