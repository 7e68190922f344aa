/* What a stored run found, cell by cell: errors and work. Read back from results.h5, or from the short table of it that can be committed. */
#ifndef BEAMWORK_RESULTS_H
#define BEAMWORK_RESULTS_H

#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/math/status.h"

typedef enum results_work { WORK_ITERATIONS, WORK_EVALUATIONS, WORK_FACTORISATIONS, RESULTS_WORKS } results_work;
extern const char *const results_work_names[RESULTS_WORKS];

/* Errors below this, relative to the truth, are round-off and the criterion of iterations. */
#define RESULTS_FLOOR 1e-8

typedef struct result_value {
    char quantity[SCENE_NAME];
    double value, near_zero; /* [unit of the quantity]; NAN: no value; below near_zero it counts as zero */
    double error;            /* relative to the truth; NAN: no truth */
} result_value;

/* All errors of a cell in three numbers. */
typedef struct result_summary {
    int judged;                /* values that have an error */
    double decades;            /* sum of log10(|error| + RESULTS_FLOOR) over them: moves with every one */
    double worst;              /* largest |error|; 0: none */
    char quantity[SCENE_NAME]; /* that has it */
} result_summary;

typedef struct result_cell {
    char *name; /* case/parameters/formulation */
    int elements;
    char status[16];
    long work[RESULTS_WORKS];
    result_summary summary;
    int values; /* 0: the short table has none */
    result_value *value;
} result_cell;

typedef struct results {
    int cells, whole;  /* whole: 1 with the values, 0 with summaries only */
    result_cell *cell; /* ascending by name and elements */
} results;

/* HDF5 or table, told apart by the first bytes. FAULT: missing, truncated, foreign or damaged. */
status results_read(const char *path, results *out, fault *f);
void results_free(results *r);
int results_order(const result_cell *a, const result_cell *b); /* of name, then elements */

/* A zeroed cell at the end, or NULL. */
result_cell *results_add(results *r);
void results_summarise(result_cell *cell);
status results_read_hdf5(const char *path, results *out, fault *f);
status results_read_table(const char *path, FILE *from, results *out, fault *f);
void results_write_table(FILE *to, const results *r);

#endif
