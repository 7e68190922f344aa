/* What a process says of itself: the line of JSON of the protocol (protocol.md). */
#ifndef BEAMWORK_HANDSHAKE_H
#define BEAMWORK_HANDSHAKE_H

#include <stddef.h>

#include "elements/element.h"

enum { PROCESS_PROTOCOL = 1, HANDSHAKE_MOST = 65536 };

typedef struct handshake {
    element_type type; /* what is data; no function */
    int whole;         /* 1: energy, force or tangent of whole elements; 0: strains and stresses */
    int inertia;       /* 1: it brings its own; type.spreads: also in time */
    element_constants constants; /* of the type */
} handshake;

/* `who` begins every refusal. What the type points to stays allocated, but not on refusal.
 * type.constants is left for the owner. REFUSED: what it says is not the line of the protocol. */
status handshake_read(const char *who, const char *line, size_t length, handshake *out, fault *f);
/* What the type of a handshake points to; a type of zeros has nothing. */
void handshake_free(element_type *);

#endif
