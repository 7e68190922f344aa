/* Sparse factors of random matrices compared with LAPACK: solutions, inertia, sign of the
 * determinant and condition number. Also tests rejection of singular matrices, parallel loops, and
 * factors whose rows are computed in groups. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <ldl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "elements/math/dense.h"
#include "elements/math/real.h"
#include "elements/test/kit.h"
#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/matrices.h"

enum { MOST = 60 };

typedef enum kind { DEFINITE, INDEFINITE, UNSYMMETRIC } kind;

static void fill_random(int n, kind what, uint64_t *seed, double A[])
{
    memset(A, 0, (size_t)(n * n) * sizeof *A);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 4; k++) {
            const int j = (int)((random_number(seed) + 1) / 2 * n);
            const double value = random_number(seed);
            if (what == UNSYMMETRIC) {
                A[i * n + j] += value;
            } else if (i != j) {
                A[i * n + j] -= fabs(value);
                A[j * n + i] -= fabs(value);
                A[i * n + i] += fabs(value);
                A[j * n + j] += fabs(value);
            }
        }
    for (int i = 0; i < n; i++) {
        const double other = what == INDEFINITE ? 4 * random_number(seed) : 1;
        A[i * n + i] += what == DEFINITE ? 0.03 : other;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            A[i * n + j] *= (i % 3 == 0 ? 1e3 : 1) * (j % 3 == 0 ? 1e3 : 1);
}

/* Returns the largest difference between x and the solution of LAPACK, relative to the largest
 * component, in units of eps times the condition number of the scaled matrix. */
static double distance_from_dense(int n, const double A[], const double x[], const double b[])
{
    double copy[MOST * MOST] = {0}, dense[MOST], worst = 0, scale = 0, norm, condition;
    int pivot[MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            copy[i * n + j] = A[i * n + j] / ((i % 3 == 0 ? 1e3 : 1) * (j % 3 == 0 ? 1e3 : 1));
    norm = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, copy, n);
    for (int i = 0; i < n; i++)
        dense[i] = b[i] / (i % 3 == 0 ? 1e3 : 1);
    LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, 1, copy, n, pivot, dense, 1);
    LAPACKE_dgecon(LAPACK_ROW_MAJOR, '1', n, copy, n, norm, &condition);
    for (int i = 0; i < n; i++) {
        worst = fmax(worst, fabs(x[i] * (i % 3 == 0 ? 1e3 : 1) - dense[i]));
        scale = fmax(scale, fabs(dense[i]));
    }
    return worst / scale * condition / DBL_EPSILON;
}

static int negative_eigenvalues(int n, const double A[])
{
    double copy[MOST * MOST], w[MOST];
    int count = 0;
    memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', n, copy, n, w);
    for (int i = 0; i < n; i++)
        count += w[i] < 0;
    return count;
}

/* Returns the condition number of S A S in the 1-norm from its inverse, where S is diagonal with
 * the entries 1/sqrt(|a_ii|), or 1 if a_ii = 0. */
static double scaled_condition(int n, const double A[])
{
    double scaled[MOST * MOST] = {0}, norm[2];
    int pivot[MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double size = fabs(A[i * n + i] != 0 ? A[i * n + i] : 1) *
                                fabs(A[j * n + j] != 0 ? A[j * n + j] : 1);
            scaled[i * n + j] = A[i * n + j] / sqrt(size);
        }
    norm[0] = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, scaled, n);
    LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, scaled, n, pivot);
    LAPACKE_dgetri(LAPACK_ROW_MAJOR, n, scaled, n, pivot);
    norm[1] = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, scaled, n);
    return norm[0] * norm[1];
}

static int determinant_sign(int n, const double A[])
{
    double copy[MOST * MOST];
    int pivot[MOST], sign = 1;
    memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
    LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, copy, n, pivot);
    for (int i = 0; i < n; i++)
        sign = (pivot[i] != i + 1) != (copy[i * n + i] < 0) ? -sign : sign;
    return sign;
}

enum { SIDES = 7 };

/* Solves for several right-hand sides together and one at a time. Returns the number of solutions
 * that differ in any bit. */
