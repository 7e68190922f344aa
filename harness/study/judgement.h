/* The judge: case x point x formulation x quantity against truths and expected verdicts. */
#ifndef BEAMWORK_JUDGEMENT_H
#define BEAMWORK_JUDGEMENT_H

#include "harness/study/verdict.h"

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

/* A formulation that does not keep the contract of the interface (elements/element.h). */
typedef struct breach {
    char formulation[FORMULATION_KEY];
    char why[FAULT_TEXT]; /* the first claim that is broken */
} breach;

/* A mesh, or a series, that is worse than in a former run. */
typedef struct regression {
    char of[FAULT_TEXT]; /* case/parameters/formulation, and the mesh */
    char why[FAULT_TEXT];
} regression;

enum { COVERAGE_MESHES = 4 };

/* How often the limits of a formulation on a case lie within their uncertainty of an exact truth,
 * without the k finest meshes: the check of the uncertainties themselves. A formulation with limits
 * of its own covers less: that is no fault of the uncertainties. */
typedef struct coverage {
    const case_type *of;
    const element_type *type;
    int point; /* the first of the case in the sweep */
    /* [k]; series with three meshes or more left */
    int series[COVERAGE_MESHES], covered[COVERAGE_MESHES];
} coverage;

typedef struct judgement {
    int verdicts, agreements, coverages, flaws;
    verdict *verdict;
    agreement *agreement;
    coverage *coverage;
    flaw *flaw; /* [flaws] */
    int breaches;
    breach *breach; /* [breaches] */
    int regressions;
    regression *regression; /* [regressions] */
    int by_kind[VERDICT_KINDS];
    int unexpected; /* verdicts that differ from the expected one */
    int is_new;     /* verdicts of new formulations, which do not gate ... */
    int proposed;   /* ... and those among them that would need a finding */
    int disagreements;
    int judged; /* verdicts that compare with a truth */
    /* rules that no verdict showed, or predictions of theirs: of the ledger (whole runs only), of
     * one's own (missed.h) */
    int unobserved;
    int unmet; /* truths that speak of no case, point or quantity there is (whole runs only) */
    /* truths that every formulation skips, or of one that is not here (whole runs only) */
    int waiting;
    int unread; /* truths of motions at instants that the run does not read (whole runs only) */
} judgement;

/* 1: verdicts of the series may turn on the noise of its finest mesh, which is then worth
 * measuring. */
int judgement_doubts(const sweep *s, const truths *t, int series_index);
/* Begins with the planned series, which are then judged one by one, in their order, when they have
 * been run. FAULT when a truth has another unit than its quantity. */
status judgement_begin(const sweep *s, truths *t, judgement *out, fault *f);
status judgement_add(const sweep *s, truths *t, int series_index, judgement *out, fault *f);
/* whole: 1 when nothing was selected away, so that a rule nobody observed and a truth that speaks
 * of nothing are failures. */
void judgement_end(const sweep *s, truths *t, int whole, judgement *out);
/* All three. */
status judgement_make(const sweep *s, truths *t, int whole, judgement *out, fault *f);
void judgement_free(judgement *j);
enum { JUDGED_AS_EXPECTED = 0, JUDGED_DIFFERS = 1, JUDGED_NOTHING = 3 };
/* Exit code: 0 as expected, 1 something that gates differs, 3 nothing was judged. Everything that
 * says how a run ended asks here. */
int judgement_exit(const judgement *j);
/* "pass", "fail", "nothing was judged". */
const char *judgement_outcome(const judgement *j);

#endif
