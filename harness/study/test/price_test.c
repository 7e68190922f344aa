/* Counted work at prices: which rows hold for a formulation, and what a cell costs. */
#include <gsl/gsl_test.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

static const price_row rows[] = {
    {"", PRICE_one, PRICE_one, 1},
    {"", PRICE_solutions, PRICE_factor_entries, 2},
    {"*", PRICE_strain_evaluations, PRICE_strains, 100},
    {"red", PRICE_strain_evaluations, PRICE_one, 1000},
    {"red:stages=4", PRICE_strain_evaluations, PRICE_one, 2000},
    {"red:stages=4,form=x", PRICE_strain_evaluations, PRICE_one, 3000},
    {NULL, PRICE_one, PRICE_one, 0},
};

static cell_result counted(void)
{
    return (cell_result){
        .size = {.elements = 2, .strains = 8, .inner = 3, .kinds = 1, .free = 13},
        .counters = {.strain_evaluations = 5, .solutions = 3, .factor_entries = 7}};
}

static double cost_of(const char *key)
{
    formulation f = {.type = NULL};
    const cell_result cell = counted();
    strcpy(f.key, key);
    return price_of(rows, &f, &cell) - 1 - 2 * 3 * 7;
}

static void which_rows(void)
{
    gsl_test_abs(cost_of("red"), 5 * 1000, 0, "its own row");
    gsl_test_abs(cost_of("red:mass=lumped"), 5 * 1000, 0, "an option without a price");
    gsl_test_abs(cost_of("red:stages=4"), 5 * 2000, 0, "an option with one");
    gsl_test_abs(cost_of("red:mass=lumped,stages=4"), 5 * 2000, 0, "the same among others");
    gsl_test_abs(cost_of("red:form=x,stages=4"), 5 * 3000, 0, "the row that says most of it");
    gsl_test_abs(cost_of("red:stages=40"), 5 * 1000, 0, "another value that begins alike");
    gsl_test_abs(cost_of("redder"), 5 * 11 * 100, 0, "a name that begins alike has no row");
    gsl_test_abs(cost_of("new"), 5 * 11 * 100, 0, "without a row: by evaluations and strains");
}

static void who_has_prices(void)
{
    formulation f = {.type = NULL};
    strcpy(f.key, "new");
    gsl_test_int(price_own(rows, &f), 0, "no prices of its own");
    strcpy(f.key, "red:mass=lumped");
    gsl_test_int(price_own(rows, &f), 1, "prices of its own");
}

/* The committed table: what a cell costs, of a new formulation too. */
static void committed(void)
{
    const cell_result cell = counted();
    int seen = 0, own = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++, seen++) {
        formulation f;
        formulation_default(registry_formulations[i], &f);
        own += price_own(price_rows, &f);
        gsl_test(!(price_cost(&f, &cell) > 0 && price_cost(&f, &cell) < 1), "%s costs %g s", f.key,
                 price_cost(&f, &cell));
    }
    gsl_test(seen < 2 || own < 2, "%d formulations, %d with prices", seen, own);
    for (const price_row *r = price_rows; r->formulation != NULL; r++)
        gsl_test(!(r->seconds > 0), "%s: %g s", r->formulation, r->seconds);
    gsl_test(!(price_noise > 1 && price_noise < 2), "noise %g", price_noise);
}

int main(void)
{
    which_rows();
    who_has_prices();
    committed();
    return gsl_test_summary();
}