static int apart_together(matrix_factor *fa, uint64_t *seed)
{
    enum { STRIDE = MOST + 2 };
    double together[SIDES * STRIDE], alone[SIDES * STRIDE];
    for (int i = 0; i < SIDES * STRIDE; i++)
        together[i] = alone[i] = random_number(seed);
    factor_solve_many(fa, SIDES, STRIDE, together);
    for (int c = 0; c < SIDES; c++)
        factor_solve(fa, alone + (size_t)c * STRIDE);
    int apart = 0;
    for (int i = 0; i < SIDES * STRIDE; i++)
        apart += !(together[i] == alone[i]);
    return apart;
}

static void random_matrices(kind what, const char *name, double allowed)
{
    uint64_t seed = 2385;
    double worst = 0, least_condition = INFINITY, most_condition = 0;
    int wrong_inertia = 0, wrong_sign = 0, failures = 0, most_negative = 0, apart = 0,
        wrong_work = 0;
    for (int sample = 0; sample < 40; sample++) {
        const int n = 2 + sample * (MOST - 2) / 39;
        double A[MOST * MOST], b[MOST], x[MOST];
        fill_random(n, what, &seed, A);
        sparse s = matrices_from_dense(n, what != UNSYMMETRIC, A);
        matrix_factor *fa;
        failures += factor_alloc(&s, &fa, NULL) != STATUS_OK;
        for (int turn = 0; turn < 2; turn++) {
            for (int k = 0; k < s.column[n]; k++)
                s.value[k] *= turn == 0 ? 1 : -0.3;
            for (int i = 0; i < n * n; i++)
                A[i] *= turn == 0 ? 1 : -0.3;
            const numerics_work start = numerics_work_done();
            failures += factor_numeric(fa, &s, NULL) != STATUS_OK;
            wrong_work += !(numerics_work_since(&start).factor_flops == factor_count(fa).flops);
            wrong_sign += factor_count(fa).determinant != determinant_sign(n, A);
            if (what != UNSYMMETRIC) {
                const int expected = negative_eigenvalues(n, A),
                          found = factor_count(fa).negative_pivots;
                wrong_inertia += found != expected;
                most_negative = found > most_negative ? found : most_negative;
            }
            const double condition = factor_condition(fa, &s) / scaled_condition(n, A);
            least_condition = fmin(least_condition, condition);
            most_condition = fmax(most_condition, condition);
            for (int i = 0; i < n; i++)
                b[i] = x[i] = random_number(&seed);
            factor_solve(fa, x);
            worst = fmax(worst, distance_from_dense(n, A, x, b));
            const numerics_work solved = numerics_work_done();
            apart += apart_together(fa, &seed);
            const numerics_work of_sides = numerics_work_since(&solved);
            wrong_work += of_sides.solutions != 2 * SIDES || of_sides.factor_flops > 0 ||
                          of_sides.solved_entries != 2.0 * SIDES * (double)factor_count(fa).entries;
        }
        gsl_test(factor_count(fa).entries < n || factor_count(fa).flops <= 0,
                 "%s matrix of %d: work is counted", name, n);
        factor_free(fa);
        matrices_free(&s);
    }
    gsl_test(!(least_condition > 0.3 && most_condition < 1 + 1e-9),
             "%s: the condition is estimated as %.2f to %.2f of what it is", name, least_condition,
             most_condition);
    gsl_test_int(failures, 0, "%s: all samples are factorised", name);
    gsl_test_int(wrong_work, 0, "%s: work of this thread", name);
    gsl_test_int(apart, 0, "%s: solutions made together are those made alone", name);
    gsl_test_int(wrong_sign, 0, "%s: the sign of the determinant", name);
    if (what != UNSYMMETRIC)
        gsl_test_int(wrong_inertia, 0,
                     "%s: negative pivots are the negative eigenvalues (up to %d)", name,
                     most_negative);
    gsl_test(!(worst < allowed), "%s: as LAPACK within %.1f eps times the condition", name, worst);
}

