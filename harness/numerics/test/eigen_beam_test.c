/* Eigenvalues compared with closed forms: buckling loads and frequencies of a simply supported beam
 * with 12 and 600 elements (within 1e-12) and 2000 elements (3e-9), and of strings of masses. Also:
 * values that a search misses, values lost in round-off, and functions that fail. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/eigen_problems.h"

typedef struct beam {
    int elements;
    double h;
    sparse K, G, M; /* G: geometric stiffness at unit tension */
} beam;

static void beam_init(beam *b, int elements)
{
    double k[16], g[16], m[16];
    b->elements = elements;
    b->h = 1.0 / elements;
    matrices_beam(b->h, k, g, m);
    b->K = matrices_chain(elements + 1, 2);
    b->G = matrices_chain(elements + 1, 2);
    b->M = matrices_chain(elements + 1, 2);
    matrices_add_elements(&b->K, elements, 2, 0, k);
    matrices_add_elements(&b->G, elements, 2, 0, g);
    matrices_add_elements(&b->M, elements, 2, 0, m);
    sparse *const all[] = {&b->K, &b->G, &b->M};
    for (int i = 0; i < 3; i++) {
        const int held[2] = {0, 2 * elements};
        for (int e = 0; e < 2; e++)
            for (int j = 0; j < all[i]->n; j++)
                for (int l = all[i]->column[j]; l < all[i]->column[j + 1]; l++)
                    if (all[i]->row[l] == held[e] || j == held[e])
                        all[i]->value[l] = all[i]->row[l] == j && i == 0 ? 1 / b->h : 0;
    }
}

static void beam_free(beam *b)
{
    matrices_free(&b->K);
    matrices_free(&b->G);
    matrices_free(&b->M);
}

static double beam_energy(void *context, const double x[])
{
    const beam *b = context;
    double sum = (x[0] * x[0] + x[2 * b->elements] * x[2 * b->elements]) / b->h;
    for (int i = 0; i < b->elements; i++) {
        const double left = i > 0 ? x[2 * i] : 0, right = i + 1 < b->elements ? x[2 * i + 2] : 0,
                     chord = (right - left) / b->h;
        const double p = x[2 * i + 1] - chord, q = x[2 * i + 3] - chord;
        sum += 4 / b->h * (p * p + p * q + q * q);
    }
    return sum;
}

/* Returns the eigenvalue mu of mode k of the discretised beam. With w = W sin(k pi j h) and slope S
 * cos(k pi j h) at node j, only the two unknowns W and S remain. The function is accurate only for
 * coarse meshes, because the relative rounding error of the determinants is eps/(k pi h)^4. */
static double mesh_value(const beam *b, int k, int vibration)
{
    double K[16], G[16], M[16], form[2][3];
    const double phase = k * PI * b->h;
    matrices_beam(b->h, K, G, M);
    const double *const both[] = {K, vibration ? M : G};
    for (int which = 0; which < 2; which++) {
        const double *e = both[which];
        form[which][0] = e[0] + e[10] + 2 * e[2] * cos(phase);
        form[which][1] = (e[6] - e[3]) * sin(phase);
        form[which][2] = e[5] + e[15] + 2 * e[7] * cos(phase);
    }
    /* the larger root of det(form[1] - mu form[0]) = 0 */
    const double *c = form[0], *d = form[1];
    const double p = c[0] * c[2] - c[1] * c[1], q = d[0] * c[2] + d[2] * c[0] - 2 * d[1] * c[1],
                 r = d[0] * d[2] - d[1] * d[1];
    return (q + sqrt(q * q - 4 * p * r)) / (2 * p);
}

/* Returns the expected buckling load or frequency of mode k. For at most 20 elements, it is
 * computed by mesh_value, otherwise from Euler's value (k pi)^2: the loads of the discretised beam
 * are larger by the relative difference (k pi h)^4/720, and its frequencies by half of this
 * difference. */
static double expected_value(const beam *b, int k, int vibration)
{
    if (b->elements <= 20)
        return vibration ? 1 / sqrt(mesh_value(b, k, 1)) : 1 / mesh_value(b, k, 0);
    return k * PI * k * PI * (1 + pow(k * PI * b->h, 4) / (vibration ? 1440 : 720));
}

