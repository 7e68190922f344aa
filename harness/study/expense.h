/* What cells cost, before they are solved: prices of what their analyses do, fitted to counted work
 * (`make lab L=expense`, harness/study/expense.csv). The order of work, batches and shards rest on
 * it, no answer does. */
#ifndef BEAMWORK_EXPENSE_H
#define BEAMWORK_EXPENSE_H

#include "harness/study/workload.h"

/* What is paid for, each as often as it is due. */
typedef enum expense_kind {
    EXPENSE_cell, /* once */
    EXPENSE_linear,
    EXPENSE_buckling,
    EXPENSE_loaded_buckling, /* about a loaded state: with the path to the critical point */
    EXPENSE_modal,
    EXPENSE_load_step,
    EXPENSE_compliance, /* of a station */
    EXPENSE_continuation,
    EXPENSE_rotation_step,
    EXPENSE_rotation_station,
    EXPENSE_alpha_step, /* of a motion in time, by its integrator */
    EXPENSE_conserving_step,
    EXPENSE_radau_step,
    EXPENSE_explicit_step,
    EXPENSE_KINDS
} expense_kind;

/* [s] on the reference machine: once, and for each element of all members; or factors of these. */
typedef struct expense_price {
    double once, element;
} expense_price;

typedef struct expense_factor {
    const char *formulation; /* without options; NULL: those without a row */
    expense_price factor;
} expense_factor;

/* Generated; the factors end with those of any other formulation. */
extern const expense_price expense_work[EXPENSE_KINDS];
extern const expense_factor expense_factors[];

/* How often each kind is due in a cell of the scene; steps: load steps between stations, 0: the
 * scene's. */
void expense_count(const scene *s, int steps, double times[EXPENSE_KINDS]);
/* [s], about; elements: of each member. */
double expense_of_scene(const scene *s, int steps, const element_type *type, int elements);
double expense_of_cell(const sweep *s, int index, int mesh);
/* All cells of a sweep, tasks[sweep_cells]: those of dear series first, the dearest of all at the
 * beginning, so that only small ones are left to wait for at the end; then the others in the order
 * of the series, so that one after the other is whole while the rest is run. Of a series the finest
 * mesh first. Dear is what more than a hundredth of the work of one process goes into. 0: done;
 * -1: out of memory. */
int expense_order(const sweep *s, int jobs, workload_task tasks[]);

#endif
