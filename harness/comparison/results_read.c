/* Stored runs, told apart by their first bytes. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "harness/comparison/results.h"

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
