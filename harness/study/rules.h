/* The ledger (reference/findings.csv): what is expected although it is not a pass, one rule for
 * each cause. */
#ifndef BEAMWORK_RULES_H
#define BEAMWORK_RULES_H

#include <hdf5.h>

#include "cases/case.h"

/* Lists are words separated by blanks, with * and ? for anything; one of them must fit. */
typedef struct rule {
    char *name;         /* one word */
    char *formulations; /* list: name with options ("beamw:mass=lumped"), or the bare name */
    char *cases;        /* list */
    char *condition;    /* terms joined by ';', all of which must hold; see rules_hold */
    char *quantities;   /* list */
    char *verdicts;     /* "wrong limit|undecided" */
    char *predicted;    /* list of "case/quantity" whose limit is predicted; empty: none */
    char *cause, *proof;
    /* relative, of the limit from the derived one, or from the truth where none was derived; beyond
     * it the rule does not explain */
    double largest_error;
    char *from;        /* of a table of one's own: "file:line"; NULL: of the ledger */
    int missed;        /* by the judge: 1: the run should have shown it and did not */
    int observed;      /* by the judge: verdicts it explains */
    unsigned foretold; /* by the judge: bits of the predictions that were met */
} rule;

/* What a rule may speak of. */
typedef struct rule_subject {
    const case_type *type;
    const double *parameter;
    unsigned features; /* enum element_feature: what the scene needs */
    const char *formulation, *quantity, *verdict;
} rule_subject;

/* A term of the condition is a feature that the scene needs ("shear", "not shear") or compares a
 * parameter of the case ("omega>0", "load=tip|mid", "tip_deflection!=0.015", also < <= >=); one
 * that the case does not have does not hold. */
int rules_hold(const rule *, const rule_subject *);

/* Is the formulation (its key) among those of the rule? */
int rules_speak_of(const rule *, const char *formulation);

/* Features of a scene that it asks for, in its condition; 0: none. */
unsigned rules_features(const rule *);
/* Notes that a verdict met a prediction which the rule names. */
void rules_foretell(rule *, const rule_subject *);
/* The first term of the condition that is neither a feature nor compares a parameter of its cases,
 * into word; cases ends with NULL. 0: there is none. */
enum { RULES_WORD = 128 };
int rules_bad_condition(const rule *, const case_type *const cases[], char word[RULES_WORD]);
/* Next word of a list into word; where the rest begins, NULL at the end. */
const char *rules_next_word(const char *list, char word[RULES_WORD]);
/* Has a verdict shown it, and verdicts all its predictions? */
int rules_is_observed(const rule *);

/* FAULT names a column that is damaged, or a rule whose condition means nothing. */
status rules_read(const char *path, hid_t file, rule **out, int *count, fault *f);
void rules_free(rule *, int count);

#endif
