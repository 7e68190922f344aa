/* NAME=VALUE: the one text form of what a user chooses, parameters of a case as well as options of
 * a formulation. */
#ifndef BEAMWORK_ASSIGNMENT_H
#define BEAMWORK_ASSIGNMENT_H

#include "elements/shared/parameter.h"
#include "elements/shared/status.h"

/* Tables, one behind the other, and the words of refusals. */
typedef struct assignment_list {
    const parameter_type *part[PARAMETER_PARTS];
    const char *what;     /* "parameter" */
    const char *owner;    /* the case or the formulation */
    const char *option;   /* of `beamwork list`, before the next: "--scene " or "" */
    const char *shown_by; /* argument of `beamwork list` that shows them */
    char separator;       /* between assignments */
} assignment_list;

enum { ASSIGNMENT_SHOWN = 256 };
/* What stands behind `beamwork list` to show them, as a shell reads it. */
void assignment_shown(const assignment_list *, char out[ASSIGNMENT_SHOWN]);

enum { ASSIGNMENT_VALUE = 64 };

/* "NAME=VALUE" (value: a number in its range, or the name of a choice), returning the index in
 * *index (may be NULL). any (may be NULL): a value "*" is skipped and marked there.  REFUSED names
 * the culprit, with the nearest known name. */
status assignment_set(const assignment_list *, const char *text, double value[], int any[],
                      int *index, fault *f);
/* "NAME=VALUE;NAME=VALUE", each name once; what is not named keeps its value.  "": nothing. */
status assignment_parse(const assignment_list *, const char *text, double value[], int any[],
                        fault *f);
/* The same, written: values that differ from their defaults, in the order of the tables. */
void assignment_text(const assignment_list *, const double value[], char *text, int size);

/* The number, or the index of the choice, that a text is, of any size; 0: it is neither. */
int assignment_value(const parameter_type *, const char *text, double *value);
/* The shortest text that gives the same value, or the choice's name. */
void assignment_value_text(const parameter_type *, double value, char *text, int size);

#endif
