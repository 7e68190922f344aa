/* Compares the checksum with that of zlib, for all lengths and start positions of the folded
 * blocks. */
#include <gsl/gsl_test.h>
#include <zlib.h>

#include "harness/study/study_impl.h"

enum { BYTES = 400, STARTS = 17 };

int main(void)
{
    unsigned char data[BYTES + STARTS];
    for (int i = 0; i < BYTES + STARTS; i++)
        data[i] = (unsigned char)(i * i * 2654435761U >> 13);
    for (size_t size = 0; size <= BYTES; size++) {
        int wrong = 0;
        for (size_t start = 0; start < STARTS; start++) {
            const uint32_t before = (uint32_t)(start * 2654435761U);
            wrong += crc_add(before, data + start, size) !=
                     (uint32_t)crc32_z(before, data + start, size);
        }
        gsl_test_int(wrong, 0, "%d bytes", (int)size);
    }
    return gsl_test_summary();
}
