/* Requests to the process of a formulation and its answers, as protocol.md writes them. */
#ifndef BEAMWORK_CHANNEL_H
#define BEAMWORK_CHANNEL_H

#include <pthread.h>
#include <stdint.h>

#include "harness/formulations/child.h"
#include "harness/formulations/handshake.h"

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
    /* What broke it, until it is told; "": nothing. */
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
/* Keeps what was refused until it is told; smaller steps may help elsewhere: nothing then. */
void channel_note(channel *, status outcome, const fault *why);
/* From now on it is called after its formulation. */
status channel_call(channel *, const char *name, fault *);
/* Ends the process and frees what the channel has. */
void channel_end(channel *);
/* Breaks it for a reason found above; returns FAULT. */
status channel_break(channel *, const char *why, fault *);

#endif
