/* Writing an HDF5 file that appears complete or not at all: it is made in memory and then written
 * beside, or made beside, and renamed. Every call is checked; after the first failure nothing more
 * is tried and record_close says so. */
#ifndef BEAMWORK_RECORD_H
#define BEAMWORK_RECORD_H

#include <hdf5.h>

#include "harness/records/output.h"

typedef struct record_file {
    hid_t file, scalar; /* scalar: the shape of an attribute */
    int bad;
    output to; /* of one that is made on disk; stream NULL: in memory */
} record_file;

status record_open(record_file *r, fault *f);
/* On disk, for what is larger than memory. REFUSED, FAULT: nothing can be written there. */
status record_open_beside(record_file *r, const char *path, fault *f);
/* Writes what was recorded to `path` (NULL: nothing; on disk: that of its opening) and frees it. */
status record_close(record_file *r, const char *path, fault *f);
/* Frees what was recorded; the outcome that led to it. */
status record_drop(record_file *r, status outcome);

/* Group of this name, made where it does not exist; the caller closes it with H5Gclose. */
hid_t record_group(record_file *r, hid_t at, const char *name);
/* Attributes. */
void record_text(record_file *r, hid_t at, const char *name, const char *text);
/* An attribute text[count]. */
void record_text_list(record_file *r, hid_t at, const char *name, int count,
                      const char *const text[]);
void record_count(record_file *r, hid_t at, const char *name, long value);
void record_number(record_file *r, hid_t at, const char *name, double value);
/* Two whole numbers; a text in ASCII of exactly its length (what VTK expects). */
void record_version(record_file *r, hid_t at, const char *name, const int version[2]);
void record_ascii(record_file *r, hid_t at, const char *name, const char *text);
/* New data set of any type, compressed where it is large; the caller closes it with H5Dclose. */
hid_t record_array(record_file *r, hid_t at, const char *name, hid_t type, int rank,
                   const hsize_t size[], const void *value);
/* New data set of rank 0 to 3 with its unit (NULL: none); the caller closes it with H5Dclose. */
hid_t record_values(record_file *r, hid_t at, const char *name, int rank, const hsize_t size[],
                    const double value[], const char *unit);
/* UTF-8 of a fixed length; the caller closes it with H5Tclose. */
hid_t record_text_type(size_t length);
/* New data set row[count] of the given type; the caller closes it with H5Dclose. */
hid_t record_table(record_file *r, hid_t at, const char *name, hid_t type, int count,
                   const void *row);
/* New data set text[count]. */
void record_texts(record_file *r, hid_t at, const char *name, int count, const char *const text[]);

#endif
