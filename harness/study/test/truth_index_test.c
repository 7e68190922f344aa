/* The index must find the same rows as a search of all rows. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study_impl.h"

enum { ROWS = 500, CASES = 3, NAMES = 4 };

static char names[NAMES][4] = {"u", "v", "load", "C"};

static void fill(truths *t, int from, int to)
{
    uint64_t seed = 7 + (uint64_t)from;
    for (int i = from; i < to; i++)
        t->row[i] = (truth){.type = registry_cases[random_below(&seed, CASES)],
                            .quantity = names[random_below(&seed, NAMES)]};
    t->rows = to;
}

static void compare(const truths *t, const case_type *type, const char *quantity)
{
    int i = truth_index_first(t, type, quantity), wrong = 0;
    for (int k = 0; k < t->rows; k++)
        if (t->row[k].type == type && strcmp(t->row[k].quantity, quantity) == 0) {
            wrong += i != k;
            i = i < t->rows ? truth_index_next(t, i) : i;
        }
    gsl_test(wrong != 0 || i != t->rows, "%d rows, %d of them in the index: %s %s", t->rows,
             t->indexed, type->name, quantity);
}

static void compare_all(const truths *t)
{
    for (int c = 0; c < CASES; c++)
        for (int n = 0; n < NAMES; n++)
            compare(t, registry_cases[c], names[n]);
    compare(t, registry_cases[0], "not there");
}

int main(void)
{
    truth *rows = calloc(ROWS + 1, sizeof *rows);
    truths t = {.row = rows};
    fault f = {""};
    if (rows == NULL)
        return 1;
    gsl_test(truth_index_make(&t, &f) != STATUS_OK, "of no rows");
    compare_all(&t);
    fill(&t, 0, ROWS / 3);
    compare_all(&t);
    gsl_test(truth_index_make(&t, &f) != STATUS_OK || t.indexed != ROWS / 3, "of a third");
    compare_all(&t);
    fill(&t, ROWS / 3, ROWS);
    compare_all(&t);
    gsl_test(truth_index_make(&t, &f) != STATUS_OK || t.indexed != ROWS, "of all");
    compare_all(&t);
    truth_index_free(&t);
    compare_all(&t);
    free(rows);
    return gsl_test_summary();
}
