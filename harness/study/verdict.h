/* What a quantity of a series shows against its truth. */
#ifndef BEAMWORK_VERDICT_H
#define BEAMWORK_VERDICT_H

#include <stddef.h>

#include "harness/study/limit.h"
#include "harness/study/sweep.h"

typedef enum verdict_kind {
    VERDICT_PASS,
    VERDICT_BIASED,      /* within the tolerance, but surely a limit of its own */
    VERDICT_WRONG_LIMIT, /* a limit surely beyond the tolerance */
    /* the same two where the limit is the one derived for the formulation */
    VERDICT_BIASED_AS_PREDICTED,
    VERDICT_WRONG_AS_PREDICTED,
    VERDICT_LOW_ORDER,
    VERDICT_UNDECIDED, /* the limit is not known well enough for any of the others */
    VERDICT_DIVERGED,  /* the finest mesh has no value: not converged, singular, crashed */
    VERDICT_REFUSED,
    VERDICT_SKIP,        /* needs what the formulation does not offer */
    VERDICT_NO_TRUTH,    /* none of its own theory of shear, at least */
    VERDICT_OTHER_MODEL, /* without physics of the scene that change what is asked for */
    VERDICT_KINDS
} verdict_kind;

typedef struct verdict {
    int series, quantity; /* into the sweep, into the scene's quantities */
    verdict_kind kind, expected;
    /* to judge by: of the same model and the formulation's theory of shear; NULL: none */
    const truth *truth;
    /* of another model, or of another theory or an agreement of formulations where there is none to
     * judge by; NULL: none */
    const truth *model_truth;
    const truth *predicted; /* the limit that was derived for the formulation; NULL: none */
    /* a published value that the limit differs from by more than both are uncertain; NULL: none */
    const truth *contradicted;
    mesh_limit fit;
    double finest; /* value on the finest mesh, NAN: none */
    /* (limit - truth)/truth, relative to near_zero where the truth is near zero; NAN */
    double error;
    double departure;   /* the same of the limit from the derived one; from the truth without one */
    double model_error; /* against the truth of another model */
    /* absolute, uncertainty of the truth and what is not modelled included */
    double tolerance;
    double unmodelled; /* absolute: bound of what physics that is left out changes */
    /* 1: the limit differs from the truth by less than the truth is uncertain */
    int below_digits;
    int matches;       /* 1: verdict as expected */
    int needs_finding; /* 1: of a formulation that is new or was named: no pass, and no rule of the
                          ledger says so */
    const rule *rule;  /* the one that explains what is not a pass; NULL: none */
    char reason[FAULT_TEXT];
} verdict;

const char *verdict_name(verdict_kind kind);
/* Verdicts on a limit that is another one than the truth. */
enum { VERDICT_DEFECTS = 4 };
extern const verdict_kind verdict_defects[VERDICT_DEFECTS];
/* Does the rule explain one of them? */
int verdict_tells_defect(const rule *);
/* What the order of a quantity depends on. */
element_analysis verdict_analysis(const scene *, const scene_quantity *);
/* Limit of a quantity of a series, without its `left_out` finest meshes. */
mesh_limit verdict_limit(const sweep *s, int series_index, int quantity, int left_out);
/* The truth that a formulation is judged by: of the same model and of its own theory of shear; or
 * NULL. */
const truth *verdict_truth(const truths *t, const sweep_point *p, const formulation *chosen,
                           int quantity);
/* The same, or where there is none what formulations agree on: it informs and never gates. */
const truth *verdict_reference(const truths *t, const sweep_point *p, const formulation *chosen,
                               int quantity);
/* What the series shows of the quantity, both given in v: kind, fit, errors, and as expected what
 * holds without the ledger. */
void verdict_reach(const sweep *s, const truths *t, verdict *v);
/* Relative error of a value of a quantity against a truth. */
double verdict_error(const scene_quantity *q, double value, double truth_value);

#endif
