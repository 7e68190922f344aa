/* Internal declarations of records/. */
#ifndef BEAMWORK_RECORDS_IMPL_H
#define BEAMWORK_RECORDS_IMPL_H

#include <hdf5.h>
#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "harness/newton/newton.h"
#include "harness/records/records.h"

/* Appends a zeroed cell; NULL: out of memory. */
result_cell *results_add(stored_results *r);

int results_order(const result_cell *a,
                  const result_cell *b); /* compares by name, then by elements */
/* Computes the series from the sorted cells. FAULT: out of memory. */
status results_series_summarise(stored_results *r, fault *f);
/* Sums over the meshes that another run has of the series; Returns 0 if r does not have all of
 * them, or if out of memory. The caller frees out->mesh and out->limit. */
int results_series_restrict(const stored_results *r, const result_series *to, result_series *out);

/* Is the text one of the lines? Returns 0 for lines NULL. */
int results_part_has(const char *lines, const char *text);
/* Does the series belong to another program, or to an element that is not loaded? No selection
 * names it: it is requested wherever its case is run. */
int results_part_is_foreign(const char *series);
/* Returns the name of such a series that r has there and `other` does not have; NULL: none. */
const char *results_part_instead(const stored_results *r, const stored_results *other,
                                 const char *series);
/* Was the quantity of a series (case/parameters/formulation) requested? */
int results_part_selects(const results_part *p, const char *series, const char *quantity);
/* Did only `other`, and not the selection of run r, request the series, with any quantity that the
 * two runs contain? */
int results_part_wants(const stored_results *r, const stored_results *other, const char *series);
/* Did the two runs request different quantities of a series, among those that they contain? */
int results_part_differ(const stored_results *a, const stored_results *b, const char *series);
/* Is its formulation new to the run? */
int results_part_is_fresh(const results_part *p, const char *series);
void results_part_free(results_part *);

extern const record_type record_omission; /* of a value, in the CSV of a solution only */

extern const schema_field names_of_quantity[]; /* its name and unit */

/* Physics that the scene omits, in words. */
void fields_keys_omitted(const subject *s, field_value *out);

/* Assumptions on its sections, in words. */
void fields_keys_assumed(const subject *s, field_value *out);

/* Adds the records of all series of a case. */
void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out);
/* Adds one record for each formulation run by this program, in the order of the series. */
void gather_declarations(const gathering *g, subjects *out);

/* Opens a group of this name, or creates it; the caller closes it with H5Gclose. */
hid_t record_group(record_file *r, hid_t at, const char *name);
/* These write two integers, or an ASCII text with exactly its length (as VTK requires). */
void record_version(record_file *r, hid_t at, const char *name, const int version[2]);
void record_ascii(record_file *r, hid_t at, const char *name, const char *text);
/* Creates a data set text[count]. */
void record_texts(record_file *r, hid_t at, const char *name, int count, const char *const text[]);

/* Creates a subfolder. */
status output_folder_below(const output_folder *, const char *name, fault *f);

/* Records as rows of a typed, compressed table; units and summaries of the columns are its
 * attributes. */

/* Creates table `name` below `at`; text columns have the length of their longest text. */
void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[]);
/* The table of a kind of record, with its keys. */
void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[]);

/* Writes differences as lines. */

/* Destination of the lines, their counts, and their subject. */
typedef struct listing {
    FILE *to;
    const comparison_limits *limits;
    comparison *out;
    const stored_results *before, *after;
    const char *name;
    int elements; /* 0: not of a single mesh */
} listing;

/* Writes a line for something that exists in one run only. */
void comparison_lines_lone(const listing *l, comparison_kind kind);
void comparison_lines_status(const listing *l, const char *before, const char *after);

void comparison_series(const listing *l, const result_series *a, const result_series *b);

/* Matrices as text that other programs read: Matrix Market, coordinate format (R. F. Boisvert,
 * R. Pozo, K. A. Remington, NISTIR 5935, 1996), 17 digits. */

/* Outline of a section, for pictures: straight walls in the principal axes. */

typedef struct outline {
    int walls;
    /* 1: equivalent rectangle, for a section given by constants (same A and Iy : Iz) or by matrices
     * (same radii of inertia) */
    int equivalent;
    /* (y, z) [m]: two corners at one end of the wall's mid-line, then two at the other, in order
     * around it */
    double corner[SECTION_MAX_WALLS][4][2];
} outline;

/* c: the constants of the section. */
void outline_of(const section_spec *spec, const section *c, outline *out);
/* Outline at the far end of a tapered member, with the same walls and corners as that of its near
 * end, `near`; corners are joined by straight lines. */
void outline_of_far_end(const section_spec *spec, const section *c, const section *near,
                        outline *out);
void outline_between(const outline *near, const outline *far, double x, outline *out);

/* One case of a stored run. */

/* FAULT: names the damaged part of a file. */
status results_case_damaged(const char *path, const char *where, const char *what, fault *f);

/* Reads a stored sweep. */

/* Adds a cell for each point, formulation and mesh, named by the values of all parameters in the
 * file, in the order of their names; and one cell without a mesh for the references of each point.
 */
status results_sweep_read(const char *path, hid_t at, stored_results *out, fault *f);

/* Short table of a run: a row for each series, small enough to be committed and read in a diff. */

/* Columns; harness/README.md explains them. */
extern const char results_table_head[];

/* Number of digits written; two runs cannot be compared more accurately. */
enum { RESULTS_ERROR_DIGITS = 6, RESULTS_LIMIT_DIGITS = 10, RESULTS_DECADES_DECIMALS = 6 };

/* Centre lines and sections of the states of a path. */

/* Centre lines and walls for ParaView and VTK: the group /VTKHDF of an HDF5 file (VTKHDF file
 * format, type UnstructuredGrid). One state: version 1.0; several states as time steps:
 * version 2.0. */

void vtkhdf_write(record_file *r, const scene *sc, const shapes *s);

#endif
