/* An experiment: planned, run, judged, and what is found written as asked, by one function for all.
 * What it leaves are tables of records, from whose fields its group of a file of results, JSON and
 * CSV are written; or the cells of a sweep with their verdicts. */
#ifndef BEAMWORK_EXPERIMENT_H
#define BEAMWORK_EXPERIMENT_H

#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/records/records.h"

typedef struct experiment_cells {
    const sweep *sweep;
    const judgement *judged;
    const environment *made;
} experiment_cells;

typedef struct experiment_type {
    const char *name; /* of its group */
    /* One after the other; NULL: nothing. asked: its own request; found: what the next one takes.
     */
    status (*plan)(const void *asked, void *found, fault *f);
    status (*run)(const void *asked, void *found, fault *f);
    status (*judge)(const void *asked, void *found, fault *f);
    /* Its tables; ends with NULL. NULL: it leaves cells. */
    const record_type *const *records;
    const record_type *about; /* one record of the whole run; NULL: none */
    const record_type *rows;  /* that of the records which CSV shows; NULL: there is no CSV */
    /* Adds the records of that type of what was found. */
    void (*gather)(const void *found, const record_type *type, subjects *out);
    void (*print)(FILE *to, const void *found); /* for people */
    /* Of one that leaves cells: these, and all its forms. */
    experiment_cells (*cells)(const void *found);
    status (*write)(FILE *to, const char *format, const void *found, fault *f);
} experiment_type;

typedef struct experiment_output {
    const char *results; /* file that its group goes into, where those of others stay; NULL: none */
    const char *text, *format; /* NULL: standard output; "text", "csv", "json" */
    const char *json;          /* a file besides; NULL: none */
} experiment_output;

/* As -o, --format and --json ask: a name that ends in .h5 or .hdf5 is a file of results. */
experiment_output experiment_output_of(const char *path, const char *format, const char *json);

status experiment_plan(const experiment_type *, const void *asked, void *found, fault *f);
/* After the plan: all the rest. */
status experiment_run(const experiment_type *, const void *asked, const experiment_output *,
                      void *found, fault *f);
/* Both. */
status experiment_do(const experiment_type *, const void *asked, const experiment_output *,
                     void *found, fault *f);
#endif
