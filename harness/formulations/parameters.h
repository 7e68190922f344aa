/* Parameter points of a case: text <-> values. */
#ifndef BEAMWORK_PARAMETERS_H
#define BEAMWORK_PARAMETERS_H

#include <stdint.h>

#include "cases/case.h"
#include "harness/formulations/assignment.h"

enum { PARAMETERS_TEXT = 512 };

assignment_list parameters_list(const case_type *c);
int parameters_count(const case_type *c);
void parameters_default(const case_type *c, double value[]);
/* "NAME=VALUE" (harness/formulations/assignment.h). */
status parameters_set(const case_type *c, const char *assignment, double value[], fault *f);
/* "NAME=VALUE;NAME=VALUE": values other than the default; a value "*" is skipped and marked in
 * any[] (may be NULL); "*" alone: any of those of the source. */
status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f);
/* The same, written: empty for the defaults. */
void parameters_text(const case_type *c, const double value[], char *text, int size);
/* The same of those that the source of a case knows, as programs that derive values are asked. */
void parameters_source_text(const case_type *c, const double value[], char *text, int size);
int parameters_of_source(const case_type *c); /* how many there are: the first ones */
/* FNV-1a of "name=%.17g;" over all parameters in table order, choices by index, "name=*;" where
 * any. */
uint64_t parameters_hash(const case_type *c, const double value[], const int any[]);

/* The words of the point before: neighbours in a table have most of them in common. */
typedef struct parameters_words {
    int known; /* 0: none yet */
    double value[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS];
    char text[CASE_MAX_PARAMETERS][128];
} parameters_words;

/* The same for points of one case, one behind the other. */
uint64_t parameters_hash_next(const case_type *c, const double value[], const int any[],
                              parameters_words *before);

#endif
