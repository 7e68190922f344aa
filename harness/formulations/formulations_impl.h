/* The inside of formulations/. */
#ifndef BEAMWORK_FORMULATIONS_IMPL_H
#define BEAMWORK_FORMULATIONS_IMPL_H

#include <jansson.h>
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"

/* A process with its standard input and output as channels; its standard error is that of this
 * process. It ends with the thread that starts it. */

typedef struct child {
    pid_t process; /* 0: there is none */
    pid_t owner;   /* the process that started it and may speak to it */
    int to, from;
} child;

typedef enum child_event {
    CHILD_DONE,
    CHILD_ENDED, /* it has closed its output or died */
    CHILD_LATE,  /* nothing came within the limit */
    CHILD_SPOKE  /* it wrote before all of a request was there for it to read */
} child_event;

/* REFUSED: no such command, named; FAULT: no pipe, no process. */
status child_start(char *const words[], child *out, fault *f);
/* Does it still run? */
int child_runs(const child *);
/* Ends a child of this process, at once (now 1) or after a moment in which it may end by itself.
 * Returns its status as waitpid gives it; -1: it was killed here. For a child of another process
 * only its channels are closed. */
int child_end(child *, int now);

/* limit: seconds from now, 0: none. */
child_event child_write(const child *, const void *bytes, size_t count, int limit);
/* Reads until `least` bytes are there, at most `most`; *count: how many came, also when it ended.
 */
child_event child_read(const child *, void *bytes, size_t least, size_t most, size_t *count,
                       int limit);

/* Description of its formulation that a process sends: the protocol's JSON line (protocol.md). */

enum { PROCESS_PROTOCOL = 1, HANDSHAKE_MOST = 65536 };

typedef struct handshake {
    element_type type; /* what is data; no function */
    int whole;         /* 1: energy, force or tangent of whole elements; 0: strains and stresses */
    int inertia;       /* 1: it brings its own; type.spreads: also in time */
    element_constants constants; /* of the type */
} handshake;

/* `who` begins every error message. handshake_free frees what the type points to; after an error
 * there is nothing to free. The owner sets type.constants. REFUSED: no line of the protocol. */
status handshake_read(const char *who, const char *line, size_t length, handshake *out, fault *f);
/* Frees all that the type of a handshake points to; a type of zeros has nothing. */
void handshake_free(element_type *);

/* Requests to the process of a formulation and its answers, as protocol.md writes them. */

enum channel_request {
    CHANNEL_PREPARE = 1,
    CHANNEL_STRAIN,
    CHANNEL_STRESS,
    CHANNEL_FORCE,
    CHANNEL_INERTIA
};

enum { CHANNEL_HEADER = 40, CHANNEL_ANSWER = 24 };

/* Bytes that grow. The first ones are of a header. */
typedef struct channel_bytes {
    char *at;
    size_t count, room;
} channel_bytes;

typedef struct channel {
    char *who; /* in messages: "exec:COMMAND", then "formulation NAME" */
    char **words;
    child process;
    long started; /* how often: what an earlier process prepared is gone */
    int limit;    /* seconds for an answer; 0: none */
    pthread_mutex_t lock;
    channel_bytes out, in;
    /* The error that broke it, until it is reported; "": none. */
    char trouble[FAULT_TEXT];
    int told;
} channel;

/* FAULT: memory. REFUSED: no words in the command. */
status channel_init(channel *, const char *command, fault *);
/* Starts the process, again where one has ended, and reads its first line: line[HANDSHAKE_MOST +
 * 1], ended by '\0'. REFUSED: there is none. */
status channel_start(channel *, char line[], fault *);
/* Is it this process's own and running? */
int channel_runs(const channel *);
/* The body of the next request is empty, and room for `count` bytes more of it, or NULL: memory. */
void channel_begin(channel *);
void *channel_add(channel *, size_t count);
/* Sends what was added and waits for the answer. *body: of `least` or `most` bytes, *count: which;
 * valid until the next request. NOT_CONVERGED, SINGULAR, REFUSED: as the process says, with its
 * line; FAULT: the channel is broken, the process ended, and `trouble` says why. */
