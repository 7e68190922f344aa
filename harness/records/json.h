/* JSON of one solution and of a verification (jansson). */
#ifndef BEAMWORK_JSON_H
#define BEAMWORK_JSON_H

#include <jansson.h>
#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Writes and frees root; FAULT when it is NULL (out of memory) or cannot be written. */
status json_finish(json_t *root, FILE *to, fault *f);

/* What the scene of a point leaves out ("omitted"), and what is assumed of its sections
 * ("assumptions"). */
void json_add_physics(json_t *root, const sweep_point *p);
/* Solution of one cell of a one-point sweep; t may be NULL. */
status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f);
/* Verdicts as text, while others are still reached. */
typedef struct json_part {
    int verdicts; /* that it has: the first ones */
    char *text;
    size_t size;
    FILE *to; /* NULL: out of memory */
} json_part;

/* It stays where it is until it is freed. */
void json_part_begin(json_part *);
/* Adds what has been judged since. */
void json_part_add(json_part *, const sweep *s, const judgement *j);
void json_part_free(json_part *);
/* part: what is there already; NULL: nothing. */
status json_write_verdicts(FILE *to, const sweep *s, const judgement *j, const environment *e,
                           json_part *part, fault *f);

#endif