static void compare(const beam *b, const eigen_side *found, int vibration, double allowed)
{
    const double rounding = 1e-15 + 1e-17 * b->elements * b->elements;
    for (int i = 0; i < found->count; i++) {
        const double exact = expected_value(b, i + 1, vibration),
                     value = 1 / (vibration ? sqrt(found->mu[i]) : found->mu[i]);
        const double actual = fabs(value / exact - 1);
        const char *what = vibration ? "frequency" : "load";
        gsl_test(!(actual < allowed), "%d elements: %s %d is off by %.1e (residual %.1e)",
                 b->elements, what, i + 1, actual, found->residual[i]);
        gsl_test(b->elements > 20 && !(actual < 3 * found->error[i] + rounding),
                 "%d elements: %s %d: estimated %.1e", b->elements, what, i + 1, found->error[i]);
    }
}

static void test_beam(int elements, double allowed)
{
    beam b;
    eigen_result r = {0};
    fault f = {""};
    enum { WANTED = 6 };
    beam_init(&b, elements);
    eigen_problem p = {.K = &b.K, .A = &b.G, .sign = 1, .largest = WANTED, .smallest = 2};
    p.K_energy = beam_energy;
    p.context = &b;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "column of %d elements: %s",
                 elements, f.text);
    gsl_test_int(r.positive.count, WANTED, "column of %d elements: buckling loads", elements);
    gsl_test_int(r.negative.count, 0, "column of %d elements: it does not buckle in tension",
                 elements);
    compare(&b, &r.positive, 0, allowed);
    eigen_free(&r);
    p.A = &b.M;
    p.smallest = 0;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "beam of %d elements: %s",
                 elements, f.text);
    compare(&b, &r.positive, 1, allowed);
    eigen_free(&r);
    beam_free(&b);
}

typedef struct corrupted {
    const sparse *K;
    double rounding;
} corrupted;

static double corrupted_energy(void *context, const double x[])
{
    return matrices_energy(((const corrupted *)context)->K, x);
}

static double corrupted_rounding(void *context, const double x[])
{
    return ((const corrupted *)context)->rounding * corrupted_energy(context, x);
}

static void corrupted_product(void *context, const double x[], double y[])
{
    sparse_mul(((const corrupted *)context)->K, x, y);
}

static void test_corrupted(double part)
{
    enum { ELEMENTS = 60, WANTED = 5 };
    beam b;
    sparse good = {0};
    eigen_result exact = {0}, r = {0};
    fault f = {""};
    beam_init(&b, ELEMENTS);
    eigen_problem p = {.K = &b.K, .A = &b.G, .sign = 1, .largest = WANTED};
    gsl_test_int((int)eigen_problems_solve(&p, &exact, &f), STATUS_OK, "column as it should be: %s",
                 f.text);
    gsl_test_int((int)sparse_alloc_like(&b.K, &good, &f), STATUS_OK, "copy");
    memcpy(good.value, b.K.value, (size_t)b.K.column[b.K.n] * sizeof *good.value);
    for (int j = 0; j < b.K.n; j++)
        for (int k = b.K.column[j]; k < b.K.column[j + 1]; k++)
            if (b.K.row[k] == j && j % 2 == 1)
                b.K.value[k] += part * 20 * b.h * (1 + 3.0 * j / b.K.n);
    corrupted context = {&good, 1e-4};
    p.K_energy = corrupted_energy;
    p.context = &context;
    for (int refined = 0; refined < 2; refined++) {
        p.K_product = refined ? corrupted_product : NULL;
        p.K_rounding = refined ? corrupted_rounding : NULL;
        const status outcome = eigen_problems_solve(&p, &r, &f);
        gsl_test(refined && outcome != STATUS_OK, "K spoilt by %g: %s", part, f.text);
        double worst = 0;
        for (int i = 0; i < r.positive.count; i++) {
            worst = fmax(worst, fabs(r.positive.mu[i] / exact.positive.mu[i] - 1));
            gsl_test(refined && !(r.positive.error[i] >= 1e-4 && r.positive.error[i] < 1.1e-4),
                     "the error that is told is that of the form and not of the matrix: %.2e",
                     r.positive.error[i]);
        }
        gsl_test_int(r.positive.count, WANTED, "all are found");
        gsl_test(refined ? !(worst < 1e-7) : part >= 1e-2 && worst < 1e-6,
                 "K spoilt by %g, %s: off by %.1e", part, refined ? "refined" : "as it is", worst);
        eigen_free(&r);
    }
    context.rounding = 0.5;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                 "no digit is left: %s", f.text);
    gsl_test(r.positive.count != WANTED || !isnan(r.positive.mu[0]), "and no value given");
    eigen_free(&r);
    eigen_free(&exact);
    sparse_free_values(&good);
    beam_free(&b);
}

