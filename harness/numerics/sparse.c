#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "elements/math/real.h"
#include "elements/math/scalar.h"

status sparse_alloc_like(const sparse *pattern, sparse *out, fault *f)
{
    *out = *pattern;
    const int entries = pattern->column[pattern->n];
    out->value = calloc((size_t)(entries > 0 ? entries : 1), sizeof *out->value);
    if (out->value == NULL)
        return fault_memory(f, "a matrix of %d coordinates", pattern->n);
    return STATUS_OK;
}

void sparse_free_values(sparse *a)
{
    free(a->value);
    a->value = NULL;
}

void sparse_zero(sparse *a)
{
    memset(a->value, 0, (size_t)a->column[a->n] * sizeof *a->value);
}

void sparse_copy_leading(const sparse *whole, sparse *leading)
{
    for (int j = 0; j < leading->n; j++)
        memcpy(&leading->value[leading->column[j]], &whole->value[whole->column[j]],
               (size_t)(leading->column[j + 1] - leading->column[j]) * sizeof *leading->value);
}

void sparse_mul(const sparse *a, const double x[], double y[])
{
    if (a->symmetric) {
        REAL_CHOSEN(triangular_product)(a, x, y);
        return;
    }
    for (int j = 0; j < a->n; j++)
        y[j] = 0;
    const int *row = a->row;
    const double *value = a->value;
    for (int j = 0; j < a->n; j++) {
        const double factor = x[j];
        for (int k = a->column[j], end = a->column[j + 1]; k < end; k++)
            y[row[k]] += value[k] * factor;
    }
}

void sparse_mul_transposed(const sparse *a, const double x[], double y[])
{
    if (a->symmetric) {
        sparse_mul(a, x, y);
        return;
    }
    for (int j = 0; j < a->n; j++) {
        double sum = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            sum += a->value[k] * x[a->row[k]];
        y[j] = sum;
    }
}

double sparse_rounding(const sparse *a, const double x[], const double y[])
{
    double sum = 0;
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            double terms = fabs(x[i] * y[j]);
            if (a->symmetric && i != j)
                terms += fabs(y[i] * x[j]);
            sum += fabs(a->value[k]) * terms;
        }
    return DBL_EPSILON * sum;
}

struct by_numbers {
    sparse upper;
    /* [entries of upper] positions in the whole matrix; mirror -1: the mirrored entry is not
     * stored */
    int *from, *mirror;
    double *diagonal;
};

int sparse_position(const sparse *a, int row, int column)
{
    int low = a->column[column], high = a->column[column + 1] - 1;
    while (low <= high) {
        const int middle = (low + high) / 2;
        if (a->row[middle] == row)
            return middle;
        if (a->row[middle] < row)
            low = middle + 1;
        else
            high = middle - 1;
    }
    return -1;
}

double sparse_diagonal(const sparse *a, int j)
{
    const int place = sparse_position(a, j, j);
    return place < 0 ? 0 : a->value[place];
}

static void fill(const sparse *a, by_numbers *b)
{
    int entries = 0;
    for (int j = 0; j < a->n; j++) {
        b->upper.column[j] = entries;
        for (int k = a->column[j]; k < a->column[j + 1] && a->row[k] <= j; k++) {
            b->upper.row[entries] = a->row[k];
            b->from[entries] = k;
            b->mirror[entries++] = sparse_position(a, j, a->row[k]);
        }
    }
    b->upper.column[a->n] = entries;
}

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f)
{
    const size_t n = (size_t)pattern->n + 1, entries = (size_t)pattern->column[pattern->n] + 1;
    by_numbers *b = *out = calloc(1, sizeof *b);
    if (b != NULL) {
        b->upper = (sparse){.n = pattern->n, .symmetric = 1};
        b->upper.column = calloc(n, sizeof *b->upper.column);
        b->upper.row = calloc(entries, sizeof *b->upper.row);
        b->upper.value = calloc(entries, sizeof *b->upper.value);
        b->from = calloc(2 * entries, sizeof *b->from);
        b->diagonal = calloc(n, sizeof *b->diagonal);
    }
    if (b == NULL || b->upper.column == NULL || b->upper.row == NULL || b->upper.value == NULL ||
        b->from == NULL || b->diagonal == NULL)
        return fault_memory(f, "a matrix of %d coordinates", pattern->n);
    b->mirror = b->from + entries;
    fill(pattern, b);
    return STATUS_OK;
}

void by_numbers_free(by_numbers *b)
{
    if (b == NULL)
        return;
    free(b->upper.column);
    free(b->upper.row);
    free(b->upper.value);
    free(b->from);
    free(b->diagonal);
    free(b);
}

