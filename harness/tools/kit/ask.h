/* Questions to formulations and their outcomes, for tests with all formulations. */
#ifndef BEAMWORK_TEST_ASK_H
#define BEAMWORK_TEST_ASK_H

#include "cases/case.h"
#include "cases/scene/scene.h"
#include "harness/analysis/analysis.h"

enum { ASK_QUANTITIES = 256, ASK_POINTS = 16 };

typedef enum ask_outcome {
    ASK_ANSWERED,
    ASK_NOT_OFFERED,
    /* the edit of the question is not defined for this scene, regardless of the formulation */
    ASK_NOT_POSED,
    ASK_REFUSED,
    ASK_FAILED,
    ASK_OUTCOMES
} ask_outcome;

/* Answer to a question. Values are in the order of the quantities of the scene. After a failure,
 * only the values that were found are set. */
typedef struct answer {
    ask_outcome outcome;
    status status;
    int count, members;
    int values;                   /* number of existing values */
    double value[ASK_QUANTITIES]; /* values in SI units; NAN: the mesh has no value */
    /* magnitude below which a value counts as zero; 0: no value counts as zero */
    double scale[ASK_QUANTITIES];
    /* number of points of a curve over stations, at most ASK_POINTS; otherwise 0 */
    int points[ASK_QUANTITIES];
    double curve[ASK_QUANTITIES][ASK_POINTS];
    char name[ASK_QUANTITIES][SCENE_NAME];
    char why[ASK_QUANTITIES][FAULT_TEXT]; /* reason why there is no value */
    char reason[FAULT_TEXT];
} answer;

typedef struct question {
    const case_type *type;
    const char *parameters; /* "name=value;...", NULL: defaults */
    const element_type *formulation;
    int elements; /* per member */
    int keep_all;
    scene_edit edit;
} question;

/* Returns 1 if the type declares everything that the scene requires. The type must not reject such
 * a scene. */
int ask_offered(const scene *, const element_type *);
void ask(const question *, answer *);
/* Asks a question with a scene of the test and given options (NULL: the defaults). */
void ask_scene(const scene *, const element_type *, const double option[], int elements, answer *);
/* Returns the value of a quantity; NAN: there is no quantity with this name. */
double answer_of(const answer *, const char *quantity);

typedef struct ask_tally {
    int count[ASK_OUTCOMES];
    int values;               /* number of values in all answers */
    int most_refused;         /* number of rejections of supported features that the test allows */
    char failure[FAULT_TEXT]; /* last failure, with its question */
    char refusal[FAULT_TEXT]; /* last rejection, with its question */
} ask_tally;

/* Counts the answer. Returns 1 if the question was answered, otherwise 0. what: name of the
 * question in failures (a printf format). */
int ask_count(ask_tally *, const answer *, const char *what, ...)
    __attribute__((format(printf, 3, 4)));
/* Fails the test if an answer failed, if more answers were rejected than allowed, or if no value
 * was found although the physics is supported. */
void ask_conclude(const ask_tally *, const element_type *, const char *test);

#endif
