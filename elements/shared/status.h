/* Outcome of everything that can fail at run time.
 *
 * A function that can fail returns a status; one that refuses what the user
 * gave also fills a fault: one line that names the culprit and the remedy.
 * Mistakes of a programmer are asserted instead. */
#ifndef BEAMWORK_STATUS_H
#define BEAMWORK_STATUS_H

/* How it ended. */
typedef enum status {
    STATUS_OK,
    STATUS_NOT_CONVERGED, /* an iteration ended without meeting its criterion */
    STATUS_SINGULAR,      /* a matrix that must be invertible is not */
    STATUS_REFUSED,       /* the input makes no sense or is not offered */
    STATUS_FAULT,         /* file, disk or memory: not the fault of the physics */
    STATUS_TIME_LIMIT,    /* stopped by the clock */
    STATUS_NO_VALUE /* all went well, and the requested value does not exist: no such mode, load or
                       state */
} status;

enum { FAULT_TEXT = 320 };

/* Description of an error, for a user. */
typedef struct fault {
    char text[FAULT_TEXT]; /* one line, no newline, '\0'-terminated */
} fault;

/* Writes the line into f (f may be NULL) and returns s, so that
 * `return fault_set(f, STATUS_REFUSED, "...", ...)` reads as one thought. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
status
fault_set(fault *f, status s, const char *format, ...);

/* Returns from the function when a call failed: for functions that own nothing to free. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        const status try_ = (call);                                                                \
        if (try_ != STATUS_OK)                                                                     \
            return try_;                                                                           \
    } while (0)

/* "ok", "not_converged", "singular", "refused", "fault", "time_limit", "no_value": the words of the
 * result file. */
const char *status_name(status s);

#endif
