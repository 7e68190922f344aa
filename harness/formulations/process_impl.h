#ifndef BEAMWORK_PROCESS_IMPL_H
#define BEAMWORK_PROCESS_IMPL_H

#include "harness/formulations/formulations.h"
#include "harness/formulations/formulations_impl.h"

enum { PROCESS_KINDS = 65536 }; /* kinds that a process stores; numbers are sent modulo this */

typedef struct process {
    element_type type;
    element_constants constants;
    void *memory; /* texts and options of the type */
    int whole;    /* 1: the process computes the energy or the forces of whole elements */
    int damping;
    channel to;
    long kinds; /* number of kinds that the running process has prepared */
} process;

struct element_data {
    process *of;
    /* number of the start of the process that prepared the kind, and number of the kind in this
     * process */
    long started, kind;
    int strains, coordinates, scalars, history, linear;
    /* [2 x strains x strains] C of linear stresses sigma = C e, and the damping matrix */
    double C[];
};

void frames_serve(process *p);
void frames_serve_inertia(process *p);
void frames_serve_history(process *p);
void frames_serve_damping(process *p);
void frames_serve_line(process *p);

typedef struct frame_question {
    enum channel_request what;
    int mask, count;
    const element_data *const *data;
    size_t answer; /* bytes of the answer for each element */
} frame_question;

#endif
