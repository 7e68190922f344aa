/* Which formulations run which cases, and what stands against it. */
#ifndef BEAMWORK_RUNS_ON_H
#define BEAMWORK_RUNS_ON_H

#include "cases/case.h"
#include "elements/element.h"

enum { RUNS_ON_WORDS = 200 };

typedef struct runs_on {
    const char *name; /* of the case, or of the formulation */
    int runs;
    int other;                 /* 1: as another model (harness/study/study.h) */
    char words[RUNS_ON_WORDS]; /* what is missing; where it runs: what it leaves out */
} runs_on;

void runs_on_scene(const scene *s, const element_type *type, runs_on *out);
/* The built-in cases at their defaults, at most `room`; their number. Whether as another model is
 * not looked at: `other` is 0. */
int runs_on_cases(const element_type *type, runs_on out[], int room);

#endif
