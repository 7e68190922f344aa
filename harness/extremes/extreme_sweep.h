/* Every formulation at every extreme: a value with its error, or a named refusal or failure, and never a silent wrong number. */
#ifndef BEAMWORK_EXTREME_SWEEP_H
#define BEAMWORK_EXTREME_SWEEP_H

#include "cases/extremes/extreme.h"
#include "harness/schema/schema.h"

typedef enum outcome_kind {
    OUTCOME_VALUE,  /* within the extreme's tolerance */
    OUTCOME_COARSE, /* outside it, but the error falls with more elements: a discretisation error */
    OUTCOME_WRONG,  /* a number that is neither */
    OUTCOME_NOT_CONVERGED,
    OUTCOME_SINGULAR,
    OUTCOME_REFUSED,
    OUTCOME_NO_VALUE, /* the mesh has no such mode, load or state */
    OUTCOME_FAULT,    /* crashed, or out of memory */
    OUTCOME_SKIP,     /* needs what the formulation does not offer */
    OUTCOME_KINDS
} outcome_kind;

enum { EXTREME_NEIGHBOURS = 2 };

/* What is expected although it is neither a value nor coarse (reference/extreme_findings.csv). */
typedef struct extreme_finding {
    char *extreme, *formulation, *quantity, *outcome, *proof; /* the first three may hold * and ? */
    double from, to;                                          /* of x, inclusive */
    int observed;
} extreme_finding;

typedef struct extreme_outcome {
    int extreme, value, formulation, quantity; /* indices: table, its values, list of formulations, its quantities */
    int point, series, neighbours;             /* of the sweeps; neighbours: series of the other meshes, or -1 */
    outcome_kind kind;
    double x, result, reference, error;        /* NAN: none; error relative */
    double neighbour_error[EXTREME_NEIGHBOURS]; /* on the other meshes; NAN: not needed, or no value */
    const extreme_finding *finding;
    int as_expected;
    const char *reason;
} extreme_outcome;

/* Of one formulation; a cell is an extreme at one value of x, and as bad as its worst quantity. */
typedef struct extreme_count {
    int tried, survived, coarse, named, wrong, faults;
} extreme_count;

typedef struct extreme_sweep {
    int formulations, outcomes, findings, unexpected, unobserved;
    formulation *formulation;
    sweep first, neighbours;
    extreme_outcome *outcome;
    extreme_finding *finding;
    extreme_count *count; /* [formulations] */
} extreme_sweep;

typedef struct extreme_request {
    const char *select; /* expression over "name/group/case/formulation", or NULL */
    int jobs, formulations;
    const formulation *formulation; /* restrict to these; 0: all */
    FILE *progress;
} extreme_request;

const char *outcome_name(outcome_kind kind);
/* Reads the exact values and findings of the packed truths at `path`, runs and judges. */
status extreme_sweep_run(const extreme_request *request, const char *path, extreme_sweep *out, fault *f);
void extreme_sweep_free(extreme_sweep *s);
/* Exit code: 0 as expected, 1 an outcome differs, 3 nothing was tried. */
int extreme_sweep_exit(const extreme_sweep *s);

/* Parts of extreme_sweep_run. */
/* A point for every extreme and value, in order, with a series for every formulation; an outcome for each of its quantities. */
status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f);
status extreme_expect_read(const char *path, extreme_sweep *out, fault *f);
void extreme_expect(extreme_sweep *s, int whole);
const cell_result *outcome_cell(const extreme_sweep *s, const extreme_outcome *o);

/* Writers. */
extern const record_type record_extreme;
subject extreme_record_subject(const extreme_sweep *s, const extreme_outcome *o); /* of record_extreme */
void extreme_table(FILE *to, const extreme_sweep *s);
void extreme_table_csv(FILE *to, const extreme_sweep *s);
status extreme_json(FILE *to, const extreme_sweep *s, fault *f);

#endif
