/* Options of a call: a JSON object whose keys a table names. */
#ifndef BEAMWORK_OPTIONS_H
#define BEAMWORK_OPTIONS_H

#include <jansson.h>

#include "elements/shared/status.h"

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

#endif
