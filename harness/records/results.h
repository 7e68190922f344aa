/* What a stored run found: errors and work, cell by cell, and in one line for each series of
 * meshes. Read back from results.h5, or from the short table of its series that can be committed.
 */
#ifndef BEAMWORK_RESULTS_H
#define BEAMWORK_RESULTS_H

#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/shared/status.h"

typedef enum results_work {
    WORK_ITERATIONS,
    WORK_EVALUATIONS,
    WORK_FACTORISATIONS,
    RESULTS_WORKS
} results_work;
extern const char *const results_work_names[RESULTS_WORKS];

/* Errors below this, relative to the truth, are round-off and the criterion of iterations. */
#define RESULTS_FLOOR 1e-8

enum { RESULTS_STATUS = 16, RESULTS_MOST_ELEMENTS = 10000000 };

typedef struct result_value {
    char quantity[SCENE_NAME];
    double value,
        near_zero; /* [unit of the quantity]; NAN: none; below near_zero it counts as zero */
    double error;  /* relative to the truth; NAN: no truth */
    double limit;  /* of the series, at its finest mesh of a default point; NAN: none */
} result_value;

typedef struct result_cell {
    char *name; /* case/parameters/formulation */
    int elements;
    char status[RESULTS_STATUS];
    long work[RESULTS_WORKS];
    double cost; /* of counted work [s], of a sweep; not positive or NAN: not known */
    int values;
    result_value *value;
} result_cell;

typedef struct result_mesh {
    int elements;
    char status[RESULTS_STATUS];
} result_mesh;

typedef struct result_limit {
    char quantity[SCENE_NAME];
    double value, near_zero; /* as of a value; near_zero 0: not known */
} result_limit;

/* Largest of the |errors| of one mesh. elements 0: no value has an error. */
typedef struct result_error {
    double size;
    int elements;
    char quantity[SCENE_NAME];
} result_error;

/* All meshes of a formulation at a parameter point. */
typedef struct result_series {
    char *name; /* case/parameters/formulation */
    int meshes, limits;
    result_mesh *mesh;        /* [meshes] ascending by elements */
    long work[RESULTS_WORKS]; /* sums over the meshes */
    int errors;               /* values that have one, of all meshes */
    double decades; /* sum of log10(|error| + RESULTS_FLOOR) over them: moves with every one */
    result_error least, largest; /* of the mesh where it is least; of all meshes */
    result_limit *limit;         /* [limits] of a default point, in the order of its quantities */
} result_series;

/* What a run says it was asked for: what lies outside was left out, not lost. NULL: all. */
typedef struct results_part {
    char *select;               /* expression of harness/formulations/formulations.h */
    char *cases, *formulations; /* a line each */
    char *fresh;                /* formulations that do not gate yet, a line each; NULL: none */
} results_part;

typedef struct stored_results {
    results_part part;
    int cells, seriess;
    int whole;             /* 1: with cells, 0: with series only */
    int limits;            /* 1: limits were judged */
    int swept;             /* 1: a sweep; its cells of no mesh have the references of a point */
    result_cell *cell;     /* ascending by name and elements */
    result_series *series; /* ascending by name */
} stored_results;

/* HDF5 or table, told apart by the first bytes. FAULT: missing, truncated, foreign or damaged, or
 * a sweep. */
status results_read(const char *path, stored_results *out, fault *f);
/* The same of an experiment: "verify", "bench", or "sweep", which has no series; NULL: the first of
 * these that is there. */
status results_read_any(const char *path, const char *experiment, stored_results *out, fault *f);
void results_free(stored_results *r);

/* A zeroed one at the end, or NULL. */
result_cell *results_add(stored_results *r);
result_series *results_add_series(stored_results *r);
result_mesh *results_add_mesh(result_series *s);
result_limit *results_add_limit(result_series *s);

int results_order(const result_cell *a, const result_cell *b); /* of name, then elements */
/* Fills the series from the cells, which are in order. FAULT: out of memory. */
status results_series_summarise(stored_results *r, fault *f);

/* Is the text one of the lines? lines NULL: no. */
int results_part_has(const char *lines, const char *text);
/* Was the quantity of a series (case/parameters/formulation) asked for? */
int results_part_selects(const results_part *p, const char *series, const char *quantity);
/* Was a series that `other` alone has asked for, of the run r: any of its quantities, as the two
 * know them? */
int results_part_wants(const stored_results *r, const stored_results *other, const char *series);
/* Were other quantities of a series asked for in one run than in the other, as the two know them?
 */
int results_part_differ(const stored_results *a, const stored_results *b, const char *series);
/* Is its formulation new to the run? */
int results_part_is_fresh(const results_part *p, const char *series);
void results_part_free(results_part *);

status results_hdf5_read(const char *path, const char *experiment, stored_results *out, fault *f);
status results_table_read(const char *path, FILE *from, stored_results *out, fault *f);
void results_table_write(FILE *to, const stored_results *r);

#endif
