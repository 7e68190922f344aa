/* Documents that are handed over as text. */
#ifndef BEAMWORK_TEXT_H
#define BEAMWORK_TEXT_H

#include <stdio.h>

#include "elements/shared/status.h"

typedef struct document_text {
    FILE *to; /* what is written there becomes the text */
    char *bytes;
    size_t size;
} document_text;

status text_begin(document_text *, fault *f);
/* *out: malloced, or NULL where `written` or the end of writing failed. */
status text_end(document_text *, status written, char **out, fault *f);

#endif
