/* Parameter points of a case: text <-> values. */
#ifndef BEAMWORK_PARAMETERS_H
#define BEAMWORK_PARAMETERS_H

#include <stdint.h>

#include "cases/case.h"

enum { PARAMETERS_TEXT = 512 };

int parameters_count(const case_type *c);
void parameters_default(const case_type *c, double value[]);
/* "name=value" (value: a number, or the name of a choice). REFUSED names the culprit, with the nearest known name. */
status parameters_set(const case_type *c, const char *assignment, double value[], fault *f);
/* "name=value;name=value": values other than the default; a value "*" is skipped and marked in any[] (may be NULL). */
status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f);
/* The same, written: empty for the defaults. */
void parameters_text(const case_type *c, const double value[], char *text, int size);
/* Value of one parameter as text: "%.17g" shortened where that loses nothing, or the choice's name. */
void parameters_value_text(const case_parameter *p, double value, char *text, int size);
/* FNV-1a of "name=%.17g;" over all parameters in table order, choices by index, "name=*;" where any. */
uint64_t parameters_hash(const case_type *c, const double value[], const int any[]);

/* The candidate nearest to a misspelt word (edit distance), or NULL when none is near. next(context, i): NULL ends. */
const char *nearest_name(const char *word, const char *(*next)(const void *context, int i),
                         const void *context);

/* Index of `word` in "a|b|c", or -1. */
int choice_index(const char *choices, const char *word);
void choice_name(const char *choices, int index, char *text, int size);

#endif
