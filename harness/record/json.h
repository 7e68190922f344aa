/* JSON of one solution and of a verification (jansson). */
#ifndef BEAMWORK_JSON_H
#define BEAMWORK_JSON_H

#include <jansson.h>
#include <stdio.h>

#include "harness/catalogue/environment.h"
#include "harness/judge/judgement.h"

/* Writes and frees root; FAULT when it is NULL (out of memory) or cannot be written. */
status json_finish(json_t *root, FILE *to, fault *f);

/* Solution of one cell of a one-point sweep; t may be NULL. */
status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f);
status json_write_verdicts(FILE *to, const sweep *s, const judgement *j, const environment *e,
                           fault *f);

#endif
