#include "harness/study/price.h"

#include <string.h>

static double count_of(const cell_result *c, price_count which)
{
    switch (which) {
    case PRICE_elements_total:
        return c->size.elements;
    case PRICE_element_kinds:
        return c->size.kinds;
    case PRICE_strains:
        return c->size.strains + c->size.inner;
    case PRICE_free:
        return c->size.free;
    case PRICE_strain_evaluations:
        return (double)c->counters.strain_evaluations;
    case PRICE_stress_evaluations:
        return (double)c->counters.stress_evaluations;
    case PRICE_inertia_evaluations:
        return (double)c->counters.inertia_evaluations;
    case PRICE_geometric_evaluations:
        return (double)c->counters.geometric_evaluations;
    case PRICE_iterations:
        return (double)c->counters.iterations;
    case PRICE_load_steps:
        return (double)c->counters.steps;
    case PRICE_factorisations:
        return (double)c->counters.factorisations;
    case PRICE_solutions:
        return (double)c->counters.solutions;
    case PRICE_factor_entries:
        return (double)c->counters.factor_entries;
    case PRICE_factor_flops:
        return c->counters.factor_flops;
    case PRICE_dense_operations:
        return c->counters.dense_operations;
    default:
        return 1;
    }
}

/* Is "key=value" of the given length one of the options in "name:key=value,..."? */
static int has_option(const char *key, const char *option, size_t length)
{
    const char *at = strchr(key, ':');
    while (at != NULL && at[0] != '\0') {
        at++;
        if (strncmp(at, option, length) == 0 && strchr(",", at[length]) != NULL)
            return 1;
        at = strchr(at, ',');
    }
    return 0;
}

/* Options of the row that the formulation has, plus one; 0: the row speaks of another one. */
static int match(const char *row, const char *key)
{
    const size_t name = strcspn(row, ":");
    int options = 1;
    if (name != strcspn(key, ":") || strncmp(row, key, name) != 0)
        return 0;
    for (const char *at = row + name; *at != '\0'; options++) {
        const size_t length = strcspn(at + 1, ",");
        if (!has_option(key, at + 1, length))
            return 0;
        at += 1 + length;
    }
    return options;
}

/* What the rows call the formulation: of those that speak of it the one with most options; or "*".
 */
static const char *row_name(const price_row *rows, const char *key)
{
    const char *best = "*";
    for (int most = 0; rows->formulation != NULL; rows++) {
        const int here = match(rows->formulation, key);
        if (here <= most)
            continue;
        most = here;
        best = rows->formulation;
    }
    return best;
}

double price_of(const price_row *rows, const formulation *chosen, const cell_result *cell)
{
    const char *own = row_name(rows, chosen->key);
    double sum = 0;
    for (; rows->formulation != NULL; rows++)
        if (rows->formulation[0] == '\0' || strcmp(rows->formulation, own) == 0)
            sum += rows->seconds * count_of(cell, rows->first) * count_of(cell, rows->second);
    return sum;
}

double price_cost(const formulation *chosen, const cell_result *cell)
{
    return price_of(price_rows, chosen, cell);
}

int price_own(const price_row *rows, const formulation *chosen)
{
    return strcmp(row_name(rows, chosen->key), "*") != 0;
}