static void condition_of_a_triangle(void)
{
    enum { N = 6 };
    int column[N + 1] = {0}, row[3 * N], whole_column[N + 1] = {0}, whole_row[3 * N];
    double value[3 * N], whole_value[3 * N], dense[N * N] = {0}, inverse[N * N] = {0},
                                                       norm[2] = {0};
    int count = 0, whole = 0, pivot[N];
    for (int j = 0; j < N; j++) {
        for (int i = j > 0 ? j - 1 : 0; i <= j + 1 && i < N; i++) {
            const double scale = (i == N - 1 ? 1 : sqrt(2)) * (j == N - 1 ? 1 : sqrt(2));
            const double diagonal = j == N - 1 ? 1 : 2, entry = i != j ? -1 : diagonal;
            dense[i * N + j] = entry / scale;
            whole_row[whole] = i;
            whole_value[whole++] = entry;
            if (i <= j) {
                row[count] = i;
                value[count++] = entry;
            }
        }
        column[j + 1] = count;
        whole_column[j + 1] = whole;
        inverse[j * N + j] = 1;
    }
    for (int j = 0; j < N; j++) {
        double sum = 0;
        for (int i = 0; i < N; i++)
            sum += fabs(dense[i * N + j]);
        norm[0] = fmax(norm[0], sum);
    }
    dense_lu(N, dense, pivot);
    dense_lu_solve(N, N, dense, pivot, inverse);
    for (int j = 0; j < N; j++) {
        double sum = 0;
        for (int i = 0; i < N; i++)
            sum += fabs(inverse[i * N + j]);
        norm[1] = fmax(norm[1], sum);
    }
    const sparse of[2] = {{N, 1, column, row, value, 0},
                          {N, 0, whole_column, whole_row, whole_value, 0}};
    for (int k = 0; k < 2; k++) {
        matrix_factor *fa;
        gsl_test(factor_alloc(&of[k], &fa, NULL) != STATUS_OK ||
                     factor_numeric(fa, &of[k], NULL) != STATUS_OK,
                 "factored");
        gsl_test_rel(factor_condition(fa, &of[k]), norm[0] * norm[1], 1e-12,
                     "condition from the %s", k == 0 ? "triangle" : "whole");
        factor_free(fa);
    }
}

static void nothing_to_solve(void)
{
    int column[1] = {0};
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        const sparse none = {0, symmetric, column, NULL, NULL, 0};
        matrix_factor *fa;
        gsl_test(factor_alloc(&none, &fa, NULL) != STATUS_OK ||
                     factor_numeric(fa, &none, NULL) != STATUS_OK,
                 "no unknowns are no problem");
        factor_solve(fa, NULL);
        gsl_test_int(factor_count(fa).negative_pivots, symmetric ? 0 : -1, "of %s kind",
                     symmetric ? "symmetric" : "unsymmetric");
        factor_free(fa);
    }
    factor_free(NULL);
}

static void linear_tests(void)
{
    random_matrices(DEFINITE, "definite", 1);
    random_matrices(INDEFINITE, "indefinite", 20);
    random_matrices(UNSYMMETRIC, "unsymmetric", 1);
    condition_of_a_triangle();
    nothing_to_solve();
}

