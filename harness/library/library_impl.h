/* The inside of library/. */
#ifndef BEAMWORK_LIBRARY_IMPL_H
#define BEAMWORK_LIBRARY_IMPL_H

#include <fenv.h>
#include <jansson.h>
#include <locale.h>
#include <stdio.h>

#include "cases/format/format.h"
#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"
#include "harness/library/beamwork.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

/* Begin and end of every function of the library. */

/* Settings of the host, and where the reason of a failure goes. */
typedef struct call {
    fault fault;
    char *text; /* malloced: in the place of the fault's line; NULL: none */
    char **why;
    locale_t locale;
    fenv_t arithmetic;
} call;

/* Until call_end, numbers are read, written and rounded as in a program with C's locale, rounding
 * to nearest and no traps; errors of GSL are handled by the library. */
void call_begin(call *, char **why);
/* Gives back what the host has set, and *why. */
bw_status call_end(call *, status outcome);

/* Formulations and processes of a call. */

enum { CONTESTANTS_MOST = 64 };

/* Names between blanks; NULL: none is named, count 0. *named (may be NULL): 1 where none of them is
 * "all". */
status contestants_parse(const char *names, formulation list[CONTESTANTS_MOST], int *count,
                         int *named, fault *f);
int contestants_jobs(void); /* default number of processes */
/* TIME_LIMIT: who may end the run did so before all cells were done. */
status contestants_finished(const sweep *, fault *);

/* The packed reference values, of which HDF5 lets one thread read at a time. */

/* Their place from now on; NULL: where they usually are. Reads them to see. */
status known_place(const char *path, fault *f);
/* Reference values of a case with the known deviations; type NULL: the known deviations alone. */
status known_read(const case_type *type, truths *out, fault *f);
/* Reads the reference values of all cases. */
status known_read_all(truths *out, fault *f);

/* The lock of HDF5 alone: of two threads that want the same truths one reads, and a process is
 * forked while none does. */
void known_hold(void);
void known_let_go(void);
/* known_read of who holds it. */
status known_read_held(const case_type *type, truths *out, fault *f);
/* Around all other calls of HDF5; restores the host's handling of its errors. */
void known_lock(void);
void known_unlock(void);

/* Options of a call: a JSON object whose keys a table names. */

typedef enum call_option_kind {
    OPTION_SWITCH, /* true or false, into an int */
    OPTION_WHOLE,  /* least .. most, into an int */
    OPTION_FILE,   /* descriptor of an open file, into an int */
    OPTION_SHARE,  /* between 0 and 1, into a double */
    OPTION_WORDS   /* into a const char *, which *kept owns */
} call_option_kind;

typedef struct call_option {
    const char *name; /* NULL ends a table */
    call_option_kind kind;
    void *to; /* keeps its value where the key is not given */
    int least, most;
} call_option;

/* json NULL: none. *kept: to be released with json_decref. REFUSED: what is no object, an unknown
 * key, a value of another kind or out of range. */
status options_read(const char *json, const call_option table[], json_t **kept, fault *f);

/* Common base of a bw_scene and its results; it lives as long as any of them. */

typedef struct source source;

struct bw_scene {
    source *from;
    double parameter[CASE_MAX_PARAMETERS];
};

/* A built-in case, or a file that was read (name: what messages call it; both are taken, also
 * after a failure). */
status source_new(const case_type *type, scene_file *file, char *name, source **out, fault *f);
source *source_hold(source *); /* one more who releases it */
void source_release(source *); /* NULL: nothing */
const case_type *source_case(const source *);
const scene_file *source_file(const source *); /* NULL: a built-in case */

/* Reference values of a case; of a scene file the known deviations alone. Read on the first
 * request. NULL after FAULT. Several threads may call it. */
status source_known(source *, const truths **out, fault *f);

/* Contents of a bw_result. */

enum { RESULT_COLUMNS = 32 };

struct bw_result {
    source *from;
    sweep sweep;                    /* of one point, series and mesh */
    truths own;                     /* of a scene file */
    const truths *truths;           /* NULL: none are known */
    double *error;                  /* [quantities] NAN: there is no reference value */
    double *step[RESULT_COLUMNS];   /* [steps] of the fields of a step, once they are requested */
    double *motion[RESULT_COLUMNS]; /* [motions] of those of a motion, likewise */
    double *position;               /* [states x points x 3], likewise */
};

static inline const solve_result *result_handle_solution(const struct bw_result *r)
{
    return &r->sweep.series[0].cell[0].solve;
}

static inline const scene *result_handle_scene(const struct bw_result *r)
{
    return &r->sweep.point[0].scene;
}

/* Documents that are handed over as text. */

typedef struct document_text {
    FILE *to; /* what is written there becomes the text */
    char *bytes;
    size_t size;
} document_text;

status text_begin(document_text *, fault *f);
/* *out: malloced, or NULL where `written` or the end of writing failed. */
status text_end(document_text *, status written, char **out, fault *f);

#endif
