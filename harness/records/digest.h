/* SHA-256 (FIPS 180-4) of bytes that come one after the other. */
#ifndef BEAMWORK_DIGEST_H
#define BEAMWORK_DIGEST_H

#include <stddef.h>
#include <stdint.h>

enum { DIGEST_TEXT = 65 }; /* 64 hexadecimal digits and the end */

typedef struct digest {
    uint32_t state[8];
    uint64_t length; /* [bytes] so far */
    unsigned char block[64];
} digest;

digest digest_begin(void);
void digest_add(digest *, const void *data, size_t size);
void digest_add_text(digest *, const char *text); /* with its end: "ab", "c" is not "a", "bc" */
/* Numbers that are equal are the same: -0 as 0, every NaN as one. */
void digest_add_number(digest *, double value);
/* The digits; the digest itself may go on. */
void digest_text(const digest *, char out[DIGEST_TEXT]);
/* All bytes of a file. 0, or -1: it cannot be read. */
int digest_add_file(digest *, const char *path);

#endif