status channel_ask(channel *, enum channel_request what, int mask, int elements, size_t least,
                   size_t most, const char **body, size_t *count, fault *);
/* Stores the reason of a REFUSED or FAULT until it is reported. Other outcomes are ignored: smaller
 * steps may help. */
void channel_note(channel *, status outcome, const fault *why);
/* Names it after its formulation in messages from now on. */
status channel_call(channel *, const char *name, fault *);
/* Ends the process and frees what the channel has. */
void channel_end(channel *);
/* Breaks it for a reason found above; returns FAULT. */
status channel_break(channel *, const char *why, fault *);

/* States of elements that differences want, gathered and evaluated together: a function that takes
 * differences is called twice, to hear which states it wants and, when these are known, for its
 * result. */

typedef struct gather {
    int answered;    /* 0: states are gathered; 1: their answers are handed out, in that order */
    int count, next; /* states, and how many of them were handed out */
    int nodes;       /* of a state */
    size_t size;     /* doubles of an answer */
    const element_data **data; /* [count] of the type as it is given */
    node_state *x;             /* [count x nodes] */
    double *answer;            /* [count x size] */
    int room, failed;          /* states that there is room for; 1: no memory */
} gather;

/* Evaluates element i from its differences, through gather_next. */
typedef void gather_element(void *context, gather *, int i);
/* Fills the answers of states first .. first + count - 1. */
typedef void gather_evaluate(void *context, gather *, int first, int count);
enum { GATHER_TOGETHER = 4096 }; /* states that are evaluated together, at most */

/* Calls element(context, g, i) twice for each of `count`, and evaluate between; with g NULL, once,
 * where there is no memory. */
void gather_run(int count, int nodes, size_t size, gather_element *, gather_evaluate *,
                void *context);
/* The answer for this state [size], or NULL while they are gathered: its value does not count
 * then. x[nodes]. */
const double *gather_next(gather *, const element_data *own, const node_state x[]);

/* Energy, forces and stiffness that a type gives of an element, alone or of many states together.
 */

/* Forces by the type itself; with `together`, from the answers gathered there, and zero while
 * states are being gathered. */
status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out);
/* Doubles of a gathered answer. */
size_t forces_size(const element_data *d);
/* Fills the answers of states first .. first + count - 1 with all that the type gives; it has
 * force_many. */
void forces_evaluate(const element_type *given, gather *, int first, int count);

/* Options in the description that a process sends. */

/* *out: a table to be freed, or NULL for none (list NULL or empty); also on refusal. REFUSED as
 * handshake_read. */
status handshake_options(const char *who, const json_t *list, const parameter_type **out, fault *f);
void handshake_options_free(const parameter_type *table); /* or NULL */

/* Strains of an element that is defined by its force, or by its energy: the positions of its nodes
 * relative to the first one, in the axes of that one,
 *   e = (|d| - undeformed distance, l p, l log(R0^T R_k)) of every other node, l^2 a of all [m]:
 * d = r_k - r_0; p = (2 n_y, 2 n_z)/(1 + n_x) of its direction n, which is regular unless the chord
 * points backward. The distance is a strain of its own, so that in the mixed equations a stiff
 * chord takes no more iterations than a soft one. */

enum { PLACES_MOST = 6 * (ELEMENT_MAX_NODES - 1) + ELEMENT_MAX_NODES };

int places_strains_two(const double options[]);   /* of two nodes */
int places_strains_three(const double options[]); /* of three */

void places_strain(const element_data *d, const node_state x[], strain_output *out);

/* The element with these strains whose first node rests at the origin. */
void places_nodes(const element_data *d, const double e[], node_state x[]);

/* B [7n x strains]: how these nodes move with the strains. */
void places_motion(const element_data *d, const double e[], double B[]);

#endif
