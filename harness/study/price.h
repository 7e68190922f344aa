/* Cost of a cell: its counted work, each count at a price. Counts are the same in every run and on
 * every machine, and so is what they cost: formulations are ranked by it, not by the noise of
 * times.
 *
 * Prices are fitted once to measured times (`make lab L=prices`) and kept in
 * harness/study/prices.csv, of which the build makes the table. Where a formulation has no prices
 * of its own, those hold that all formulations have in common ("*"), by the number of its strains.
 */
#ifndef BEAMWORK_PRICE_H
#define BEAMWORK_PRICE_H

#include "harness/study/cell.h"

/* What is counted; the names are those of the columns of the table `cells`. */
typedef enum price_count {
    PRICE_one, /* a cell */
    PRICE_elements_total,
    PRICE_element_kinds,
    PRICE_strains, /* of an element, with its inner unknowns */
    PRICE_free,
    PRICE_strain_evaluations,
    PRICE_stress_evaluations,
    PRICE_inertia_evaluations,
    PRICE_geometric_evaluations,
    PRICE_iterations,
    PRICE_load_steps,
    PRICE_factorisations,
    PRICE_solutions,
    PRICE_factor_entries,
    PRICE_factor_flops,
    PRICE_dense_operations,
    PRICE_COUNTS
} price_count;

typedef struct price_row {
    /* "": of all; "*": of those without own prices; a name, with options where they matter */
    const char *formulation;
    price_count first, second; /* what is paid for is their product */
    double seconds;            /* on the reference machine */
} price_row;

extern const price_row price_rows[]; /* generated; ends with a row without formulation */
/* Costs whose ratio is below this one do not tell which is faster: the prices are not known better.
 */
extern const double price_noise;

/* [s] on the reference machine, of all rows that hold for the formulation. */
double price_of(const price_row *rows, const formulation *chosen, const cell_result *cell);
/* The same by the committed prices. */
double price_cost(const formulation *chosen, const cell_result *cell);
/* 1: it has prices of its own; 0: those of any formulation hold. */
int price_own(const price_row *rows, const formulation *chosen);

#endif