static void eigen_beam_tests(void)
{
    test_corrupted(1e-4);
    test_corrupted(1e-2);
    test_corrupted(0.05);
    test_beam(12, 1e-12);
    test_beam(600, 1e-12);
    test_beam(2000, 3e-9);
}

static void test_missed_copies(void)
{
    enum { COPIES = 3, MASSES = 40, N = COPIES * MASSES };
    strings s;
    eigen_result work = {0};
    candidates p;
    double x[N] = {0}, all[COPIES * N] = {0};
    int missing = -1, above = -1;
    strings_init(&s, COPIES, MASSES, 0);
    eigen_problem e = {.K = &s.K,
                       .A = &s.M,
                       .sign = 1,
                       .largest = COPIES,
                       .K_energy = strings_energy,
                       .context = &s};
    gsl_test(factor_alloc(e.K, &e.K_factor, NULL) != STATUS_OK ||
                 factor_numeric(e.K_factor, e.K, NULL) != STATUS_OK ||
                 candidates_alloc(&p, &e, 1, NULL) != STATUS_OK,
             "strings are factorised");
    for (int c = 0; c < COPIES; c++)
        for (int i = 0; i < MASSES; i++)
            all[c * N + i * COPIES + c] = 1e5 * sin((i + 1) * PI / (MASSES + 1));
    for (int i = 0; i < MASSES;
         i++) /* the iteration starts from the second mode of the first string */
        x[i * COPIES] = sin(2 * (i + 1) * PI / (MASSES + 1));
    const double first = strings_exact(&s, 0), second = strings_exact(&s, COPIES);
    candidates_count_above(&p, sqrt(first * second), &above, &work, NULL);
    gsl_test_int(above, COPIES, "the inertia counts all copies");
    gsl_test(candidates_add(&p, 1, x, 0, NULL) != STATUS_OK ||
                 candidates_add(&p, 1, all, 0, NULL) != STATUS_OK,
             "candidates are taken in");
    gsl_test_rel(p.mu[0], first, 1e-14, "and sorted");
    gsl_test_rel(p.mu[1], second, 1e-14, "by size");
    gsl_test(candidates_count_missing(&p, 1, &missing, &work, NULL) != STATUS_OK || missing != 0,
             "the largest value is right with one copy");
    gsl_test_int((int)candidates_count_missing(&p, 2, &missing, &work, NULL), STATUS_OK,
                 "values that lie above the second one are counted");
    gsl_test_int(missing, COPIES - 1, "and two are missing");
    for (int copy = 1; copy < COPIES; copy++) {
        double *products = candidates_products(&p);
        lanczos_result found;
        const lanczos_problem rest = {.K = e.K,
                                      .A = e.A,
                                      .K_factor = e.K_factor,
                                      .sign = 1,
                                      .known = p.count,
                                      .KX = products,
                                      .certain = 1};
        gsl_test(lanczos_largest(&rest, 1, &found, NULL) != STATUS_OK || found.found != 1,
                 "Lanczos goes on where the candidates leave off");
        gsl_test_rel(found.scale, first, 1e-12, "its largest value is that of the next copy");
        gsl_test(candidates_take(&p, 1, found.x, 0, NULL) != STATUS_OK, "which is taken in");
        gsl_test_rel(p.mu[copy], first, 1e-12, "copy %d", copy + 1);
        free(products);
    }
    gsl_test(candidates_count_missing(&p, COPIES + 1, &missing, &work, NULL) != STATUS_OK ||
                 missing != 0,
             "now nothing is missing");
    const double apart = eigen_problems_departure(&s.K, p.count, p.x);
    gsl_test(!(apart < 1e-12), "candidates are orthonormal within %.1e", apart);
    gsl_test(candidates_add(&p, 1, all, 0, NULL) != STATUS_OK, "the same vector again");
    gsl_test_int((int)candidates_count_missing(&p, COPIES + 2, &missing, &work, NULL),
                 STATUS_NOT_CONVERGED, "counts too many");
    candidates_free(&p);
    factor_free(e.K_factor);
    strings_free(&s);
}

