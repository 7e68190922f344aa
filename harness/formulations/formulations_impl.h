/* Internal declarations of formulations/. */
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

/* A child process whose standard input and output are channels; its standard error is that of
 * this process. The child ends with the thread that started it. */

typedef struct child {
    pid_t process; /* 0: no process */
    pid_t owner;   /* the process that started the child; only that process may communicate with the
                      child */
    int to, from;
} child;

typedef enum child_event {
    CHILD_DONE,
    CHILD_ENDED, /* the child closed its output or terminated */
    CHILD_LATE,  /* no answer within the time limit */
    CHILD_SPOKE  /* the child wrote before it had received the whole request */
} child_event;

/* Description that a process sends of its formulation: the JSON line of the protocol (protocol.md).
 */

enum { PROCESS_PROTOCOL = 1, HANDSHAKE_MOST = 65536 };

typedef struct handshake {
    element_type type; /* data members only, no functions */
    int whole;         /* 1: the process computes the energy, force or tangent of whole elements;
                          0: strains and stresses */
    int inertia;       /* 1: the process computes the inertia of elements; with type.spreads,
                          also for transient analysis */
    element_constants constants; /* constants of the type */
} handshake;

/* Reads the first line of a process. `who` begins every error message. After success,
 * handshake_free frees what the type points to; after an error nothing needs to be freed. The
 * owner sets type.constants. REFUSED: the line does not follow the protocol. */
status handshake_read(const char *who, const char *line, size_t length, handshake *out, fault *f);
/* Frees what the type of a handshake points to; accepts a type filled with zeros. */
void handshake_free(element_type *);

/* Requests to the process of a formulation and its answers; their format is in protocol.md. */

enum channel_request {
    CHANNEL_PREPARE = 1,
    CHANNEL_STRAIN,
    CHANNEL_STRESS,
    CHANNEL_FORCE,
    CHANNEL_INERTIA
};

enum { CHANNEL_HEADER = 40, CHANNEL_ANSWER = 24 };

/* Growing buffer that begins with a header. */
typedef struct channel_bytes {
    char *at;
    size_t count, room;
} channel_bytes;

typedef struct channel {
    char *who; /* start of messages: "exec:COMMAND", later "formulation NAME" */
    char **words;
    child process;
    long started; /* number of starts; data prepared by an earlier process are invalid */
    int limit;    /* time limit of an answer [s]; 0: none */
    pthread_mutex_t lock;
    channel_bytes out, in;
    /* Error that broke the channel, stored until it is reported; "": none. */
    char trouble[FAULT_TEXT];
    int told;
} channel;

/* REFUSED: the command has no words. FAULT: out of memory. */
status channel_init(channel *, const char *command, fault *);
/* Starts the process, again if it has ended, and reads its first line: line[HANDSHAKE_MOST + 1],
 * ended by '\0'. REFUSED: the process writes no line. */
status channel_start(channel *, char line[], fault *);
/* Returns 1 if the child was started by this process and is running. */
int channel_runs(const channel *);
/* channel_begin empties the body of the next request. channel_add adds `count` bytes to it and
 * returns their address; NULL: out of memory. */
void channel_begin(channel *);
void *channel_add(channel *, size_t count);
/* Sends the request and waits for the answer. *body: the answer, of `least` to `most` bytes
 * (*count), valid until the next request. NOT_CONVERGED, SINGULAR, REFUSED: the process reports
 * this outcome, with a message. FAULT: the channel is broken or the process has ended, and
 * `trouble` gives the reason. */
status channel_ask(channel *, enum channel_request what, int mask, int elements, size_t least,
                   size_t most, const char **body, size_t *count, fault *);
/* Stores the reason for a REFUSED or FAULT until it is reported. Other outcomes are ignored,
 * since smaller steps may succeed. */
void channel_note(channel *, status outcome, const fault *why);
/* Sets the formulation name for later messages. */
status channel_call(channel *, const char *name, fault *);
/* Ends the process and frees the memory of the channel. */
void channel_end(channel *);
/* Marks the channel as broken, for a reason that the caller gives. Returns FAULT. */
status channel_break(channel *, const char *why, fault *);

/* Gathers the perturbed states of many elements, so one call evaluates all of them. A function that
 * computes finite differences is called twice: the first call records its states, and the second
 * call receives their values. */

typedef struct gather {
    int answered;    /* 0: states are being gathered; 1: their answers are returned, in the same
                        order */
    int count, next; /* number of states, and number of answers returned so far */
    int nodes;       /* number of nodes of a state */
    size_t size;     /* number of doubles in an answer */
    const element_data **data; /* [count] data of the type before completion */
    node_state *x;             /* [count x nodes] */
    double *answer;            /* [count x size] */
    int room, failed;          /* capacity in states; 1 after an allocation failure */
} gather;

/* Evaluates element i by finite differences, with calls of gather_next. */
typedef void gather_element(void *context, gather *, int i);
/* Computes the answers of states first .. first + count - 1. */
typedef void gather_evaluate(void *context, gather *, int first, int count);
enum { GATHER_TOGETHER = 4096 }; /* largest number of states in one evaluation */

/* Calls element(context, g, i) twice for each of `count` elements, with one `evaluate` in between.
 * When memory is short, calls it once with g NULL. */
void gather_run(int count, int nodes, size_t size, gather_element *, gather_evaluate *,
                void *context);
/* Returns the answer [size] for the state x[nodes]. Returns NULL in the first pass, where the
 * caller's result is not used. */
const double *gather_next(gather *, const element_data *own, const node_state x[]);

/* Energy, forces and stiffness from the functions of the type itself, for one state or for many
 * together. */

/* Computes the forces with the functions of the type. With `together`: returns the gathered
 * answers, or zeros while states are being gathered. */
status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out);
/* Returns the number of doubles in a gathered answer. */
size_t forces_size(const element_data *d);
/* Computes the answers of states first .. first + count - 1, with everything that the type
 * computes. Requires force_many. */
void forces_evaluate(const element_type *given, gather *, int first, int count);

/* Strains of an element that is defined by its force or energy. They are the positions of its
 * nodes relative to the first node, in the axes of that node: e = (|d| - undeformed distance, l
 * p, l log(R0^T R_k)) for every other node, and l^2 a for all nodes [m]. Here d = r_k - r_0, and
 * p = (2 n_y, 2 n_z)/(1 + n_x) for the direction n of d, which is regular unless the chord
 * points backward. The distance is a separate strain: otherwise a stiff chord would need more
 * iterations of the mixed equations than a soft one. */

enum { PLACES_MOST = 6 * (ELEMENT_MAX_NODES - 1) + ELEMENT_MAX_NODES };

int places_strains_two(const double options[]);   /* strains of an element with two nodes */
int places_strains_three(const double options[]); /* strains of an element with three nodes */

void places_strain(const element_data *d, const node_state x[], strain_output *out);

/* Computes the positions of the nodes for these strains, with the first node at rest at the
 * origin. */
void places_nodes(const element_data *d, const double e[], node_state x[]);

/* Computes B [7n x strains], the derivative of the node positions with respect to the strains. */
void places_motion(const element_data *d, const double e[], double B[]);

#endif
