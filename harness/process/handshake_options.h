/* The options in what a process says of itself. */
#ifndef BEAMWORK_HANDSHAKE_OPTIONS_H
#define BEAMWORK_HANDSHAKE_OPTIONS_H

#include <jansson.h>

#include "elements/element.h"

/* *out: a table that stays, or NULL for none (list NULL or empty). REFUSED as handshake_read. */
status handshake_options(const char *who, const json_t *list, const parameter_type **out, fault *f);

#endif
