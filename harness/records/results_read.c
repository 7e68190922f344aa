/* Stored runs, told apart by their first bytes. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/line.h"
#include "harness/records/results.h"

static int compare_cells(const void *a, const void *b)
{
    return results_order(a, b);
}

static int compare_series(const void *a, const void *b)
{
    return strcmp(((const result_series *)a)->name, ((const result_series *)b)->name);
}

static status sort_cells(const char *path, stored_results *r, fault *f)
{
    if (r->cells > 0)
        qsort(r->cell, (size_t)r->cells, sizeof *r->cell, compare_cells);
    for (int i = 1; i < r->cells; i++)
        if (results_order(&r->cell[i - 1], &r->cell[i]) == 0)
            return fault_set(f, STATUS_FAULT, "%.120s: cell %.120s n=%d is there twice", path,
                             r->cell[i].name, r->cell[i].elements);
    return STATUS_OK;
}

static status sort_series(const char *path, stored_results *r, fault *f)
{
    if (r->seriess > 0)
        qsort(r->series, (size_t)r->seriess, sizeof *r->series, compare_series);
    for (int i = 1; i < r->seriess; i++)
        if (compare_series(&r->series[i - 1], &r->series[i]) == 0)
            return fault_set(f, STATUS_FAULT, "%.120s: series %.120s is there twice", path,
                             r->series[i].name);
    return STATUS_OK;
}

static int is_hdf5(FILE *from)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof signature] = {0};
    const size_t length = fread(head, 1, sizeof head, from);
    rewind(from);
    return length == sizeof head && memcmp(head, signature, sizeof head) == 0;
}

static status read_sorted(const char *path, const char *experiment, FILE *from, stored_results *out,
                          fault *f)
{
    const int whole = is_hdf5(from);
    if (!whole)
        line_skip_mark(from);
    TRY(whole ? results_hdf5_read(path, experiment, out, f)
              : results_table_read(path, from, out, f));
    TRY(sort_cells(path, out, f));
    if (out->whole && !out->swept)
        TRY(results_series_summarise(out, f));
    return sort_series(path, out, f);
}

status results_read_any(const char *path, const char *experiment, stored_results *out, fault *f)
{
    memset(out, 0, sizeof *out);
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", path, strerror(errno));
    const status outcome = read_sorted(path, experiment, from, out, f);
    fclose(from);
    if (outcome != STATUS_OK)
        results_free(out);
    return outcome;
}

status results_read(const char *path, stored_results *out, fault *f)
{
    TRY(results_read_any(path, NULL, out, f));
    if (!out->swept)
        return STATUS_OK;
    results_free(out);
    return fault_set(f, STATUS_FAULT,
                     "%.120s: a sweep, which only 'beamwork compare' reads; give "
                     "a file of 'beamwork verify -o'",
                     path);
}
