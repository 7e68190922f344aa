/* A scene as an input deck of CalculiX 2.20: members as solids, ends as rigid faces. */
#ifndef BEAMWORK_DECK_H
#define BEAMWORK_DECK_H

#include <stdio.h>

#include "cases/scene/scene.h"

enum { DECK_MOST_ELEMENTS = 400 }; /* along a member */

typedef struct deck_request {
    const scene *scene; /* valid */
    const char *of;     /* for an import: "case; parameters" */
    int elements;       /* along each member that does not say its own */
} deck_request;

/* REFUSED: what the deck cannot carry, before anything is written. */
status deck_check(const deck_request *, fault *f);
status deck_write(const deck_request *, FILE *to, fault *f);

#endif
