/* The options in what a process says of itself. */
#ifndef BEAMWORK_HANDSHAKE_OPTIONS_H
#define BEAMWORK_HANDSHAKE_OPTIONS_H

#include <jansson.h>

#include "elements/element.h"

/* *out: a table to be freed, or NULL for none (list NULL or empty); also on refusal. REFUSED as
 * handshake_read. */
status handshake_options(const char *who, const json_t *list, const parameter_type **out, fault *f);
void handshake_options_free(const parameter_type *table); /* or NULL */

#endif
