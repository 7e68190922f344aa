/* Inside of a formulation in another process. */
#ifndef BEAMWORK_PROCESS_IMPL_H
#define BEAMWORK_PROCESS_IMPL_H

#include "harness/formulations/channel.h"
#include "harness/formulations/process.h"

enum { PROCESS_KINDS = 65536 }; /* numbers of kinds, which come again */

typedef struct process {
    element_type type;
    element_constants constants;
    int whole; /* energy or forces of whole elements */
    channel to;
    long kinds; /* prepared so far by the process that runs */
} process;

struct element_data {
    process *of;
    long started, kind; /* of the process that prepared it */
    int strains, coordinates, linear;
    double C[]; /* [strains x strains] where linear: sigma = C e */
};

/* frames.c: the functions of the type that evaluate elements. */
void frames_serve(process *p);
/* frames_inertia.c: that of its own inertia. */
void frames_serve_inertia(process *p);

#endif
