/* Functions for all fuzzing programs. Each program defines LLVMFuzzerTestOneInput of libFuzzer, and
 * harness/tools/fuzz.sh runs it. */
#ifndef BEAMWORK_FUZZ_H
#define BEAMWORK_FUZZ_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void fuzz_must(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", what);
        abort();
    }
}

/* Returns the bytes up to the first zero as text. malloc allocates the text, so that reads beyond
 * its end are detected. */
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    fuzz_must(text != NULL, "there is memory");
    memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

/* Returns a stream that reads the bytes. The stream is never NULL. */
static inline FILE *fuzz_stream(const uint8_t *data, size_t size)
{
    FILE *from =
        size > 0 ? fmemopen((void *)(uintptr_t)data, size, "rb") : fopen("/dev/null", "rb");
    fuzz_must(from != NULL, "there is memory");
    return from;
}

#endif
