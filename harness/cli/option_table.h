/* All options of all verbs; a verb takes those whose keys it lists. */
#ifndef BEAMWORK_OPTION_TABLE_H
#define BEAMWORK_OPTION_TABLE_H

#include <stddef.h>

enum { KEY_HELP = 'h', KEY_USAGE = 256, OPTION_MOST = 64 /* with the end */ };

/* An option of the verbs. member: of the request, takes it as it is: its text, or 1 where it has no
 * argument; 0: see take. */
typedef struct verb_option {
    const char *name;
    int key;
    const char *argument, *doc;
    size_t member;
} verb_option;

extern const verb_option option_table[OPTION_MOST]; /* ends with a name of NULL */

#endif
