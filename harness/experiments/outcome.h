/* What came of a formulation at an extreme, and what is expected although it is no value. */
#ifndef BEAMWORK_OUTCOME_H
#define BEAMWORK_OUTCOME_H

enum { OUTCOME_NEIGHBOURS = 2 };

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

/* What is expected although it is neither a value nor coarse (reference/extreme_findings.csv). */
typedef struct extreme_finding {
    char *extreme, *formulation, *quantity, *outcome, *proof; /* the first three may hold * and ? */
    double from, to;                                          /* of x, inclusive */
    int observed;
} extreme_finding;

typedef struct extreme_outcome {
    /* Indices: in the table, of its values, in the list of formulations, of its quantities. */
    int extreme, value, formulation, quantity;
    int point, series, neighbours; /* of the sweeps; series of the other meshes: -1: none */
    outcome_kind kind;
    double x, result, reference, error; /* NAN: none; error relative */
    /* On the other meshes; NAN: not needed, or no value. */
    double neighbour_error[OUTCOME_NEIGHBOURS];
    const extreme_finding *finding;
    int as_expected;
    const char *reason;
} extreme_outcome;

const char *outcome_name(outcome_kind kind);
int outcome_is_good(outcome_kind kind); /* a value, or coarse */

#endif
