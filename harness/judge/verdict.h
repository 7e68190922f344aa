/* The judge: case x point x formulation x quantity against the truths, and the expected verdicts. */
#ifndef BEAMWORK_VERDICT_H
#define BEAMWORK_VERDICT_H

#include <stddef.h>

#include "harness/judge/convergence.h"
#include "harness/study/sweep.h"

typedef enum verdict_kind {
    VERDICT_PASS,
    VERDICT_WRONG_LIMIT, /* converges, but not to the truth */
    VERDICT_LOW_ORDER,
    VERDICT_NOT_ASYMPTOTIC, /* the meshes do not show a limit yet */
    VERDICT_DIVERGED,       /* a mesh has no value: not converged, singular, crashed */
    VERDICT_REFUSED,
    VERDICT_SKIP, /* needs what the formulation does not offer */
    VERDICT_NO_TRUTH,
    VERDICT_KINDS
} verdict_kind;

typedef struct verdict {
    int series, quantity; /* into the sweep, into the scene's quantities */
    verdict_kind kind, expected;
    const truth *truth, *model_truth; /* NULL: none */
    convergence fit;
    double finest;      /* value on the finest mesh, NAN: none */
    double error;       /* (limit - truth)/truth, relative to near_zero where the truth is near zero; NAN */
    double model_error; /* against the truth of another model */
    double tolerance;   /* absolute, uncertainty included */
    int matches;        /* 1: verdict as expected */
    const finding *finding;
    char reason[FAULT_TEXT];
} verdict;

/* A value of one mesh against its own stored discrete value. */
typedef struct agreement {
    int series, mesh, quantity;
    const truth *truth;
    double value;
    int good;
} agreement;

typedef struct judgement {
    int verdicts, agreements;
    verdict *verdict;
    agreement *agreement;
    int by_kind[VERDICT_KINDS];
    int unexpected; /* verdicts that differ from the expected one */
    int disagreements;
    int judged;     /* verdicts that compare with a truth */
    int unobserved; /* findings that no verdict showed (whole runs only) */
    int unmet;      /* truths that speak of no case, point or quantity there is (whole runs only) */
    int waiting;    /* truths that every formulation skips, or of a formulation that is not here (whole runs only) */
} judgement;

const char *verdict_name(verdict_kind kind);
/* The verdict in words: "converges to a wrong limit: +0.115 %". */
void verdict_sentence(const verdict *v, double least_order, char *text, size_t size);
/* What the series shows of the quantity, both given in v: kind, fit, errors, and as expected what holds without findings. */
void verdict_reach(const sweep *s, const truths *t, verdict *v);
/* FAULT when a truth has another unit than its quantity. whole: 1 when nothing was selected away, so that a finding nobody observed and a truth that
 * speaks of nothing are failures. */
status judge(const sweep *s, truths *t, int whole, judgement *out, fault *f);
void judgement_free(judgement *j);
/* Exit code: 0 as expected, 1 a verdict differs, 3 nothing was checked. */
int judgement_exit(const judgement *j);

/* Relative error of a value of a quantity against a truth. */
double relative_error(const scene_quantity *q, double value, double truth_value);

#endif
