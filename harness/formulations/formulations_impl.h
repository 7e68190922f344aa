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

/* A child process whose standard input and output are pipes. */

typedef struct child {
    pid_t process; /* 0: no process */
    pid_t owner;   /* process that started the child; no other process may communicate with it */
    int to, from;
} child;

typedef enum child_event {
    CHILD_DONE,
    CHILD_ENDED,
    CHILD_LATE,
    CHILD_WROTE /* the child wrote although no answer was due */
} child_event;

/* Description that a process sends of its formulation: the JSON line of the protocol (protocol.md).
 */

enum { PROCESS_PROTOCOL = 1, HANDSHAKE_MOST = 65536 };

/* The answer of a process with damping to a prepare request: C, then V, or V alone. */
enum damping_answer { DAMPING_NONE, DAMPING_AFTER_C, DAMPING_ONLY };

typedef struct handshake {
    element_type type; /* type with data members only, without functions */
    int whole;         /* 1: the process computes the energy, force or tangent of whole elements;
                          0: strains and stresses */
    /* 1: the process computes the inertia of elements. If type.spreads is set, this inertia also
     * applies to transient analyses */
    int inertia;
    int damping;
    int line; /* 1: the process computes the motion of sections between the nodes */
    element_constants constants; /* constants of the type */
    /* texts and options to which the type points; the caller frees it after success */
    void *memory;
} handshake;

/* Reads the first line of a process. program_name: start of every error message. After an error,
 * nothing needs to be freed. The owner sets type.constants. REFUSED: the line violates the
 * protocol. FAULT: out of memory. */
status handshake_read(const char *program_name, const char *line, size_t length, handshake *out,
                      fault *f);

enum channel_request {
    CHANNEL_PREPARE = 1,
    CHANNEL_STRAIN,
    CHANNEL_STRESS,
    CHANNEL_FORCE,
    CHANNEL_INERTIA,
    CHANNEL_BEGIN,
    CHANNEL_COMMIT,
    CHANNEL_LINE
};

enum { CHANNEL_HEADER = 40, CHANNEL_ANSWER = 24 };

/* Growing buffer that starts with a header. */
typedef struct channel_bytes {
    char *at;
    size_t count, room;
} channel_bytes;

typedef struct channel {
    char *program_name; /* start of messages: first "exec:COMMAND", later "formulation NAME" */
    char **words;
    child process;
    long started;
    int limit; /* [s] time limit of an answer; 0: none */
    pthread_mutex_t lock;
    channel_bytes out, in;
    char trouble[FAULT_TEXT];
    int reported;
} channel;

/* Makes a channel with a time limit of 120 s. REFUSED: words_split rejects the command. FAULT: out
 * of memory. */
status channel_init(channel *, const char *command, fault *);
/* Starts the process, after ending an earlier one, and reads its first line into
 * line[HANDSHAKE_MOST + 1], terminated by '\0'. REFUSED: the command cannot be executed, or the
 * process does not print a line in time. FAULT: no pipe or process can be created. */
status channel_start(channel *, char line[], fault *);
/* Returns 1 if this process started the child and the child is running. */
int channel_runs(const channel *);
/* channel_begin empties the body of the next request. channel_add adds `count` bytes to the body
 * and returns their address; NULL: out of memory. */
void channel_begin(channel *);
void *channel_add(channel *, size_t count);
/* Sends the request and waits for the answer. Sets *body to the answer, which has `least` or `most`
 * bytes (*count) and is valid until the next request. Returns the status in the answer, with its
 * message if it is not OK. FAULT: out of memory, or the process has ended, exceeds the time limit,
 * or violates the protocol. In the last three cases, the channel is broken, and `trouble` gives the
 * reason. */
status channel_ask(channel *, enum channel_request what, int mask, int elements, size_t least,
                   size_t most, const char **body, size_t *count, fault *);
/* Stores the reason for REFUSED or FAULT until it is reported. A stored reason that has not been
 * reported is not replaced. */
void channel_note(channel *, status outcome, const fault *why);
status channel_call(channel *, const char *name, fault *);
void channel_end(channel *);
/* Ends the process and stores the reason in `trouble` and in the fault. Returns FAULT. */
status channel_break(channel *, const char *why, fault *);

/* Gathers the perturbed states of many elements, so that one call evaluates all of them. */

typedef struct gather {
    int answered;    /* 0: states are gathered; 1: their answers are returned in the same order */
    int count, next; /* number of states; index of the next answer */
    int nodes;
    size_t size;
    const element_data **data; /* [count] data of the type that is completed */
    const double **history;    /* [count] histories of the elements */
    node_state *x;             /* [count x nodes] */
    double *answer;
    /* room: number of states for which there is memory; failed: 1 after an allocation failure */
    int room, failed;
} gather;

/* Evaluates element i by finite differences, with calls of gather_next. */
typedef void gather_element(void *context, gather *, int i);
/* Computes the answers of states first .. first + count - 1. */
typedef void gather_evaluate(void *context, gather *, int first, int count);
enum { GATHER_TOGETHER = 4096 }; /* largest number of states in one evaluation */

/* Calls element(context, g, i) twice for each of `count` elements, in groups of elements, with
 * calls of `evaluate` for their states in between. If an allocation fails, g is NULL in the second
 * or only call for an element. */
void gather_run(int count, int nodes, size_t size, gather_element *, gather_evaluate *,
                void *context);
/* Stores the state x[nodes] and returns NULL, or, if g->answered is 1, returns the answer [size]
 * for this state. */
const double *gather_next(gather *, const element_data *own, const node_state x[],
                          const double *history);

/* Computes the forces with the functions of the type. If `together` is not NULL, returns the
 * gathered answers, or zeros while states are gathered. */
status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out);
size_t forces_size(const element_data *d);
/* Computes the answers of states first .. first + count - 1, including all outputs that the type
 * computes, without the energy if there is a history. Requires force_many. */
void forces_evaluate(const element_data *, gather *, int first, int count);

/* Strains of an element that is defined by its force or energy. The strains are the positions of
 * its nodes relative to the first node, in the axes of the first node: e = (|d| - undeformed
 * distance, l p, l log(R_0^T R_k)) for every other node, l^2 a for
 * all nodes, and l times the additional unknowns [m]. Here d = r_k -
 * r_0, and p = (2 n_y, 2 n_z)/(1 + n_x) for the direction n of d. p is regular unless the chord
 * points backwards. */

enum { PLACES_MOST = ELEMENT_MAX_COORDINATES - 6 };

/* Returns the function for element_type.strains, which returns the number of strains. */
typedef int places_count(const double options[]);
places_count *places_strains(int nodes, int scalars);

void places_strain(const element_data *d, const node_state x[], strain_output *out);

/* Computes the states of the nodes for these strains. The first node is at the origin and not
 * rotated. */
void places_nodes(const element_data *d, const double e[], node_state x[]);

/* Computes B [coordinates x strains], the derivative of the states of the nodes with respect to the
 * strains. */
void places_motion(const element_data *d, const double e[], double B[]);

#endif
