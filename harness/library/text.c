#include "harness/library/text.h"

#include <stdlib.h>

static status lost(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for a document");
}

status text_begin(document_text *t, fault *f)
{
    *t = (document_text){0};
    t->to = open_memstream(&t->bytes, &t->size);
    return t->to != NULL ? STATUS_OK : lost(f);
}

status text_end(document_text *t, status written, char **out, fault *f)
{
    const int failed = fclose(t->to) != 0;
    *out = NULL;
    if (written != STATUS_OK || failed) {
        free(t->bytes);
        return written != STATUS_OK ? written : lost(f);
    }
    *out = t->bytes;
    return STATUS_OK;
}
