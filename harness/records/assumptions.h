/* What is assumed of the sections of a scene of one's own: what their numbers do not say is zero,
 * and what no formulation has of them. One list, from which text, CSV, JSON, HDF5 and the report
 * say it. */
#ifndef BEAMWORK_ASSUMPTIONS_H
#define BEAMWORK_ASSUMPTIONS_H

#include "harness/study/study.h"

typedef enum assumption_kind {
    ASSUMPTION_NOT_KNOWN,
    ASSUMPTION_NOT_MODELLED,
    ASSUMPTION_KINDS
} assumption_kind;

enum { ASSUMPTION_TEXT = 320 };
typedef struct assumption {
    assumption_kind kind;
    int section;                /* of the scene */
    char physics[100];          /* "shear, warping": in words of `omit`; "": none of these */
    char text[ASSUMPTION_TEXT]; /* what is assumed, with the name of the section */
} assumption;

const char *assumptions_kind(int kind); /* "not known" */
/* The index-th of the point. 0: there is none. */
int assumptions_at(const sweep_point *p, int index, assumption *out);
/* All of them, "kind: text", with semicolons between; what finds no room is counted. */
void assumptions_words(const sweep_point *p, size_t size, char out[]);

#endif
