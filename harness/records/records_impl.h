/* Internal declarations of records/. */
#ifndef BEAMWORK_RECORDS_IMPL_H
#define BEAMWORK_RECORDS_IMPL_H

#include <hdf5.h>
#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "harness/newton/newton.h"
#include "harness/records/records.h"

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

/* Counts a line and writes its beginning: kind, name, mesh. */
void comparison_lines_heading(const listing *l, comparison_kind kind);
/* Writes a line for something that exists in one run only. */
void comparison_lines_lone(const listing *l, comparison_kind kind);
void comparison_lines_status(const listing *l, const char *before, const char *after);
/* Compares sums over `meshes` meshes; the threshold is that of one mesh, whatever their number. */
void comparison_lines_work(const listing *l, const long before[RESULTS_WORKS],
                           const long after[RESULTS_WORKS], int meshes);

/* Writes the difference of counted work if both are known. */
void comparison_lines_cost(const listing *l, double before, double after);

void comparison_cells(const listing *l, const result_cell *a, const result_cell *b);
void comparison_series(const listing *l, const result_series *a, const result_series *b);
/* Compares two sweeps, with a line also for each point, formulation and mesh that exists in one of
 * them only. */
void comparison_sweeps(const listing *l, const char *select);

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
 * file, in the order of their names; and one without a mesh for the references of each point. */
status results_sweep_read(const char *path, hid_t at, stored_results *out, fault *f);

/* Short table of a run: a row for each series, small enough to be committed and read in a diff. */

/* Columns; harness/README.md explains them. */
extern const char results_table_head[];

/* Number of digits written; two runs cannot be compared more accurately. */
enum { RESULTS_ERROR_DIGITS = 6, RESULTS_LIMIT_DIGITS = 10, RESULTS_DECADES_DECIMALS = 6 };

/* Centre lines and sections of the states of a path. */

/* Writes a group below `at`: centre lines, sections, bodies; the caller closes it with H5Gclose. */
hid_t store_shapes(record_file *r, hid_t at, const char *name, const scene *sc, const shapes *s);

/* Centre lines and walls for ParaView and VTK: the group /VTKHDF of an HDF5 file (VTKHDF file
 * format, type UnstructuredGrid). One state: version 1.0; several states as time steps:
 * version 2.0. */

void vtkhdf_write(record_file *r, const scene *sc, const shapes *s);

#endif
