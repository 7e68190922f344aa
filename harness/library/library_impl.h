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

typedef struct call {
    fault fault;
    char *text; /* message that replaces the one of the fault, allocated with malloc; NULL: none */
    char **why;
    locale_t locale;
    fenv_t arithmetic;
} call;

/* Until call_end is called, numbers are read, written and rounded as in a C program with the
 * default locale, with rounding to nearest and without traps. The library handles the errors of
 * GSL. */
void call_begin(call *, char **why);
bw_status call_end(call *, status outcome);

enum { CONTESTANTS_MOST = 64 };

/* The packed reference values. */

/* Reads the reference values of a case and the known deviations; type NULL: only the known
 * deviations. */
status known_read(const case_type *type, truths *out, fault *f);
status known_read_all(truths *out, fault *f);

/* Locks HDF5 without changing its error handling. known_hold and known_release enclose the reading
 * of shared reference values. If two threads need the same values, only one of them reads them, and
 * no process is forked during this time. */
void known_hold(void);
void known_release(void);
/* Locks HDF5 for all other calls. known_unlock restores the error handling of the host. */
void known_lock(void);
void known_unlock(void);

typedef enum call_option_kind {
    OPTION_SWITCH, /* true or false, stored in an int */
    OPTION_WHOLE,  /* integer in the range least .. most, stored in an int */
    OPTION_FILE,   /* descriptor of an open file, stored in an int */
    OPTION_SHARE,  /* number between 0 and 1, stored in a double */
    OPTION_WORDS   /* text, stored in a const char *; *kept owns the text */
} call_option_kind;

typedef struct call_option {
    const char *name; /* key; NULL ends the table */
    call_option_kind kind;
    void *to; /* receives the value; not changed if the key is missing */
    int least, most;
} call_option;

/* Reads options. json NULL: there are no options. *kept: the caller frees it with json_decref.
 * REFUSED: the text is not a JSON object, a key is unknown, or a value has a wrong type or is out
 * of range. */
status options_read(const char *json, const call_option table[], json_t **kept, fault *f);

/* Data that a bw_scene and its results share. The data exist as long as one of these objects. */

typedef struct source source;

struct bw_scene {
    source *from;
    double parameter[CASE_MAX_PARAMETERS];
};

/* Makes the source of a built-in case or of a file. name: used in messages. Takes ownership of
 * `file` and `name`, even after a failure. */
status source_new(const case_type *type, scene_file *file, char *name, source **out, fault *f);
void source_release(source *); /* NULL: does nothing */
const case_type *source_case(const source *);
const scene_file *source_file(const source *); /* returns NULL for a built-in case */

enum { RESULT_COLUMNS = 32 };

struct bw_result {
    source *from;
    sweep sweep; /* sweep with one point, one series and one mesh */
    truths own;
    const truths *truths;           /* reference values that apply; NULL: none */
    double *error;                  /* [quantities] errors; NAN: there is no reference value */
    double *step[RESULT_COLUMNS];   /* [steps] columns of the steps, filled on request */
    double *motion[RESULT_COLUMNS]; /* [motions] columns of the motions, filled on request */
    double *position;               /* [states x points x 3] positions, filled on request */
};

static inline const solve_result *result_handle_solution(const struct bw_result *r)
{
    return &r->sweep.series[0].cell[0].solve;
}

static inline const scene *result_handle_scene(const struct bw_result *r)
{
    return &r->sweep.point[0].scene;
}

typedef struct document_text {
    FILE *to; /* stream whose output becomes the text */
    char *bytes;
    size_t size;
} document_text;

status text_begin(document_text *, fault *f);
/* Completes the text. *out: allocated with malloc; NULL: `written` is a failure, or the stream had
 * an error. */
status text_end(document_text *, status written, char **out, fault *f);

#endif
