/* The judge: case x point x formulation x quantity against the truths, and the expected verdicts. */
#ifndef BEAMWORK_VERDICT_H
#define BEAMWORK_VERDICT_H

#include <stddef.h>

#include "harness/judge/limit.h"
#include "harness/study/sweep.h"

typedef enum verdict_kind {
    VERDICT_PASS,
    VERDICT_BIASED,       /* within the tolerance, but surely a limit of its own */
    VERDICT_WRONG_LIMIT,  /* a limit surely beyond the tolerance */
    VERDICT_AS_PREDICTED, /* either of the two, and the limit is the one derived for the formulation */
    VERDICT_LOW_ORDER,
    VERDICT_UNDECIDED, /* the limit is not known well enough for any of the others */
    VERDICT_DIVERGED,  /* the finest mesh has no value: not converged, singular, crashed */
    VERDICT_REFUSED,
    VERDICT_SKIP,     /* needs what the formulation does not offer */
    VERDICT_NO_TRUTH, /* none of its own theory of shear, at least */
    VERDICT_KINDS
} verdict_kind;

typedef struct verdict {
    int series, quantity; /* into the sweep, into the scene's quantities */
    verdict_kind kind, expected;
    const truth *truth;        /* to judge by: of the same model and the formulation's theory of shear; NULL: none */
    const truth *model_truth;  /* of another model, or of another theory where there is none to judge by; NULL: none */
    const truth *predicted;    /* the limit that was derived for the formulation; NULL: none */
    const truth *contradicted; /* a published value that the limit differs from by more than both are uncertain; NULL: none */
    mesh_limit fit;
    double finest;      /* value on the finest mesh, NAN: none */
    double error;       /* (limit - truth)/truth, relative to near_zero where the truth is near zero; NAN */
    double model_error; /* against the truth of another model */
    double tolerance;   /* absolute, uncertainty of the truth included */
    int below_digits;   /* 1: the limit differs from the truth by less than the truth is uncertain */
    int matches;        /* 1: verdict as expected */
    const rule *rule;   /* the one that explains what is not a pass; NULL: none */
    char reason[FAULT_TEXT];
} verdict;

/* A value of one mesh against its own stored discrete value. */
typedef struct agreement {
    int series, mesh, quantity;
    const truth *truth;
    double value;
    int good;
} agreement;

/* A cell whose record contradicts itself (sound.h). */
typedef struct flaw {
    int series, mesh;
    char why[FAULT_TEXT];
} flaw;

enum { COVERAGE_MESHES = 4 };

/* How often the limits of a formulation on a case lie within their uncertainty of an exact truth, without the k finest meshes: the check
 * of the uncertainties themselves. A formulation with limits of its own covers less: that is no fault of the uncertainties. */
typedef struct coverage {
    const case_type *of;
    const element_type *type;
    int point;                                             /* the first of the case in the sweep */
    int series[COVERAGE_MESHES], covered[COVERAGE_MESHES]; /* [k]; series with three meshes or more left */
} coverage;

typedef struct judgement {
    int verdicts, agreements, coverages, flaws;
    verdict *verdict;
    agreement *agreement;
    coverage *coverage;
    flaw *flaw; /* [flaws] */
    int by_kind[VERDICT_KINDS];
    int unexpected; /* verdicts that differ from the expected one */
    int disagreements;
    int judged;     /* verdicts that compare with a truth */
    int unobserved; /* rules of the ledger that no verdict showed, or predictions of theirs (whole runs only) */
    int unmet;      /* truths that speak of no case, point or quantity there is (whole runs only) */
    int waiting;    /* truths that every formulation skips, or of a formulation that is not here (whole runs only) */
} judgement;

const char *verdict_name(verdict_kind kind);
/* The verdict in words: "converges to a wrong limit: +0.115 %". */
void verdict_sentence(const verdict *v, double least_order, char *text, size_t size);
/* Limit of a quantity of a series, without its `left_out` finest meshes. */
mesh_limit verdict_limit(const sweep *s, int series_index, int quantity, int left_out);
/* The truth that a formulation is judged by: of the same model and of its own theory of shear; or NULL. */
const truth *verdict_truth(const truths *t, const point *p, const formulation *chosen, int quantity);
/* What the series shows of the quantity, both given in v: kind, fit, errors, and as expected what holds without the ledger. */
void verdict_reach(const sweep *s, const truths *t, verdict *v);
/* Series whose verdicts may turn on the noise of their finest mesh, which is then worth measuring: wanted[seriess], 0 or 1. */
void judge_doubts(const sweep *s, const truths *t, char wanted[]);
/* FAULT when a truth has another unit than its quantity. whole: 1 when nothing was selected away, so that a rule nobody observed and a truth that
 * speaks of nothing are failures. */
status judge(const sweep *s, truths *t, int whole, judgement *out, fault *f);
/* Fills the coverages from the verdicts. */
status judge_coverage(const sweep *s, judgement *out, fault *f);
void judgement_free(judgement *j);
/* Exit code: 0 as expected, 1 a verdict differs, 3 nothing was checked. */
int judgement_exit(const judgement *j);

/* Relative error of a value of a quantity against a truth. */
double relative_error(const scene_quantity *q, double value, double truth_value);

#endif
