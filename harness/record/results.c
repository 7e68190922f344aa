#include "harness/record/results.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const results_work_names[RESULTS_WORKS] = {"iterations", "evaluations", "factorisations"};

result_cell *results_add(results *r)
{
    enum { GROWTH = 1024 };
    if (r->cells % GROWTH == 0) {
        result_cell *more = realloc(r->cell, ((size_t)r->cells + GROWTH) * sizeof *more);
        if (more == NULL)
            return NULL;
        r->cell = more;
    }
    result_cell *one = &r->cell[r->cells++];
    memset(one, 0, sizeof *one);
    return one;
}

void results_summarise(result_cell *cell)
{
    result_summary *s = &cell->summary;
    memset(s, 0, sizeof *s);
    for (int i = 0; i < cell->values; i++) {
        const double error = fabs(cell->value[i].error);
        if (!isfinite(error))
            continue;
        s->judged++;
        s->decades += log10(error + RESULTS_FLOOR);
        if (s->judged == 1 || error > s->worst) {
            s->worst = error;
            memcpy(s->quantity, cell->value[i].quantity, sizeof s->quantity);
        }
    }
}

int results_order(const result_cell *a, const result_cell *b)
{
    const int names = strcmp(a->name, b->name);
    return names != 0 ? names : (a->elements > b->elements) - (a->elements < b->elements);
}

static int compare_cells(const void *a, const void *b)
{
    return results_order(a, b);
}

static status check_twice(const char *path, const results *r, fault *f)
{
    for (int i = 1; i < r->cells; i++)
        if (results_order(&r->cell[i - 1], &r->cell[i]) == 0)
            return fault_set(f, STATUS_FAULT, "%.120s: cell %.120s n=%d is there twice", path, r->cell[i].name,
                             r->cell[i].elements);
    return STATUS_OK;
}

status results_read(const char *path, results *out, fault *f)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof signature] = {0};
    memset(out, 0, sizeof *out);
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", path, strerror(errno));
    const size_t length = fread(head, 1, sizeof head, from);
    status outcome;
    if (length == sizeof head && memcmp(head, signature, sizeof head) == 0) {
        outcome = results_read_hdf5(path, out, f);
    } else {
        rewind(from);
        outcome = results_read_table(path, from, out, f);
    }
    fclose(from);
    if (outcome == STATUS_OK && out->cells > 0)
        qsort(out->cell, (size_t)out->cells, sizeof *out->cell, compare_cells);
    if (outcome == STATUS_OK)
        outcome = check_twice(path, out, f);
    if (outcome != STATUS_OK)
        results_free(out);
    return outcome;
}

void results_free(results *r)
{
    for (int i = 0; i < r->cells; i++) {
        free(r->cell[i].name);
        free(r->cell[i].value);
    }
    free(r->cell);
    memset(r, 0, sizeof *r);
}
