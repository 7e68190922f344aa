/* The certificate of a formulation: the contract that it must keep, and what is measured of it.
 * Each part is found in a process of its own, so that one that crashes, does not come back or
 * spoils its memory is a named result, and the others go on. */
#ifndef BEAMWORK_CERTIFICATE_H
#define BEAMWORK_CERTIFICATE_H

#include "harness/experiments/checks.h"
#include "harness/experiments/measured.h"

enum { CERTIFICATE_PARTS = CHECKS_FAMILIES + MEASURED_GROUPS };

/* One part: claims, and, of what is measured, the numbers. */
typedef struct certificate_part {
    claims claims;
    measures measures;
} certificate_part;

typedef struct certificate {
    formulation chosen;
    certificate_part part[CERTIFICATE_PARTS];
    const char
        *late; /* the part that hit the time limit; NULL: none. What follows is not checked */
} certificate;

typedef struct certificate_request {
    const formulation *chosen;   /* [count] */
    int count, jobs, time_limit; /* time_limit: [s] of one part; 0: none */
    int contract_only;           /* 1: nothing is measured */
} certificate_request;

/* certificates_free in any case. */
status certificate_find(const certificate_request *, certificate **out, fault *f);
void certificate_free(certificate *all, int count);

const char *certificate_part_name(int part);
/* What holds, in a line. */
const char *certificate_part_words(int part);
/* Claims of that outcome, and numbers that were compared, of all parts. */
int certificate_counted(const certificate *, claim_outcome);
int certificate_compared(const certificate *);
/* 1: no claim is broken. */
int certificate_holds(const certificate *);
/* The first claim that is broken; NULL: none. */
const claim *certificate_broken(const certificate *);

#endif
