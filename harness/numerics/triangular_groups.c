#include "harness/numerics/numerics_impl.h"

#include <stdlib.h>
#include <string.h>

/* Finds the columns of row k of L in the order of subtraction: path[top], ..., path[n - 1], by the
 * up-looking algorithm (T.A. Davis, ACM Trans. Math. Softw. 31, 2005, section 2). */
static int find_row(const triangular_pattern *of, int k)
{
    int top = of->n;
    of->mark[k] = k;
    for (int p = of->column[k]; p < of->column[k + 1]; p++) {
        int length = 0;
        for (int i = of->row[p]; of->mark[i] != k; i = of->parent[i]) {
            of->path[length++] = i;
            of->mark[i] = k;
        }
        while (length > 0)
            of->path[--top] = of->path[--length];
    }
    return top;
}

static int is_nested(const triangular_pattern *of, int j)
{
    return of->parent[j] == j + 1 &&
           of->begin[j + 1] - of->begin[j] == of->begin[j + 2] - of->begin[j + 1] + 1;
}

static int run_length(const triangular_pattern *of, int count, const int column[])
{
    const int most = count < TRIANGULAR_RUN ? count : TRIANGULAR_RUN;
    int length = 1;
    while (length < most && column[length] == column[0] + length &&
           is_nested(of, column[length - 1]))
        length++;
    return length;
}

static int split(const triangular_pattern *of, int count, const int column[], triangular_run run[])
{
    int runs = 0;
    for (int i = 0, length; i < count; i += length, runs++) {
        length = run_length(of, count - i, column + i);
        if (run != NULL)
            run[runs] = (triangular_run){column[i], length};
    }
    return runs;
}

/* Returns 1 if row k joins the previous row: its columns are those of the previous row, in the same
 * order, followed by the column of the previous row. */
static int joins(int rows, int before, const int column_before[], int count, const int column[],
                 int k)
{
    return rows > 0 && rows < TRIANGULAR_LANES && count == before + 1 && column[before] == k - 1 &&
           memcmp(column, column_before, (size_t)before * sizeof *column) == 0;
}

/* Finds the groups of rows. Also fills L_row and the runs if out->run is allocated. work: [2 n]. */
static void find(const triangular_pattern *of, int work[], int L_row[], triangular_groups *out)
{
    int *column_before = work, *filled = work + of->n, runs = 0, before = 0, rows = 0;
    out->groups = 0;
    for (int k = 0; k < of->n; k++)
        of->mark[k] = -1;
    for (int k = 0; k < of->n; k++) {
        const int top = find_row(of, k), count = of->n - top, *column = of->path + top;
        rows = joins(rows, before, column_before, count, column, k) ? rows + 1 : 1;
        if (rows == 1) {
            out->first_of_group[out->groups] = k;
            out->run_of_group[out->groups++] = runs;
            runs += split(of, count, column, out->run != NULL ? out->run + runs : NULL);
        }
        filled[k] = 0;
        for (int i = 0; i < count && out->run != NULL; i++)
            L_row[of->begin[column[i]] + filled[column[i]]++] = k;
        memcpy(column_before, column, (size_t)count * sizeof *column);
        before = count;
    }
    out->first_of_group[out->groups] = of->n;
    out->run_of_group[out->groups] = runs;
}

static int find_columns(const triangular_pattern *of, int work[], triangular_groups *out)
{
    for (int k = 0; k < of->n; k++)
        work[k] = k;
    out->columns = split(of, of->n, work, NULL);
    out->of_columns = malloc(((size_t)out->columns + 1) * sizeof *out->of_columns);
    if (out->of_columns != NULL)
        split(of, of->n, work, out->of_columns);
    return out->of_columns != NULL;
}

int triangular_groups_find(const triangular_pattern *of, int L_row[], triangular_groups *out)
{
    const size_t n = (size_t)of->n;
    int *work = malloc((2 * n + 1) * sizeof *work);
    *out = (triangular_groups){0};
    out->first_of_group = malloc((n + 1) * sizeof *out->first_of_group);
    out->run_of_group = malloc((n + 1) * sizeof *out->run_of_group);
    int good = work != NULL && out->first_of_group != NULL && out->run_of_group != NULL;
    if (good) {
        find(of, work, L_row, out);
        out->run = malloc(((size_t)out->run_of_group[out->groups] + 1) * sizeof *out->run);
        good = out->run != NULL && find_columns(of, work, out);
    }
    if (good)
        find(of, work, L_row, out);
    free(work);
    return good;
}

void triangular_groups_place(const triangular_groups *g, const int column[], int row[])
{
    for (int group = 0; group < g->groups; group++)
        for (int k = g->first_of_group[group]; k < g->first_of_group[group + 1]; k++)
            for (int p = column[k]; p < column[k + 1]; p++)
                row[p] = row[p] * TRIANGULAR_LANES + k - g->first_of_group[group];
}

void triangular_groups_free(triangular_groups *out)
{
    free(out->first_of_group);
    free(out->run_of_group);
    free(out->run);
    free(out->of_columns);
}
