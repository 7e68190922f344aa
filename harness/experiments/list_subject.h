/* What may be asked about: everything, all cases, all formulations, or one of them. */
#ifndef BEAMWORK_LIST_SUBJECT_H
#define BEAMWORK_LIST_SUBJECT_H

#include "harness/formulations/formulations.h"

typedef struct list_subject {
    int cases, formulations; /* 1: all of them */
    const case_type *type;   /* one case */
    formulation chosen;      /* one formulation, perhaps with options; type NULL: none */
} list_subject;

/* name NULL: everything; else "cases", "formulations", a case or a formulation. REFUSED: nothing
 * there is, with the nearest name. */
status list_subject_find(const char *name, list_subject *out, fault *f);

#endif
