/* Internal declarations of formulations in another process. */
#ifndef BEAMWORK_PROCESS_IMPL_H
#define BEAMWORK_PROCESS_IMPL_H

#include "harness/formulations/formulations.h"
#include "harness/formulations/formulations_impl.h"

enum { PROCESS_KINDS = 65536 }; /* number of kinds; larger numbers are taken modulo this number */

typedef struct process {
    element_type type;
    element_constants constants;
    int whole; /* 1: the process computes energy or forces of whole elements */
    channel to;
    long kinds; /* number of kinds prepared so far by the running process */
} process;

struct element_data {
    process *of;
    long started, kind; /* number of the start of the process that prepared the kind; number of
                           the kind in that process */
    int strains, coordinates, linear;
    double C[]; /* [strains x strains] if stresses are linear: sigma = C e */
};

/* process_frames.c: sets the functions of the type that evaluate elements. */
void frames_serve(process *p);
/* process_frames.c: sets the inertia function of the type if the process computes inertia. */
void frames_serve_inertia(process *p);

/* A request about many elements, with the numbers of values per element in the request and in
 * the answer. */

/* A request about elements. */
typedef struct frame_question {
    enum channel_request what;
    int mask, count;
    const element_data *const *data;
    size_t answer; /* bytes of the answer for each element */
} frame_question;

#endif