double by_numbers_take(by_numbers *b, const sparse *a)
{
    double largest = 0;
    for (int j = 0; j < a->n; j++) {
        const int end = b->upper.column[j + 1] - 1;
        const int stored = end >= b->upper.column[j] && b->upper.row[end] == j;
        b->diagonal[j] = stored ? sqrt(fabs(a->value[b->from[end]])) : 0;
    }
    for (int j = 0; j < a->n; j++)
        for (int k = b->upper.column[j]; k < b->upper.column[j + 1]; k++) {
            const double value = b->upper.value[k] = a->value[b->from[k]],
                         other = b->mirror[k] >= 0 ? a->value[b->mirror[k]] : 0;
            if (value == other)
                continue;
            const double part =
                fabs(value - other) / (b->diagonal[j] * b->diagonal[b->upper.row[k]]);
            largest = larger(largest, part);
        }
    return isnan(largest) ? INFINITY : largest; /* NaN counts as unsymmetric */
}

const sparse *by_numbers_upper(const by_numbers *b)
{
    return &b->upper;
}

static status triplets_alloc(int rows, int columns, matrix_kind kind, int most, triplets *out,
                             fault *f)
{
    *out = (triplets){.kind = kind, .rows = rows, .columns = columns};
    out->row = malloc(((size_t)most + 1) * sizeof *out->row);
    out->column = malloc(((size_t)most + 1) * sizeof *out->column);
    out->value = malloc(((size_t)most + 1) * sizeof *out->value);
    return out->row != NULL && out->column != NULL && out->value != NULL
               ? STATUS_OK
               : fault_memory(f, "a matrix of %d rows", rows);
}

void triplets_free(triplets *t)
{
    free(t->row);
    free(t->column);
    free(t->value);
}

static void add(triplets *t, int row, int column, double value)
{
    if (value == 0)
        return;
    t->row[t->entries] = row;
    t->column[t->entries] = column;
    t->value[t->entries++] = value;
}

status triplets_of(const sparse *a, int skew, triplets *out, fault *f)
{
    const matrix_kind half = skew ? MATRIX_SKEW : MATRIX_SYMMETRIC;
    TRY(triplets_alloc(a->n, a->n, a->symmetric ? half : MATRIX_GENERAL, a->column[a->n], out, f));
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            if (!a->symmetric)
                add(out, a->row[k], j, a->value[k]);
            else if (!skew || a->row[k] != j)
                add(out, j, a->row[k], skew ? -a->value[k] : a->value[k]);
        }
    return STATUS_OK;
}

void triplets_lead(triplets *t, int n)
{
    int kept = 0;
    for (int i = 0; i < t->entries; i++)
        if (t->row[i] < n && t->column[i] < n) {
            t->row[kept] = t->row[i];
            t->column[kept] = t->column[i];
            t->value[kept++] = t->value[i];
        }
    t->rows = t->columns = n;
    t->entries = kept;
}

status triplets_of_columns(int rows, int columns, const double value[], triplets *out, fault *f)
{
    TRY(triplets_alloc(rows, columns, MATRIX_GENERAL, rows * columns, out, f));
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < rows; i++)
            add(out, i, j, value[(size_t)j * (size_t)rows + (size_t)i]);
    return STATUS_OK;
}

void triplets_mul(const triplets *A, const double x[], double y[])
{
    const double turned[] = {[MATRIX_GENERAL] = 0, [MATRIX_SYMMETRIC] = 1, [MATRIX_SKEW] = -1};
    memset(y, 0, (size_t)A->rows * sizeof *y);
    for (int k = 0; k < A->entries; k++) {
        const int i = A->row[k], j = A->column[k];
        y[i] += A->value[k] * x[j];
        if (i != j && A->kind != MATRIX_GENERAL)
            y[j] += turned[A->kind] * A->value[k] * x[i];
    }
}

/* Returns the memory of the machine, or the limit of this process if it is smaller [byte]. */
static double usable(void)
{
    struct rlimit own;
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    double limit = pages > 0 && size > 0 ? (double)pages * (double)size : INFINITY;
    if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
        limit = fmin(limit, (double)own.rlim_cur);
    return limit;
}

status memory_check(double bytes, const char *what, const char *remedy, fault *f)
{
    const double giga = 1e9, limit = usable();
    if (bytes <= limit)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s require more memory than is available (%.3g GB; available: %.3g GB); %s",
                     what, bytes / giga, limit / giga, remedy);
}

status memory_append(void *list, int *count, const void *entry, size_t size, const char *what,
                     fault *f)
{
    char *entries;
    memcpy(&entries, list, sizeof entries);
    const size_t n = (size_t)*count;
    if ((n & (n - 1)) == 0) {
        char *const grown = realloc(entries, (n == 0 ? 1 : 2 * n) * size);
        if (grown == NULL)
            return fault_memory(f, "%s", what);
        entries = grown;
        memcpy(list, &entries, sizeof entries);
    }
    memcpy(entries + n * size, entry, size);
    *count += 1;
    return STATUS_OK;
}
