/* A function that can fail returns a status. A function that rejects user input also fills a fault
 * with one line that names the cause and the remedy. Programming errors are caught by assertions
 * instead. */
#ifndef BEAMWORK_STATUS_H
#define BEAMWORK_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Outcome of a call. */
typedef enum status {
    STATUS_OK,
    STATUS_NOT_CONVERGED, /* an iteration did not converge */
    STATUS_SINGULAR,      /* a matrix that must be invertible is singular */
    STATUS_REFUSED,       /* invalid or unsupported input */
    STATUS_FAULT,         /* error of a file, the disk or memory */
    STATUS_TIME_LIMIT,    /* stopped by a time limit */
    STATUS_NO_VALUE       /* no error, but the requested mode, load or state does not exist */
} status;

enum { FAULT_TEXT = 320 };

/* Description of an error, for a user. */
typedef struct fault {
    char text[FAULT_TEXT]; /* one line without a newline, terminated by '\0' */
} fault;

/* Writes the line to f, which may be NULL, and returns s. Example: return fault_set(f,
 * STATUS_REFUSED, "...", ...). */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
status
fault_set(fault *f, status s, const char *format, ...);

/* Writes "out of memory for" and the formatted text, then a remedy. Returns STATUS_FAULT. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
status
fault_memory(fault *f, const char *format, ...);

/* Reports that a file could not be read. why: errno. Returns STATUS_FAULT. */
status fault_unreadable(fault *f, const char *path, int why);

/* not defined in C++, where other headers may use the name */
#ifndef __cplusplus
/* Returns from the calling function if the call failed. Suitable only for functions that have
 * nothing to free. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        const status try_ = (call);                                                                \
        if (try_ != STATUS_OK)                                                                     \
            return try_;                                                                           \
    } while (0)
#endif

/* Returns the word for a status in result files: "ok", "not_converged", "singular", "refused",
 * "fault", "time_limit" or "no_value". */
const char *status_name(status s);

#ifdef __cplusplus
}
#endif

#endif