static void candidates_tests(void)
{
    test_missed_copies();
}

/* Data of a function that returns x^T A x, but fails for values of one sign within a range of
 * magnitudes. */
typedef struct broken {
    const sparse *A;
    double sign, least, most;
} broken;

static double broken_energy(void *context, const double x[])
{
    const broken *b = context;
    const double energy = matrices_energy(b->A, x), size = -b->sign * energy;
    return size > b->least && size < b->most ? NAN : energy;
}

static void test_sides_apart(void)
{
    enum { N = 800, WANTED = 4 };
    strings s;
    strings_init(&s, 1, N, 0);
    for (int i = N / 2; i < N; i++)
        matrices_add(&s.M, i, i, -2.5);
    for (int sign = -1; sign <= 1; sign += 2) {
        broken b = {&s.M, sign, 0, INFINITY};
        eigen_result alone = {0}, r = {0};
        fault f = {""};
        eigen_problem p = {.K = &s.K, .A = &s.M, .sign = sign, .largest = WANTED};
        gsl_test_int((int)eigen_problems_solve(&p, &alone, &f), STATUS_OK, "one side alone: %s",
                     f.text);
        p.smallest = WANTED;
        p.A_energy = broken_energy;
        p.context = &b;
        gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                     "the whole is no success");
        gsl_test_int((int)r.positive.status, STATUS_OK, "the side that can be found is found: %s",
                     r.positive.reason);
        gsl_test_int(r.positive.count, WANTED, "all of it");
        for (int i = 0; i < r.positive.count && i < alone.positive.count; i++)
            gsl_test_rel(r.positive.mu[i], alone.positive.mu[i], 1e-14,
                         "value %d is that of one side alone", i);
        gsl_test_int((int)r.negative.status, STATUS_NOT_CONVERGED, "the other one is not: %s",
                     r.negative.reason);
        gsl_test(r.negative.reason[0] == '\0' || strcmp(r.negative.reason, f.text) != 0,
                 "and says so: %s", f.text);
        gsl_test_int(r.negative.count, 0, "and gives none");
        eigen_free(&r);
        eigen_free(&alone);
    }
    strings_free(&s);
}

static void test_side_in_part(int lost)
{
    enum { N = 800, WANTED = 4 };
    strings s;
    strings_init(&s, 1, N, 0);
    for (int i = N / 2; i < N; i++)
        matrices_add(&s.M, i, i, -2.5);
    eigen_result all = {0}, r = {0};
    fault f = {""};
    eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED};
    gsl_test_int((int)eigen_problems_solve(&p, &all, &f), STATUS_OK, "both sides: %s", f.text);
    const double size = -all.negative.mu[lost];
    broken b = {&s.M, 1, size * (1 - 1e-3), size * (1 + 1e-3)};
    p.A_energy = broken_energy;
    p.context = &b;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                 "without value %d: no success", lost);
    gsl_test_int((int)r.negative.status, STATUS_NOT_CONVERGED, "without value %d: its side", lost);
    gsl_test_int(r.negative.count, lost, "without value %d: those before it", lost);
    for (int i = 0; i < r.negative.count; i++)
        gsl_test_rel(r.negative.mu[i], all.negative.mu[i], 1e-12, "without value %d: value %d",
                     lost, i);
    gsl_test_int(r.positive.count, WANTED, "without value %d: the other side", lost);
    eigen_free(&r);
    eigen_free(&all);
    strings_free(&s);
}

static double much(void *context, const double x[])
{
    (void)x;
    return *(const double *)context;
}

