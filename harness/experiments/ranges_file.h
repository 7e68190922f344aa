/* A sweep as a group of a file of results, written batch by batch: never more than a batch of it is
 * in memory. */
#ifndef BEAMWORK_RANGES_FILE_H
#define BEAMWORK_RANGES_FILE_H

#include "harness/experiments/tally.h"
#include "harness/records/records.h"

enum { RANGES_FILE_VERSION = 1, RANGES_FILE_COLUMNS = 11 };

typedef struct ranges_file {
    const parameter_ranges *of;
    const char *path;
    record_file record;
    hid_t at; /* its group */
    hid_t column[RANGES_FILE_COLUMNS];
} ranges_file;

/* The path outlives it. plan: digits that say which sweep it is. */
status ranges_file_open(const char *path, const parameter_ranges *r, const char *plan,
                        ranges_file *out, fault *f);
/* Points from `first` on. */
status ranges_file_add(ranges_file *, long first, const rows *, fault *f);
/* The last: worst points with the names of their scenes, and content:
 * digits of all values that are equal however they were computed. written: of what came before; not
 * OK: nothing is left. */
status ranges_file_close(ranges_file *, const tally *, const char *content, status written,
                         fault *f);

#endif