static status outcome_of(const sparse *s, fault *f)
{
    matrix_factor *fa;
    status outcome = factor_alloc(s, &fa, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(fa, s, f);
    factor_free(fa);
    return outcome;
}

static void small_singular_matrices(void)
{
    static const struct {
        const char *name;
        double A[9];
        status expected;
    } sample[] = {
        {"a zero row", {1, 0, 0.3, 0, 0, 0, 0.3, 0, 2}, STATUS_SINGULAR},
        {"two equal rows", {1, 0.7, 0.7, 0.7, 3, 3, 0.7, 3, 3}, STATUS_SINGULAR},
        {"a number that is not one", {1, 0, 0, 0, NAN, 0.1, 0, 0.1, 2}, STATUS_SINGULAR},
        {"an infinite number", {1, 0, 0, 0, INFINITY, 0.1, 0, 0.1, 2}, STATUS_SINGULAR},
        {"the zero matrix", {0, 0, 0, 0, 0, 0, 0, 0, 0}, STATUS_SINGULAR},
        {"tiny numbers", {1e-200, 0, 3e-201, 0, 1e-200, 0, 3e-201, 0, 2e-200}, STATUS_OK},
        {"huge numbers", {1e200, 0, 3e199, 0, 1e200, 0, 3e199, 0, 2e200}, STATUS_OK},
        {"digits to spare", {1, 1, 0, 1, 1 + 1e-12, 0, 0, 0, 1}, STATUS_OK},
        {"no digits left", {1, 1, 0, 1, 1 + 4e-16, 0, 0, 0, 1}, STATUS_SINGULAR},
    };
    for (size_t i = 0; i < sizeof sample / sizeof sample[0]; i++)
        for (int symmetric = 0; symmetric < 2; symmetric++) {
            fault f = {""};
            sparse s = matrices_from_dense(3, symmetric, sample[i].A);
            gsl_test_int((int)outcome_of(&s, &f), (int)sample[i].expected, "%s (%s): %s",
                         sample[i].name, symmetric ? "symmetric" : "unsymmetric", f.text);
            matrices_free(&s);
        }
    const double growth[4] = {1e-17, 1, 1, 0};
    sparse s = matrices_from_dense(2, 1, growth);
    gsl_test_int((int)outcome_of(&s, NULL), STATUS_SINGULAR,
                 "a pivot that is small beside its column destroys the digits");
    matrices_free(&s);
    s = matrices_from_dense(2, 0, growth);
    gsl_test_int((int)outcome_of(&s, NULL), STATUS_OK, "and does no harm with row exchanges");
    matrices_free(&s);
}

static status beam_outcome(int n, int held, int unsymmetric)
{
    double k[16], g[16], m[16];
    matrices_beam(1.0 / n, k, g, m);
    sparse s = matrices_chain(n + 1, 2);
    matrices_add_elements(&s, n, 2, 0, k);
    for (int i = 0; i < held; i++)
        matrices_add(&s, i, i, k[5 * i] * n);
    if (unsymmetric) {
        sparse full = matrices_both_triangles(&s);
        matrices_free(&s);
        s = full;
    }
    const status outcome = outcome_of(&s, NULL);
    matrices_free(&s);
    return outcome;
}

static void beams_that_are_not_held(void)
{
    for (int n = 1; n <= 2048; n *= 2)
        for (int unsymmetric = 0; unsymmetric < 2; unsymmetric++) {
            const char *kind_name = unsymmetric ? "LU" : "LDL";
            gsl_test_int((int)beam_outcome(n, 0, unsymmetric), STATUS_SINGULAR,
                         "%s: free beam of %d elements", kind_name, n);
            gsl_test_int((int)beam_outcome(n, 1, unsymmetric), STATUS_SINGULAR,
                         "%s: beam of %d elements that can turn", kind_name, n);
            gsl_test_int((int)beam_outcome(n, 2, unsymmetric), STATUS_OK,
                         "%s: cantilever of %d elements", kind_name, n);
        }
}

static void singular_matrix_tests(void)
{
    small_singular_matrices();
    beams_that_are_not_held();
}

enum { TEST_POOL_MOST = 1000 };

static void add_one(void *context, int first, int end)
{
    int *visits = context;
    for (int i = first; i < end; i++)
        visits[i]++;
}

static void every_index_once(int threads)
{
    static const int counts[] = {0, 1, 2, 3, 7, 64, TEST_POOL_MOST};
    int visits[TEST_POOL_MOST] = {0}, expected = 0;
    thread_pool *t = NULL;
    fault f = {""};
    gsl_test(thread_pool_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    gsl_test((t == NULL) != (threads <= 1), "a team of one is none");
    for (int round = 0; round < 2000; round++) {
        const int count = counts[round % 7];
        memset(visits, 0, sizeof visits);
        thread_pool_run(t, count, add_one, visits);
        for (int i = 0; i < TEST_POOL_MOST; i++)
            expected += visits[i] == (i < count);
        if (round % 500 == 0)
            nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
    }
    gsl_test_int(expected, 2000 * TEST_POOL_MOST, "%d threads: every index once in every round",
                 threads);
    thread_pool_free(t);
}

static void count_parts(void *context, int first, int end)
{
    (void)end;
    ((int *)context)[first] = 1;
}

static void no_more_than_there_is_room_for(int threads)
{
    int begins[TEST_POOL_MOST] = {0}, parts = 0;
    thread_pool *t = NULL;
    fault f = {""};
    gsl_test(thread_pool_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    thread_pool_run(t, TEST_POOL_MOST, count_parts, begins);
    for (int i = 0; i < TEST_POOL_MOST; i++)
        parts += begins[i];
    gsl_test_int(parts, threads < THREAD_POOL_MOST ? threads : THREAD_POOL_MOST,
                 "%d threads: parts", threads);
    thread_pool_free(t);
}

enum { PIECES = 500 };

typedef struct relay_log {
    int held[THREAD_POOL_SLOTS], fills[PIECES], wrong, taken, last;
} relay_log;

static void write_piece(void *context, int piece, int slot)
{
    relay_log *log = context;
    log->fills[piece]++;
    log->held[slot] = 7 * piece;
}

static int read_piece(void *context, int piece, int slot)
{
    relay_log *log = context;
    log->wrong += piece != log->taken++ || log->held[slot] != 7 * piece;
    return piece != log->last;
}

static void relays(int threads)
{
    thread_pool *t = NULL;
    fault f = {""};
    gsl_test(thread_pool_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    int wrong = 0, taken = 0, expected = 0;
    for (int round = 0; round < 400; round++) {
        const int pieces = round % PIECES, last = round % 3 == 0 ? pieces / 2 : PIECES;
        relay_log log = {.last = last};
        thread_pool_relay(t, pieces, write_piece, read_piece, &log);
        taken += log.taken;
        expected += last < pieces ? last + 1 : pieces;
        wrong += log.wrong;
        for (int i = 0; i < PIECES; i++) {
            const int most = i < pieces, least = i < log.taken;
            wrong += log.fills[i] < least || log.fills[i] > most;
        }
    }
    gsl_test_int(wrong, 0, "%d threads: pieces in order, each once", threads);
    gsl_test_int(taken, expected, "%d threads: all pieces that are wanted", threads);
    thread_pool_free(t);
}

static void thread_pool_tests(void)
{
    no_more_than_there_is_room_for(5);
    no_more_than_there_is_room_for(THREAD_POOL_MOST);
    no_more_than_there_is_room_for(THREAD_POOL_MOST + 1);
    no_more_than_there_is_room_for(10 * THREAD_POOL_MOST);
    for (int threads = 1; threads <= 4; threads++)
        every_index_once(threads);
    for (int threads = 1; threads <= 4; threads++)
        relays(threads);
    thread_pool *unused = NULL;
    gsl_test(thread_pool_alloc(3, &unused, NULL) != STATUS_OK, "a team that is never used");
    thread_pool_free(unused);
    thread_pool_free(NULL);
}

enum {
    TRIANGULAR_MOST = 90,
    STRIDE = TRIANGULAR_MOST + 3,
    FILL = TRIANGULAR_MOST * TRIANGULAR_MOST
};

typedef struct triangular_problem {
    int n, column[TRIANGULAR_MOST + 1], row[FILL], source[FILL];
    double value[FILL];
    int parent[TRIANGULAR_MOST], begin[TRIANGULAR_MOST + 1], filled[TRIANGULAR_MOST],
        mark[TRIANGULAR_MOST], path[TRIANGULAR_MOST], L_row[FILL];
    double L_value[FILL], D[TRIANGULAR_MOST], y[TRIANGULAR_MOST];
} triangular_problem;

static void fill(int n, int size, uint64_t *state, triangular_problem *p)
{
    int linked[TRIANGULAR_MOST], entries = 0;
    p->n = n;
    for (int b = 0; b <= n / size; b++)
        linked[b] = (int)((random_number(state) + 1) / 2 * b);
    for (int j = 0; j < n; j++) {
        const int block = j / size;
        p->column[j] = entries;
        for (int i = 0; i <= j; i++)
            if (i / size == block || (size > 2 && i / size == linked[block]) ||
                random_number(state) > 1 - 4.0 / n) {
                p->row[entries] = i;
                p->source[entries] = entries;
                p->value[entries++] = random_number(state) + (i == j ? 2.5 : 0);
            }
    }
    p->column[n] = entries;
}

static void factor_by_ldl(triangular_problem *p)
{
    ldl_symbolic(p->n, p->column, p->row, p->begin, p->parent, p->filled, p->mark, NULL, NULL);
    const int rank = ldl_numeric(p->n, p->column, p->row, p->value, p->begin, p->parent, p->filled,
                                 p->L_row, p->L_value, p->D, p->y, p->path, p->mark, NULL, NULL);
    gsl_test(rank != p->n, "%d of %d pivots", rank, p->n);
}

typedef int factors(const triangular_rows *, const double[]);
typedef void solves(const triangular_factors *, triangular_part, int, int, double[], double[]);

/* Solves L^T x = x in place. In each run of columns, the terms of the rows below the run are
 * subtracted first, then those of the run from the last to the first. */
static void solve_transposed(const triangular_problem *p, const triangular_groups *g, double x[])
{
    for (int i = g->columns - 1; i >= 0; i--) {
        const int first = g->of_columns[i].first, end = first + g->of_columns[i].count;
        for (int j = end - 1; j >= first; j--) {
            const int below = p->begin[j] + end - 1 - j;
            for (int k = below; k < p->begin[j + 1]; k++)
                x[j] -= p->L_value[k] * x[p->L_row[k]];
            for (int k = below - 1; k >= p->begin[j]; k--)
                x[j] -= p->L_value[k] * x[p->L_row[k]];
        }
    }
}

static void hold(triangular_problem *p, const triangular_groups *g, const int L_row[],
                 factors *factor, solves *solve, const char *name)
{
    static double value[FILL], D[TRIANGULAR_MOST], diagonal[TRIANGULAR_MOST],
        rest[TRIANGULAR_LANES * STRIDE + 8], work[TRIANGULAR_TOGETHER * TRIANGULAR_MOST],
        x[SIDES * STRIDE], y[SIDES * STRIDE];
    int filled[TRIANGULAR_MOST];
    uint64_t state = 11;
    const triangular_rows rows = {g->groups,       g->first_of_group,
                                  g->run_of_group, g->run,
                                  p->column,       p->row,
                                  p->source,       p->begin,
                                  L_row,           filled,
                                  value,           D,
                                  diagonal,        rest};
    const triangular_factors t = {p->n,  p->path, p->begin,   L_row,
                                  value, D,       g->columns, g->of_columns};
    const size_t entries = (size_t)p->begin[p->n];
    for (int again = 0; again < 2; again++)
        gsl_test(!factor(&rows, p->value), "%s: no pivot is zero", name);
    gsl_test(memcmp(value, p->L_value, entries * sizeof *value) != 0, "%s: L of %d", name, p->n);
    gsl_test(memcmp(D, p->D, (size_t)p->n * sizeof *D) != 0, "%s: D of %d", name, p->n);
    for (int sides = 1; sides <= SIDES; sides++) {
        for (int i = 0; i < SIDES * STRIDE; i++)
            x[i] = y[i] = random_number(&state);
        solve(&t, TRIANGULAR_WHOLE, sides, STRIDE, x, work);
        for (int c = 0; c < sides; c++) {
            double *one = y + c * STRIDE;
            ldl_perm(p->n, work, one, p->path);
            ldl_lsolve(p->n, work, p->begin, p->L_row, p->L_value);
            ldl_dsolve(p->n, work, p->D);
            solve_transposed(p, g, work);
            ldl_permt(p->n, one, work, p->path);
        }
        gsl_test(memcmp(x, y, sizeof x) != 0, "%s: %d solutions of %d", name, sides, p->n);
    }
}

static void whole(const triangular_problem *p, const triangular_groups *g, int size)
{
    int columns = 0, largest = 0;
    for (int i = 0; i < g->columns; i++) {
        gsl_test(g->of_columns[i].first != columns, "run %d begins at %d", i, columns);
        columns += g->of_columns[i].count;
    }
    for (int i = 0; i < g->groups; i++)
        largest = (int)fmax(largest, g->first_of_group[i + 1] - g->first_of_group[i]);
    gsl_test(columns != p->n || g->first_of_group[g->groups] != p->n, "all of %d", p->n);
    gsl_test(largest < (size < TRIANGULAR_LANES ? size : TRIANGULAR_LANES),
             "%d rows together of blocks of %d", largest, size);
}

static void blocks(triangular_problem *p, int n, int size, uint64_t *state)
{
    static int L_row[FILL];
    triangular_groups g;
    fill(n, size, state, p);
    factor_by_ldl(p);
    const triangular_pattern of = {n, p->column, p->row, p->parent, p->begin, p->mark, p->path};
    gsl_test(!triangular_groups_find(&of, L_row, &g), "memory for groups");
    gsl_test(memcmp(L_row, p->L_row, (size_t)p->begin[n] * sizeof *L_row) != 0, "rows of L");
    whole(p, &g, size);
    triangular_groups_place(&g, p->column, p->row);
    for (int k = 0; k < n; k++) /* `order` is a permutation of the unknowns */
        p->path[k] = n - 1 - k;
    hold(p, &g, L_row, triangular_rows_factor_plain, triangular_solve_plain, "plain");
    hold(p, &g, L_row, REAL_CHOSEN(triangular_rows_factor), REAL_CHOSEN(triangular_solve),
         "as the processor has it");
    triangular_groups_free(&g);
}

static void triangular_tests(void)
{
    uint64_t state = 5;
    triangular_problem *p = malloc(sizeof *p);
    for (int size = 1; p != NULL && size <= 9; size++)
        for (int n = size; n <= TRIANGULAR_MOST; n += 1 + 2 * size)
            blocks(p, n, size, &state);
    gsl_test(p == NULL, "memory");
    free(p);
}

static void products_between(void)
{
    enum { WIDEST = CONGRUENCE_WIDEST + 2 };
    static double A[WIDEST * WIDEST], S[WIDEST * WIDEST], J[WIDEST * WIDEST], K[WIDEST * WIDEST],
        SJ[WIDEST * WIDEST], plain[WIDEST * WIDEST], work[WIDEST * WIDEST];
    uint64_t state = 9;
    for (int m = 1; m <= WIDEST; m++)
        for (int n = 1; n <= WIDEST; n++) {
            double worst = 0;
            for (int i = 0; i < WIDEST * WIDEST; i++) {
                A[i] = random_number(&state);
                S[i] = random_number(&state);
                J[i] = random_number(&state);
                K[i] = plain[i] = random_number(&state);
            }
            for (int i = 0; i < m; i++)
                for (int j = 0; j < n; j++) {
                    SJ[n * i + j] = 0;
                    for (int l = 0; l < m; l++)
                        SJ[n * i + j] += S[m * i + l] * J[n * l + j];
                }
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    for (int l = 0; l < m; l++)
                        plain[n * i + j] += A[n * l + i] * SJ[n * l + j];
            dense_add_between(m, n, A, S, J, K, work);
            for (int i = 0; i < WIDEST * WIDEST; i++)
                worst = worst_of(worst, fabs(K[i] - plain[i]));
            gsl_test(!(worst <= 1e-12), "A^T S J of %d strains and %d coordinates: %g", m, n,
                     worst);
        }
}

/* An oscillator without damping, K = 4 and M = 1, must have the response 1/(4 - w^2) at w = 1, and
 * none at w = 2. */
static void check_resonance(void)
{
    second_order m = {0};
    fault f = {""};
    double out[2];
    gsl_test(second_order_alloc(1, 0, 1, 1, &m, &f) != STATUS_OK, "oscillator: %s", f.text);
    m.K[0] = 4;
    m.M[0] = m.B[0] = m.L[0][0] = 1;
    m.motion_of[0] = -1;
    gsl_test(second_order_transfer(&m, 1, out, NULL, NULL, &f) != STATUS_OK, "at w = 1");
    gsl_test_rel(out[0], 1.0 / 3, 1e-15, "response at w = 1");
    gsl_test(second_order_transfer(&m, 2, out, NULL, NULL, &f) != STATUS_SINGULAR, "at w = 2");
    second_order_free(&m);
}

int main(void)
{
    products_between();
    linear_tests();
    singular_matrix_tests();
    thread_pool_tests();
    triangular_tests();
    check_resonance();
    return gsl_test_summary();
}
