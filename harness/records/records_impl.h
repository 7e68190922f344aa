#ifndef BEAMWORK_RECORDS_IMPL_H
#define BEAMWORK_RECORDS_IMPL_H

#include <hdf5.h>
#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "harness/newton/newton.h"
#include "harness/records/records.h"

/* Appends a cell filled with zeros and returns it; NULL: out of memory. */
result_cell *results_add(stored_results *r);

int results_order(const result_cell *a,
                  /* compares two cells by name, then by number of elements */
                  const result_cell *b);
status results_series_summarise(stored_results *r, fault *f);
/* Computes the sums of a series of run r over the meshes of `to`, the same series of another run.
 * Returns 0 if r does not have all these meshes, or if out of memory. The caller frees out->mesh
 * and out->limit. */
int results_series_restrict(const stored_results *r, const result_series *to, result_series *out);

/* Returns 1 if the text is one of the lines. Returns 0 if `lines` is NULL. */
int results_part_has(const char *lines, const char *text);
/* Returns 1 if the series belongs to another program, or to an element that is not loaded. No
 * selection names such a series. */
int results_part_is_foreign(const char *series);
/* Returns the name of a formulation of another program that r contains for the same case and
 * parameters but `other` does not contain; NULL: none. */
const char *results_part_instead(const stored_results *r, const stored_results *other,
                                 const char *series);
/* Returns 1 if the selection includes this quantity of a series (case/parameters/formulation). */
int results_part_selects(const results_part *p, const char *series, const char *quantity);
/* Returns 1 if the selection of run r includes at least one quantity of the series that the two
 * runs contain. */
int results_part_needs(const stored_results *r, const stored_results *other, const char *series);
/* Returns 1 if the two runs requested different quantities of a series, among the quantities that
 * they contain. */
int results_part_differ(const stored_results *a, const stored_results *b, const char *series);
/* Returns 1 if, in this run, the formulation of the series does not affect the exit status yet. */
int results_part_is_fresh(const results_part *p, const char *series);
void results_part_free(results_part *);

extern const record_type record_omission; /* omitted physics (only in the CSV of a solution) */

extern const schema_field names_of_quantity[]; /* name and unit of the quantity */

void fields_keys_omitted(const subject *s, field_value *out);

void fields_keys_assumed(const subject *s, field_value *out);

void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out);
/* Adds a record for each formulation run by this program, in the order of the series. */
void gather_declarations(const gathering *g, subjects *out);

/* Opens the group with this name, or creates it. The caller closes the group with H5Gclose. */
hid_t record_group(record_file *r, hid_t at, const char *name);
/* Write attributes in the form that VTK requires: two integers, or an ASCII string without
 * padding. */
void record_version(record_file *r, hid_t at, const char *name, const int version[2]);
void record_ascii(record_file *r, hid_t at, const char *name, const char *text);
/* Creates a data set text[count]. */
void record_texts(record_file *r, hid_t at, const char *name, int count, const char *const text[]);

status output_folder_below(const output_folder *, const char *name, fault *f);

/* Creates the table `name` below `at`. Each text column has the length of its longest text. */
void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[]);
/* Creates the table of a kind of record, including its keys. */
void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[]);

typedef struct listing {
    FILE *to;
    const comparison_limits *limits;
    comparison *out;
    const stored_results *before, *after;
    const char *name;
    int elements; /* number of elements of the mesh; 0: the line does not refer to a single mesh */
} listing;

/* Writes a line for an entry that exists in only one run. */
void comparison_lines_lone(const listing *l, comparison_kind kind);
void comparison_lines_status(const listing *l, const char *before, const char *after);

void comparison_series(const listing *l, const result_series *a, const result_series *b);

typedef struct outline {
    int walls;
    /* 1: the outline is an equivalent rectangle, for a section given by constants (same A and ratio
     * Iy : Iz) or by matrices (same radii of gyration) */
    int equivalent;
    /* [walls] coordinates (y, z) [m] of two corners at one end of the mid-line of the wall, then of
     * two corners at the other end; the four corners are in order around the wall */
    double corner[SECTION_MAX_WALLS][4][2];
} outline;

/* Computes the outline. c: constants of the section. */
void outline_of(const section_spec *spec, const section *c, outline *out);
/* Computes the outline at the far end of a tapered member. It has the same walls and corners as
 * `near`, the outline at the near end. */
void outline_of_far_end(const section_spec *spec, const section *c, const section *near,
                        outline *out);
void outline_between(const outline *near, const outline *far, double x, outline *out);

/* Returns FAULT. The message names the damaged part of the file. */
status results_case_damaged(const char *path, const char *where, const char *what, fault *f);

/* Adds a cell for each point, formulation and mesh. Its name contains the values of all parameters
 * in the file, in the order of their names. Also adds a cell without a mesh for the reference
 * values of each point. */
status results_sweep_read(const char *path, hid_t at, stored_results *out, fault *f);

/* Header line with the names of the columns. harness/README.md explains the columns. */
extern const char results_table_head[];

/* Numbers of digits with which sizes of errors and limits are written, and of decimals of the sum
 * of logarithms. */
enum { RESULTS_ERROR_DIGITS = 6, RESULTS_LIMIT_DIGITS = 10, RESULTS_DECADES_DECIMALS = 6 };

/* Centre lines and walls for ParaView and VTK: the group /VTKHDF of an HDF5 file (VTKHDF file
 * format, type UnstructuredGrid). */

void vtkhdf_write(record_file *r, const scene *sc, const shapes *s);

#endif
