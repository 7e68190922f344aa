/* Every formulation at every extreme: a value with its error, or a named refusal or failure, and never a silent wrong number. */
#ifndef BEAMWORK_STRESS_H
#define BEAMWORK_STRESS_H

#include "cases/extremes/extreme.h"
#include "harness/schema/schema.h"

typedef enum stress_kind {
    STRESS_VALUE,  /* within the extreme's tolerance */
    STRESS_COARSE, /* outside it, but the error falls with more elements: a discretisation error */
    STRESS_WRONG,  /* a number that is neither */
    STRESS_NOT_CONVERGED,
    STRESS_SINGULAR,
    STRESS_REFUSED,
    STRESS_NO_VALUE, /* the mesh has no such mode, load or state */
    STRESS_FAULT,    /* crashed, or out of memory */
    STRESS_SKIP,     /* needs what the formulation does not offer */
    STRESS_KINDS
} stress_kind;

enum { STRESS_NEIGHBOURS = 2 };

/* What is expected although it is neither a value nor coarse (reference/extreme_findings.csv). */
typedef struct stress_finding {
    char *extreme, *formulation, *quantity, *outcome, *proof; /* the first three may hold * and ? */
    double from, to;                                          /* of x, inclusive */
    int observed;
} stress_finding;

typedef struct stress_outcome {
    int extreme, value, formulation, quantity; /* indices: table, its values, list of formulations, its quantities */
    int point, series, neighbours;             /* of the sweeps; neighbours: series of the other meshes, or -1 */
    stress_kind kind;
    double x, result, reference, error;        /* NAN: none; error relative */
    double neighbour_error[STRESS_NEIGHBOURS]; /* on the other meshes; NAN: not needed, or no value */
    const stress_finding *finding;
    int as_expected;
    const char *reason;
} stress_outcome;

/* Of one formulation; a cell is an extreme at one value of x, and as bad as its worst quantity. */
typedef struct stress_count {
    int tried, survived, coarse, named, wrong, faults;
} stress_count;

typedef struct stress {
    int formulations, outcomes, findings, unexpected, unobserved;
    formulation *formulation;
    sweep first, neighbours;
    stress_outcome *outcome;
    stress_finding *finding;
    stress_count *count; /* [formulations] */
} stress;

typedef struct stress_request {
    const char *select; /* expression over "name/group/case/formulation", or NULL */
    int jobs, formulations;
    const formulation *formulation; /* restrict to these; 0: all */
    FILE *progress;
} stress_request;

const char *stress_name(stress_kind kind);
/* Reads the exact values and findings of the packed truths at `path`, runs and judges. */
status stress_run(const stress_request *request, const char *path, stress *out, fault *f);
void stress_free(stress *s);
/* Exit code: 0 as expected, 1 an outcome differs, 3 nothing was tried. */
int stress_exit(const stress *s);

/* Parts of stress_run. */
/* A point for every extreme and value, in order, with a series for every formulation; an outcome for each of its quantities. */
status stress_plan(const stress_request *request, stress *out, fault *f);
status stress_findings_read(const char *path, stress *out, fault *f);
void stress_expect(stress *s, int whole);
const cell_result *stress_cell(const stress *s, const stress_outcome *o);

/* Writers. */
extern const record_type record_extreme;
subject stress_subject(const stress *s, const stress_outcome *o); /* of record_extreme */
void stress_table(FILE *to, const stress *s);
void stress_csv(FILE *to, const stress *s);
status stress_json(FILE *to, const stress *s, fault *f);

#endif
