/* Documents that are handed over as text. */
#ifndef BEAMWORK_TEXT_H
#define BEAMWORK_TEXT_H

#include <stdio.h>

#include "elements/shared/status.h"

typedef struct text {
    FILE *to; /* what is written there becomes the text */
    char *bytes;
    size_t size;
} text;

status text_begin(text *, fault *f);
/* *out: malloced, or NULL where `written` or the end of writing failed. */
status text_end(text *, status written, char **out, fault *f);

#endif
