/* Questions to formulations, and what became of them: for tests that walk over all formulations.
 * A question is a case or a scene on a mesh; its answer says whether the formulation supports the
 * physics of the scene, and a tally of the answers fails a test that would otherwise have checked
 * nothing. */
#ifndef BEAMWORK_TEST_ASK_H
#define BEAMWORK_TEST_ASK_H

#include "cases/case.h"
#include "cases/scene/scene.h"
#include "harness/analysis/analysis.h"

enum { ASK_QUANTITIES = 256, ASK_POINTS = 16 };

typedef enum ask_outcome {
    ASK_ANSWERED,    /* solved */
    ASK_NOT_OFFERED, /* the scene needs what the type does not declare (missing_words) */
    ASK_NOT_POSED,   /* the change of the scene is not defined for it, whatever the formulation */
    ASK_REFUSED,     /* offered, and refused by name */
    ASK_FAILED,      /* offered, and no value */
    ASK_OUTCOMES
} ask_outcome;

/* Values in the order of the scene's quantities; of a failure those that were found. */
typedef struct answer {
    ask_outcome outcome;
    status status;
    int count, members;
    int values;                   /* of them that exist */
    double value[ASK_QUANTITIES]; /* SI; NAN where the mesh has none */
    double scale[ASK_QUANTITIES]; /* below this a value counts as zero; 0: never */
    int points[ASK_QUANTITIES];   /* of a curve over stations, the first ASK_POINTS; else 0 */
    double curve[ASK_QUANTITIES][ASK_POINTS];
    char name[ASK_QUANTITIES][SCENE_NAME];
    char why[ASK_QUANTITIES][FAULT_TEXT]; /* why there is no value */
    char reason[FAULT_TEXT];
} answer;

typedef struct question {
    const case_type *type;
    const char *parameters; /* "name=value;...", NULL: defaults */
    const element_type *formulation;
    int elements; /* of each member */
    int keep_all;
    scene_edit edit;
} question;

/* 1: the type declares all that the scene needs: it may not refuse it. */
int ask_offered(const scene *, const element_type *);
/* Options of the formulation are the defaults. */
void ask(const question *, answer *);
/* A scene of the test's own, with given options (NULL: the defaults). */
void ask_scene(const scene *, const element_type *, const double option[], int elements, answer *);
/* NAN when there is none of that name. */
double answer_of(const answer *, const char *quantity);

/* Outcomes of the questions of one test to one formulation. */
typedef struct ask_tally {
    int count[ASK_OUTCOMES];
    int values;               /* in all answers */
    int most_refused;         /* refusals of what is supported that the test allows */
    char failure[FAULT_TEXT]; /* the last failure and its question */
    char refusal[FAULT_TEXT]; /* the last refusal and its question */
} ask_tally;

/* Counts the answer; returns 1 where there is one, else 0. `what` (printf style) names the question
 * in failures. */
int ask_count(ask_tally *, const answer *, const char *what, ...)
    __attribute__((format(printf, 3, 4)));
/* Fails when an answer failed, when more were refused than allowed, and when no value was found
 * although one was offered; says how many of each there were. */
void ask_conclude(const ask_tally *, const element_type *, const char *test);

#endif
