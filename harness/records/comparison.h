/* Two stored runs side by side: what became worse, better, or is there in one of them only. Whole
 * runs, and sweeps, cell by cell and quantity by quantity, else series by series. No truth is
 * involved: a former run says nothing of what is right, only that something has changed. */
#ifndef BEAMWORK_COMPARISON_H
#define BEAMWORK_COMPARISON_H

#include "harness/records/results.h"

typedef struct comparison_limits {
    double error; /* relative change of an error */
    double floor; /* change of a value relative to its truth that is round-off */
    double
        work; /* relative change of a count of one mesh; of a series: of the mean of its meshes */
} comparison_limits;
/* Where nothing else is said. */
extern const comparison_limits comparison_limits_default;

typedef enum comparison_kind {
    CHANGE_WORSE,
    CHANGE_BETTER,
    CHANGE_OTHER,
    CHANGE_GONE,
    CHANGE_NEW,
    COMPARISON_KINDS
} comparison_kind;
extern const char *const comparison_kind_names[COMPARISON_KINDS];

typedef struct comparison {
    int whole;                     /* 1: cell by cell; 0: series by series */
    int judged;                    /* 1: both have limits */
    int swept;                     /* 1: sweeps */
    int pairs;                     /* cells or series in both */
    int count[COMPARISON_KINDS];   /* lines of each kind */
    double work[2][RESULTS_WORKS]; /* sums over the pairs: old | new */
    double cost[2];                /* of counted work [s], of sweeps */
    /* series that are in one only, old | new, and are no change: outside what the other run was
     * asked for; of formulations that do not gate yet */
    int outside[2], fresh[2];
    int partial; /* series of which some quantities were left out of one: neither their errors nor
                    their work are compared */
} comparison;

/* "error=0.01,floor=1e-8,work=0.02", any of them. REFUSED names the culprit. */
status comparison_limits_parse(const char *text, comparison_limits *out, fault *f);
/* Writes one line for each difference. What lies outside the selection of one of the two is
 * counted, not written, and so are series of new formulations in one of them. Names that `select`
 * (of study.h; NULL: all) does not hold for are left out. */
void comparison_run(FILE *to, const stored_results *before, const stored_results *after,
                    const comparison_limits *limits, const char *select, comparison *out);
int comparison_differs(const comparison *c);

#endif
