#include "harness/study/checksum.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <zlib.h>

/* CRC-32 of IEEE 802.3; a sum is begun with 0 and continued with the sum so far. */
static uint32_t checksum(uint32_t sum, const unsigned char *data, size_t size)
{
    return (uint32_t)crc32_z(sum, data, size);
}

static void write_line(size_t size, uint32_t sum, char out[CHECKSUM_LENGTH + 1])
{
    snprintf(out, CHECKSUM_LENGTH + 1, "beamwork-seal %016zx %08x\n", size, (unsigned)sum);
}

void checksum_write(const void *data, size_t size, char out[CHECKSUM_LENGTH + 1])
{
    write_line(size, checksum(0, data, size), out);
}

status checksum_of_file(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f)
{
    enum { PIECE = 1 << 16 };
    unsigned char buffer[PIECE];
    size_t size = 0, got;
    uint32_t sum = 0;
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", path, strerror(errno));
    while ((got = fread(buffer, 1, PIECE, from)) > 0) {
        sum = checksum(sum, buffer, got);
        size += got;
    }
    const int bad = ferror(from);
    fclose(from);
    write_line(size, sum, out);
    return bad ? fault_set(f, STATUS_FAULT, "%.120s: cannot be read", path) : STATUS_OK;
}

/* Sum of all but the last CHECKSUM_LENGTH bytes, which go to `tail`. -1: shorter than that. */
static long read_body(FILE *from, uint32_t *sum, char tail[CHECKSUM_LENGTH + 1])
{
    enum { PIECE = 1 << 18 };
    static const size_t held = CHECKSUM_LENGTH;
    unsigned char buffer[CHECKSUM_LENGTH + PIECE];
    size_t have = 0, got;
    long body = 0;
    *sum = 0;
    while ((got = fread(buffer + have, 1, PIECE, from)) > 0) {
        have += got;
        if (have <= held)
            continue;
        *sum = checksum(*sum, buffer, have - held);
        body += (long)(have - held);
        memmove(buffer, buffer + have - held, held);
        have = held;
    }
    if (have < held || ferror(from))
        return -1;
    memcpy(tail, buffer, held);
    tail[held] = '\0';
    return body;
}

status checksum_check(const char *path, fault *f)
{
    char tail[CHECKSUM_LENGTH + 1], right[CHECKSUM_LENGTH + 1];
    uint32_t sum;
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", path, strerror(errno));
    const long body = read_body(from, &sum, tail);
    fclose(from);
    write_line(body >= 0 ? (size_t)body : 0, sum, right);
    return body >= 0 && strcmp(tail, right) == 0
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT,
                           "%.120s: not a file of this program, or cut short, damaged or altered; "
                           "write it again",
                           path);
}
