/* Where motions in time stopped, in a file: another run goes on from there, bit for bit where its
 * steps stay. */
#ifndef BEAMWORK_RESTART_H
#define BEAMWORK_RESTART_H

#include "harness/experiments/solution.h"

typedef struct restart {
    char formulation[FORMULATION_KEY]; /* with its options */
    int elements, keep_all;
    char *scene; /* text of a scene file, without what may differ */
    int ends;
    outcome_end *end;
} restart;

/* Refused where no motion of the scene could be kept, before anything is solved. */
status restart_possible(const scene *, fault *);
/* The ends of the motions that were solved, with what they are of. Written beside and renamed. */
status restart_write(const char *path, const solution_request *, const sweep *, fault *);
/* FAULT: missing, damaged or foreign. restart_free frees it, also after a failure. */
status restart_read(const char *path, restart *, fault *);
void restart_free(restart *);
/* The scene is to go on from there: its stations are those behind. REFUSED: another scene, but for
 * stations and quantities; another formulation or mesh; none of them comes behind. */
status restart_begin(const restart *, solution_request *, scene *, fault *);

#endif
