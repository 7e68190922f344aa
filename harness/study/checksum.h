/* The last line of a file of ours: its length and checksum. What is cut short, damaged or altered
 * is noticed before the HDF5 library reads it, which trusts what it finds (version 1.10 reads
 * beyond its buffers in damaged files). */
#ifndef BEAMWORK_CHECKSUM_H
#define BEAMWORK_CHECKSUM_H

#include <stddef.h>

#include "elements/shared/status.h"

enum { CHECKSUM_LENGTH = 40 }; /* "beamwork-seal %016zx %08x\n" */

void checksum_write(const void *data, size_t size, char out[CHECKSUM_LENGTH + 1]);
/* The same of a whole file that has no such line yet. FAULT: it cannot be read. */
status checksum_of_file(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f);
/* FAULT: missing, foreign, or not what was written. */
status checksum_check(const char *path, fault *f);

#endif