static void test_rounding(int masses)
{
    enum { WANTED = 3 };
    strings s;
    strings_init(&s, 1, masses, 0);
    for (int all = 0; all < 2; all++) {
        double size = all ? 1e9 : 1e-9;
        eigen_result r = {0};
        fault f = {""};
        eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED};
        p.A_rounding = much;
        p.context = &size;
        gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rounding of %g: %s", size,
                     f.text);
        gsl_test_int(r.positive.count, all ? 0 : WANTED, "rounding of %g: values that are more",
                     size);
        gsl_test(all != (r.positive.rounding > 0), "rounding of %g: the others are counted", size);
        gsl_test(all && r.factorisations > 0, "rounding of %g: nothing is searched for in it",
                 size);
        eigen_free(&r);
    }
    strings_free(&s);
}

static void eigen_lost_tests(void)
{
    test_sides_apart();
    for (int lost = 0; lost < 4; lost++)
        test_side_in_part(lost);
    test_rounding(40);
    test_rounding(120);
}

static void test_strings(int copies, int masses, double spread, int wanted, int iterate,
                         double allowed)
{
    strings s;
    eigen_result r = {0};
    fault f = {""};
    char name[80];
    snprintf(name, sizeof name, "%d strings of %d, springs %g apart, %d wanted, %s", copies, masses,
             spread, wanted, iterate ? "sparse" : "as it comes");
    strings_init(&s, copies, masses, spread);
    eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = wanted, .iterate = iterate};
    p.K_energy = strings_energy;
    p.context = &s;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "%s: %s", name, f.text);
    gsl_test_int(r.positive.count, wanted, "%s: all found", name);
    double worst = 0, residual = 0, error = 0;
    for (int i = 0; i < r.positive.count; i++) {
        worst = fmax(worst, fabs(r.positive.mu[i] / strings_exact(&s, i) - 1));
        residual = fmax(residual, r.positive.residual[i]);
        error = fmax(error, r.positive.error[i]);
    }
    gsl_test(!(worst < allowed), "%s: within %.1e", name, worst);
    gsl_test(!(residual < 1e-8), "%s: residuals below %.1e", name, residual);
    gsl_test(!(error < 1e-15), "%s: estimated errors below %.1e", name, error);
    const double apart = eigen_problems_departure(&s.K, r.positive.count, r.positive.mode);
    gsl_test(!(apart < 1e-9), "%s: modes orthonormal within %.1e", name, apart);
    eigen_free(&r);
    strings_free(&s);
}

static void compare_sides(const eigen_result *sparse_way, const eigen_result *dense_way, int wanted,
                          double tolerance, const char *what)
{
    const int found = sparse_way->positive.count >= wanted && sparse_way->negative.count >= wanted;
    gsl_test(!found, "%s: all are found", what);
    if (!found)
        return;
    for (int i = 0; i < wanted; i++) {
        gsl_test_rel(sparse_way->positive.mu[i], dense_way->positive.mu[i], tolerance,
                     "%s: positive value %d", what, i);
        gsl_test_rel(sparse_way->negative.mu[i], dense_way->negative.mu[i], tolerance,
                     "%s: negative value %d", what, i);
    }
}

static void test_both_signs(void)
{
    enum { NODES = 60, SIZE = 3, WANTED = 7 };
    uint64_t seed = 77;
    sparse K = matrices_chain(NODES, SIZE), A = matrices_chain(NODES, SIZE);
    for (int j = 0; j < K.n; j++)
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            A.value[k] = random_number(&seed);
            K.value[k] = K.row[k] == j ? 7 : random_number(&seed);
        }
    eigen_result sparse_way = {0}, again = {0}, dense_way = {0};
    fault f = {""};
    for (int sign = -1; sign <= 1; sign += 2) {
        eigen_problem p = {
            .K = &K, .A = &A, .sign = sign, .largest = WANTED, .smallest = WANTED, .iterate = 1};
        gsl_test_int((int)eigen_problems_solve(&p, &sparse_way, &f), STATUS_OK,
                     "indefinite, sparse: %s", f.text);
        gsl_test_int((int)eigen_problems_solve(&p, &again, &f), STATUS_OK, "indefinite, again: %s",
                     f.text);
        gsl_test(memcmp(again.positive.mode, sparse_way.positive.mode,
                        (size_t)K.n * WANTED * sizeof(double)) != 0,
                 "the same problem gives the same digits");
        p.largest = p.smallest = K.n;
        gsl_test_int((int)eigen_problems_solve(&p, &dense_way, &f), STATUS_OK,
                     "indefinite, dense: %s", f.text);
        gsl_test_int(dense_way.positive.count + dense_way.negative.count, K.n,
                     "all eigenvalues have a sign");
        compare_sides(&sparse_way, &dense_way, WANTED, 1e-13, "indefinite");
        eigen_free(&sparse_way);
        eigen_free(&again);
        eigen_free(&dense_way);
    }
    matrices_free(&K);
    matrices_free(&A);
}

