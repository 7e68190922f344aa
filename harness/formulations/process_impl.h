/* Inside of a formulation in another process. */
#ifndef BEAMWORK_PROCESS_IMPL_H
#define BEAMWORK_PROCESS_IMPL_H

#include "harness/formulations/formulations.h"
#include "harness/formulations/formulations_impl.h"

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

/* process_frames.c: the functions of the type that evaluate elements. */
void frames_serve(process *p);
/* process_frames.c: that of its own inertia. */
void frames_serve_inertia(process *p);

/* A request about many elements, and the numbers in it and in its answer. */

/* A request about elements. */
typedef struct frame_question {
    enum channel_request what;
    int mask, count;
    const element_data *const *data;
    size_t answer; /* bytes for each element */
} frame_question;

channel *frame_channel(const frame_question *);
int frame_nodes(const element_data *);
/* Parts first, first + most, ...: how many elements of `each` bytes fit into a request. */
int frame_fitting(size_t each);
/* Room after the kinds of the elements for `each` bytes of every one. FAULT: the process does not
 * know these elements any more. */
status frame_begin(const frame_question *, size_t each, char **to, fault *f);
/* Numbers after each other: into a request, out of an answer. */
void frame_put(char **to, const void *from, size_t bytes);
void frame_take(const char **from, double to[], size_t count);
/* *body: the answers. */
status frame_ask(const frame_question *, const char **body, fault *f);

#endif
