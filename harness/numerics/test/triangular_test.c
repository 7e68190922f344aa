/* Rows made side by side and solutions of several right-hand sides have the bits of SuiteSparse's
 * LDL, with and without AVX2. */
#include <gsl/gsl_test.h>
#include <ldl.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/real.h"
#include "elements/test/random.h"
#include "harness/numerics/numerics_impl.h"

enum {
    TRIANGULAR_MOST = 90,
    SIDES = 7,
    STRIDE = TRIANGULAR_MOST + 3,
    FILL = TRIANGULAR_MOST * TRIANGULAR_MOST
};

/* A matrix in the order of elimination, and its factor by LDL. */
typedef struct triangular_problem {
    int n, column[TRIANGULAR_MOST + 1], row[FILL], source[FILL];
    double value[FILL];
    int parent[TRIANGULAR_MOST], begin[TRIANGULAR_MOST + 1], filled[TRIANGULAR_MOST],
        mark[TRIANGULAR_MOST], path[TRIANGULAR_MOST], L_row[FILL];
    double L_value[FILL], D[TRIANGULAR_MOST], y[TRIANGULAR_MOST];
} triangular_problem;

/* Blocks of `size`, coupled with one at random, and a few entries anywhere. */
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
typedef void solves(const triangular_factors *, int, int, double[], double[]);

static void hold(const triangular_problem *p, const triangular_groups *g, const int L_row[],
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
    for (int again = 0; again < 2; again++) /* its work space is left as it was */
        gsl_test(!factor(&rows, p->value), "%s: no pivot is zero", name);
    gsl_test(memcmp(value, p->L_value, entries * sizeof *value) != 0, "%s: L of %d", name, p->n);
    gsl_test(memcmp(D, p->D, (size_t)p->n * sizeof *D) != 0, "%s: D of %d", name, p->n);
    for (int sides = 1; sides <= SIDES; sides++) {
        for (int i = 0; i < SIDES * STRIDE; i++)
            x[i] = y[i] = random_number(&state);
        solve(&t, sides, STRIDE, x, work);
        for (int c = 0; c < sides; c++) {
            double *one = y + c * STRIDE;
            ldl_perm(p->n, work, one, (int *)p->path);
            ldl_lsolve(p->n, work, (int *)p->begin, (int *)p->L_row, (double *)p->L_value);
            ldl_dsolve(p->n, work, (double *)p->D);
            ldl_ltsolve(p->n, work, (int *)p->begin, (int *)p->L_row, (double *)p->L_value);
            ldl_permt(p->n, one, work, (int *)p->path);
        }
        gsl_test(memcmp(x, y, sizeof x) != 0, "%s: %d solutions of %d", name, sides, p->n);
    }
}

/* All rows are in groups, all columns in runs; rows of blocks are together. */
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
    for (int k = 0; k < n; k++) /* an order of unknowns */
        p->path[k] = n - 1 - k;
    hold(p, &g, L_row, triangular_rows_factor_plain, triangular_solve_plain, "plain");
    hold(p, &g, L_row, REAL_CHOSEN(triangular_rows_factor), REAL_CHOSEN(triangular_solve),
         "as the processor has it");
    triangular_groups_free(&g);
}

int main(void)
{
    uint64_t state = 5;
    triangular_problem *p = malloc(sizeof *p);
    for (int size = 1; p != NULL && size <= 9; size++)
        for (int n = size; n <= TRIANGULAR_MOST; n += 1 + 2 * size)
            blocks(p, n, size, &state);
    gsl_test(p == NULL, "memory");
    free(p);
    return gsl_test_summary();
}