static void test_coupled_strings(int masses)
{
    enum { WANTED = 3 };
    strings s;
    eigen_result sparse_way = {0}, dense_way = {0};
    fault f = {""};
    strings_init(&s, 2, masses, 0);
    sparse_zero(&s.M);
    for (int i = 1; i < masses; i++) {
        matrices_add(&s.M, 2 * (i - 1), 2 * i + 1, 1);
        matrices_add(&s.M, 2 * i, 2 * (i - 1) + 1, -1);
    }
    eigen_problem p = {
        .K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED, .iterate = 1};
    gsl_test_int((int)eigen_problems_solve(&p, &sparse_way, &f), STATUS_OK,
                 "coupled strings of %d, sparse: %s", masses, f.text);
    p.largest = p.smallest = s.K.n;
    gsl_test_int((int)eigen_problems_solve(&p, &dense_way, &f), STATUS_OK,
                 "coupled strings of %d, dense: %s", masses, f.text);
    compare_sides(&sparse_way, &dense_way, WANTED, 1e-12, "coupled strings");
    eigen_free(&sparse_way);
    eigen_free(&dense_way);
    strings_free(&s);
}

static void test_rank(int iterate)
{
    enum { MASSES = 150 };
    strings s;
    eigen_result r = {0};
    fault f = {""};
    strings_init(&s, 1, MASSES, 0);
    sparse_zero(&s.M);
    matrices_add(&s.M, 20, 20, 3);
    matrices_add(&s.M, 70, 70, 5);
    matrices_add(&s.M, 120, 120, -2);
    eigen_problem p = {
        .K = &s.K, .A = &s.M, .sign = 1, .largest = 4, .smallest = 4, .iterate = iterate};
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rank 3: %s", f.text);
    gsl_test_int(r.positive.count, 2, "rank 3: two positive values exist");
    gsl_test_int(r.negative.count, 1, "rank 3: one negative value exists");
    eigen_free(&r);
    sparse_zero(&s.M);
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rank 0: %s", f.text);
    gsl_test_int(r.positive.count + r.negative.count, 0, "rank 0: no value exists");
    eigen_free(&r);
    matrices_add(&s.K, 75, 75, -3);
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_REFUSED,
                 "an indefinite stiffness is refused: %s", f.text);
    eigen_free(&r);
    strings_free(&s);
}

static void eigen_tests(void)
{
    static const double spreads[] = {0, 1e-12, 1e-9, 1e-7, 1e-4, 0.01};
    for (size_t i = 0; i < sizeof spreads / sizeof spreads[0]; i++)
        for (int copies = 1; copies <= 6; copies += copies == 1 ? 1 : 2)
            for (int wanted = 1; wanted <= 13; wanted += 4)
                test_strings(copies, 60, spreads[i], wanted, 1,
                             spreads[i] < 1e-9 ? 1e-13 + copies * spreads[i] : 1e-13);
    test_strings(6, 12, 0, 13, 0, 1e-13);
    test_strings(1, 3000, 0, 12, 0, 1e-11);
    test_strings(3, 1000, 0, 12, 0, 1e-11);
    test_both_signs();
    test_coupled_strings(60);
    test_coupled_strings(61);
    test_rank(0);
    test_rank(1);
}

int main(void)
{
    eigen_beam_tests();
    candidates_tests();
    eigen_lost_tests();
    eigen_tests();
    return gsl_test_summary();
}
