/* records/: results files and other formats of results; comparison of runs. */
#ifndef BEAMWORK_RECORDS_H
#define BEAMWORK_RECORDS_H

#include <hdf5.h>
#include <jansson.h>
#include <limits.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

#include "cases/scene/scene.h"
#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"

/* Assumptions on the sections of a user's scene. */

typedef enum assumption_kind {
    ASSUMPTION_NOT_KNOWN,
    ASSUMPTION_NOT_MODELLED,
    ASSUMPTION_KINDS
} assumption_kind;

enum { ASSUMPTION_TEXT = 320 };
typedef struct assumption {
    assumption_kind kind;
    int section;
    char physics[100];          /* words of `omit`, such as "shear, warping"; "": none */
    char text[ASSUMPTION_TEXT]; /* text of the assumption, with the name of the section */
} assumption;

const char *assumptions_kind(int kind);
/* Sets *out to assumption number `index` of the point. Returns 0 if there is no such assumption. */
int assumptions_at(const sweep_point *p, int index, assumption *out);
/* Writes all assumptions as "kind: text", separated by semicolons. If the capacity of `out` is too
 * small, the text ends with the number of the remaining assumptions. */
void assumptions_words(const sweep_point *p, size_t size, char out[]);

/* Results of a stored run: errors and work of each cell, and a summary of each series of meshes. */

typedef enum results_work {
    WORK_ITERATIONS,
    WORK_EVALUATIONS,
    WORK_FACTORISATIONS,
    WORK_FLOPS,
    WORK_SOLUTIONS,
    WORK_ENTRIES,
    RESULTS_WORKS
} results_work;
extern const char *const results_work_names[RESULTS_WORKS];

/* Relative errors below this value are due to rounding and to the convergence criterion of
 * iterations. */
#define RESULTS_FLOOR 1e-8

enum { RESULTS_STATUS = 16, RESULTS_MOST_ELEMENTS = 10000000 };

typedef struct result_value {
    char quantity[SCENE_NAME];
    /* [unit of the quantity] value (NAN: none); errors are relative to near_zero if the magnitude
     * of the reference value is smaller */
    double value, near_zero;
    double error; /* error relative to the reference value; NAN: there is no reference value */
    /* limit of the series, which is stored with its finest mesh at a default point; NAN: none */
    double limit;
} result_value;

typedef struct result_cell {
    char *name;
    int elements;
    char status[RESULTS_STATUS];
    long work[RESULTS_WORKS];
    double cost; /* [s] cost of the counted work, in a sweep; not positive or NAN: unknown */
    int values;
    result_value *value;
} result_cell;

typedef struct result_mesh {
    int elements;
    char status[RESULTS_STATUS];
} result_mesh;

typedef struct result_limit {
    char quantity[SCENE_NAME];
    double value, near_zero; /* value and near_zero as in result_value; near_zero 0: unknown */
} result_limit;

/* Largest absolute error on a mesh; elements 0: no value has an error. */
typedef struct result_error {
    double size;
    int elements;
    char quantity[SCENE_NAME];
} result_error;

typedef struct result_series {
    char *name;
    int meshes, limits;
    result_mesh *mesh; /* [meshes] ascending by elements */
    long work[RESULTS_WORKS];
    int errors; /* number of values with an error on all meshes */
    /* sum of log10(max(|error|, RESULTS_FLOOR)) over these values, which depends on every error
     * above RESULTS_FLOOR, but not on rounding below it */
    double decades;
    /* least: smallest of the largest errors of the meshes; largest: largest error on all meshes */
    result_error least, largest;
    /* [limits] at a default point, in the order of the quantities of the point */
    result_limit *limit;
} result_series;

/* Selection of a run. NULL: there is no selection. */
typedef struct results_part {
    char *select;               /* expression of harness/formulations/formulations.h */
    char *cases, *formulations; /* one per line */
    /* formulations that do not affect the exit status yet, in one line each; NULL: none */
    char *fresh;
} results_part;

typedef struct stored_results {
    results_part part;
    int cells, seriess;
    int whole;  /* 1: the run has cells; 0: it has only series */
    int limits; /* 1: limits were evaluated */
    int swept;  /* 1: the run is a sweep; its cells without a mesh contain the reference values of a
                 * point */
    result_cell *cell;     /* cells in ascending order of name and elements */
    result_series *series; /* ascending by name */
} stored_results;

/* Reads the results of verify from an HDF5 file, or a table, which are distinguished by their first
 * bytes. FAULT: the file cannot be used, or contains only other results; the message gives the
 * reason. */
status results_read(const char *path, stored_results *out, fault *f);
/* Like results_read, for the results of an experiment: "verify", "bench", or "sweep" (without
 * series); NULL: the first of these experiments in the file. */
status results_read_any(const char *path, const char *experiment, stored_results *out, fault *f);
void results_free(stored_results *r);

status results_table_read(const char *path, FILE *from, stored_results *out, fault *f);
void results_table_write(FILE *to, const stored_results *r);

/* Comparison of two stored runs. Lists the results that became worse or better, or that exist in
 * only one run. */

typedef struct comparison_limits {
    double error; /* threshold for the relative change of an error */
    /* largest change of a value, relative to its reference value, that counts as rounding */
    double floor;
    /* threshold for the relative change of a count; the change of the sum over a series is relative
     * to the mean count of its meshes */
    double work;
} comparison_limits;
extern const comparison_limits comparison_limits_default;

typedef enum comparison_kind {
    CHANGE_WORSE,
    CHANGE_BETTER,
    CHANGE_OTHER,
    CHANGE_MISSING,
    CHANGE_NEW,
    COMPARISON_KINDS
} comparison_kind;
extern const char *const comparison_kind_names[COMPARISON_KINDS];

typedef struct comparison {
    int whole;     /* 1: cell by cell; 0: series by series */
    int evaluated; /* 1: both runs contain limits */
    int swept;
    int pairs;                     /* number of cells or series that exist in both runs */
    int count[COMPARISON_KINDS];   /* number of lines of each kind */
    double work[2][RESULTS_WORKS]; /* sums over the pairs, for the old and the new run */
    double cost[2]; /* [s] cost of the counted work of sweeps, for the old and the new run */
    /* numbers of series that exist in only one run (old, new) and do not count as changes; outside:
     * not selected in the other run; fresh: the formulation does not affect the exit status yet */
    int outside[2], fresh[2];
    /* number of series for which one run omits some quantities; their errors and work are not
     * compared */
    int partial;
} comparison;

/* Reads any of the entries of "error=0.01,floor=1e-8,work=0.02". REFUSED: the message names the
 * invalid entry. */
status comparison_limits_parse(const char *text, comparison_limits *out, fault *f);
/* Writes one line for each difference. Two kinds of series are counted but not written: series
 * outside the selection of one run, and series of new formulations that exist in only one run.
 * Series whose names do not match `select` (study.h; NULL: all) are skipped. */
void comparison_run(FILE *to, const stored_results *before, const stored_results *after,
                    const comparison_limits *limits, const char *select, comparison *out);
int comparison_differs(const comparison *c);

/* Results for spreadsheets, with one row per value, in full precision. */

void csv_solution(FILE *to, const sweep *s);
void csv_convergence(FILE *to, const sweep *s, const truths *t);
/* Writes the table of a benchmark. There is a row for every cell and evaluated quantity. */
void csv_timing(FILE *to, const sweep *s, const evaluation *j);

/* A schema for all records, with a table of fields for each kind of record. */

enum { SCHEMA_VERSION = 3, SCHEMA_OLDEST = 2, SCHEMA_MOST_FIELDS = 96, FIELD_ROOM = 2048 };
#define SCHEMA_NAME "beamwork-results"
/* Unit of a number for which the field `unit` of the same record gives the unit. */
#define OWN_UNIT "unit"

/* Role of a field that identifies the subject of the record. KEY_AROUND: the field is needed only
 * where the context does not identify the subject (CSV, lists in JSON). */
enum { KEY = 1, KEY_AROUND = 2 };

typedef enum field_kind {
    FIELD_INT,
    FIELD_LONG,
    FIELD_DOUBLE,
    FIELD_FLAG,
    FIELD_TEXT,
    FIELD_ENUM,
    FIELD_KINDS
} field_kind;

/* A record with its context. Members that do not apply are NULL or 0. */
typedef struct subject {
    const sweep *sweep;
    const sweep_point *point;
    const series *series;
    int mesh;           /* index in the series */
    const void *record; /* record to which most offsets refer */
    /* index among records of the same kind, for example of a quantity, step, iteration or
     * station */
    int index;
    int group; /* step of an iteration, or first point of a curve */
    const verdict *verdict;
    const truth *truth, *model_truth;
    const void *owner;
} subject;

typedef enum field_base {
    BASE_RECORD,
    BASE_SUBJECT,
    BASE_POINT,
    BASE_CASE, /* case_type */
    BASE_SERIES,
    BASE_FORMULATION, /* element_type */
    BASE_CELL,
    BASE_QUANTITY, /* scene_quantity number `index` */
    BASE_TRUTH,
    BASE_MODEL_TRUTH
} field_base;

typedef struct schema_field schema_field;
/* The kind of the field determines which member is set. */
typedef struct field_value {
    const schema_field *of;
    long whole;            /* value of INT, LONG, FLAG and ENUM */
    const double *numbers; /* [count of the field] value of DOUBLE; NAN: no value */
    const char *text;      /* value of TEXT, or word of an ENUM */
    double number;         /* storage for a number */
    char room[FIELD_ROOM]; /* storage for a composed text */
} field_value;

typedef void field_getter(const subject *s, field_value *out);

struct schema_field {
    /* unit: "1" for a dimensionless number, "" for a field that is not a number */
    const char *name, *unit;
    field_kind kind;
    const char *summary;
    field_base base; /* object to which the offset refers; if it is missing, there is no value */
    size_t offset;
    int address;              /* 1: the offset refers to a pointer to the TEXT */
    field_getter *get;        /* computes a derived value, for which the offset is not used */
    const char *(*word)(int); /* ENUM: returns the word of a value */
    int words;                /* number of words, for the values 0 to words - 1 */
    int count; /* DOUBLE: length of an array or size of a square matrix; 0: a single number */
    int key;   /* KEY, KEY_AROUND, or 0: a result */
};

#define AT(type, member) .offset = offsetof(type, member)
/* Value of a member of the context. */
#define OF(place, type, member)      .base = BASE_##place, .offset = offsetof(type, member)
#define TEXT_OF(place, type, member) OF(place, type, member), .address = 1

/* Tables end with a field that has no name. */
enum { RECORD_PARTS = 5 };
typedef struct record_type {
    const char *name, *table, *summary; /* table: name of the table in HDF5 and of lists in JSON */
    const schema_field *part[RECORD_PARTS]; /* field tables, in order and terminated by NULL */
} record_type;

/* The kinds of records: a series of meshes, a mesh, its results, the way in which they were found,
 * its times, its evaluation, and others. */
extern const record_type record_point, record_series, record_cell, record_quantity, record_curve,
    record_step, record_iteration, record_event, record_motion, record_matrix, record_timing,
    record_verdict, record_agreement, record_coverage, record_import, record_scene,
    record_parameter, record_meaning, record_assumption;
extern const record_type
    *const record_types[];                   /* all kinds except the two below; NULL-terminated */
extern const record_type record_truth;       /* reference values of a quantity (only in JSON) */
extern const record_type record_declaration; /* declarations of a whole run (only in HDF5) */

/* Sets `out` to the fields whose key is at most `keys`, in order, and returns their number. */
int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS]);
void schema_read(const subject *s, const schema_field *which, field_value *out);
const char *schema_kind_name(field_kind kind);
/* Functions for getters, which set a number or a text. The text may be NULL. */
void schema_set_text(field_value *out, const char *text);
void schema_set_number(field_value *out, double number);

/* Records as lines of CSV, in full precision. */

/* Part of a line. If several fields have the same name, only the first is written. Matrices are
 * omitted. */
typedef struct csv_part {
    const record_type *type;
    subject s;
} csv_part;

void csv_record_head(FILE *to, int parts, const csv_part part[]);
void csv_record_line(FILE *to, int parts, const csv_part part[]);

/* SHA-256 (FIPS 180-4) of consecutive bytes. */

enum { DIGEST_TEXT = 65 }; /* 64 hexadecimal digits and the terminating zero */

typedef struct digest {
    uint32_t state[8];
    uint64_t length;
    unsigned char block[64];
} digest;

digest digest_begin(void);
void digest_add(digest *, const void *data, size_t size);
void digest_add_text(
    digest *,
    const char *text); /* the terminating zero is included, so "ab", "c" differs from "a", "bc" */
/* Adds a number. Equal numbers give equal digests: -0 counts as 0, and all NaN values are equal. */
void digest_add_number(digest *, double value);
/* Writes the digits. Further data may then be added to the digest. */
void digest_text(const digest *, char out[DIGEST_TEXT]);
/* Adds all bytes of a file. Returns 0, or -1 if the file cannot be read. */
int digest_add_file(digest *, const char *path);

extern const schema_field keys_of_point[];  /* case and parameter point */
extern const schema_field keys_of_series[]; /* parameters of the point, and formulation */
extern const schema_field key_of_mesh[];    /* number of elements of each member */

enum { STATUSES = STATUS_NO_VALUE + 1 };
/* Words for the values of ENUM fields. */
const char *fields_keys_word_of_status(int status);
const char *fields_keys_word_of_moments(int convention);

const scene_quantity *fields_keys_quantity(const subject *s);
const cell_result *fields_keys_cell(const subject *s);

/* Modes that are followed over a parameter, as CSV and JSON. */

void follow_record_csv(FILE *to, const char *parameter, const follow_curves *);
/* Writes the columns of each mode, the crossings and the veerings. */
status follow_record_json(FILE *to, const char *parameter, const follow_curves *, fault *);

typedef struct held_record held_record;
typedef struct subjects {
    int count, room;
    subject *row;
    held_record *held; /* records that are not part of a result */
    int bad;           /* 1: out of memory */
} subjects;

/* A sweep, and the reference values with which its quantities are compared: those of the verdicts
 * in `evaluated` or, if this is NULL, `truths`. */
typedef struct gathering {
    const sweep *sweep;
    const evaluation *evaluated;
    const truths *truths;
} gathering;

/* Adds the records of a mesh. Adds nothing for kinds of which the mesh has no records. */
void gather_mesh(const gathering *g, const record_type *type, int series_index, int mesh,
                 subjects *out);
/* Adds the assumptions on the sections of a point. */
void gather_assumptions(const sweep_point *p, subjects *out);
subject gather_cell(const gathering *g, int series_index, int mesh);
subject gather_verdict(const gathering *g, const verdict *v);
subject gather_agreement(const gathering *g, const agreement *a);
subject gather_coverage(const gathering *g, const coverage *c, int left_out);
void gather_add(subjects *list, const subject *one);
/* Copies a record. The copy exists as long as the list. Returns NULL if out of memory. */
const void *gather_keep(subjects *list, const void *record, size_t size);
void gather_free(subjects *list);

/* Writes and frees `root`. */
status json_finish(json_t *root, FILE *to, fault *f);

/* Adds the physics that the scene of a point omits ("omitted"), and the assumptions on its sections
 * ("assumptions"). */
void json_add_physics(json_t *root, const sweep_point *p);
/* Writes the solution of a cell of a one-point sweep. t may be NULL. */
status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f);
/* Verdicts as text, collected while others are being computed. */
typedef struct json_part {
    int verdicts; /* number of verdicts in the text so far */
    char *text;
    size_t size;
    FILE *to; /* NULL: out of memory */
} json_part;

/* Starts the text. The structure must not move until it is freed. */
void json_part_begin(json_part *);
/* Adds the verdicts found since the last call. */
void json_part_add(json_part *, const sweep *s, const evaluation *j);
void json_part_free(json_part *);
/* Writes the verdicts of a verification. part: verdicts that have already been converted; NULL:
 * none. */
status json_write_verdicts(FILE *to, const sweep *s, const evaluation *j, const environment *e,
                           json_part *part, fault *f);

/* Writes the times of all meshes, with the quantities that have a reference value. */
status json_timing_write(FILE *to, const sweep *s, const evaluation *j, const environment *e,
                         fault *f);
/* Writes every quantity of every series for all meshes, with limit, order and verdict, and the
 * formulations whose error is within the level in every quantity. */
status json_convergence_write(FILE *to, const sweep *s, const truths *t, double level, fault *f);

/* Converts a record. keys: KEY_AROUND if the context does not identify the record, otherwise 0. */
json_t *json_record(const record_type *type, const subject *s, int keys);
void json_record_add(json_t *list, const record_type *type, const subject *s, int keys);
json_t *json_record_type(const record_type *type);

/* Writes verdicts for continuous integration as JUnit XML. Values and tolerances are properties. */

void junit_write(FILE *to, const sweep *s, const evaluation *j);

typedef enum place_kind {
    PLACE_FREE, /* the file does not exist, but its folder does */
    PLACE_FILE, /* an existing regular file */
    /* a pipe or a device, or the file that receives standard output or standard error */
    PLACE_STREAM,
    PLACE_FOLDER
} place_kind;

typedef struct file_place {
    place_kind kind;
    int descriptor;      /* 1, 2: standard output or standard error of this process; -1: none */
    int shared;          /* 1: a character device, to which several outputs may be written */
    char path[PATH_MAX]; /* path with links resolved; for a stream, the given path */
    dev_t device;        /* device of the file, or of its folder if the path is free */
    ino_t inode;
    mode_t mode; /* permissions of the existing file */
    uid_t owner;
    gid_t group;
} file_place;

/* Finds the target of a path. REFUSED: the path is empty. FAULT: the path is too long, or its
 * folder does not exist. */
status place_find(const char *path, file_place *out, fault *f);
/* Reports that the file or folder cannot be written. why: value of errno. Returns FAULT. */
status place_unwritable(const char *path, int why, fault *f);
/* Returns 1 if both are the same file, according to device and inode. If the paths are free,
 * compares the names in the same folder. */
int place_same(const file_place *a, const file_place *b);
/* Returns the part of a path after its folder. */
const char *place_leaf(const char *path);

/* A whole file must be a regular file, because it is accessed at arbitrary positions. */
typedef enum output_form { OUTPUT_TEXT, OUTPUT_WHOLE_FILE } output_form;

typedef struct output {
    FILE *stream;
    file_place to;
    char temporary[PATH_MAX]; /* temporary file; empty: the target is written directly */
} output;

/* Returns 1 if the file name has an HDF5 extension. */
int output_is_hdf5(const char *path);
/* Opens a text file. path NULL: standard output. */
status output_open(const char *path, output *out, fault *f);
status output_open_whole(const char *path, output *out, fault *f);
/* Flushes and renames the file, and reports every write error. After a failure, no file remains. */
status output_close(output *out, fault *f);
status output_finish(output *out, status written, fault *f);
status output_flush(fault *f);
/* Like output_flush, but also returns FAULT if an earlier write to standard output failed. */
status output_all_written(fault *f);
/* Checks an output before any computation. *where: location of the output, for comparison with
 * other outputs. REFUSED: the path is empty, or names a file that does not suit the form. FAULT:
 * the file cannot be written. */
status output_try(const char *path, output_form form, file_place *where, fault *f);
/* Deletes incomplete temporary files and folders of this process. A signal handler may call this
 * function. */
void output_abandon(void);
/* Sets `partial` to the name for the partial result of an interrupted run, such as
 * "results.partial.h5" for "results.h5". A stream keeps its name. */
status output_partial(const char *path, char partial[PATH_MAX], fault *f);

/* Writes an HDF5 file that appears complete or not at all. The file is built in memory or under a
 * temporary name, then renamed. */

typedef struct record_file {
    hid_t file, scalar;
    int bad;
    /* output of a file that is built on disk; stream NULL: the file is built in memory */
    output to;
} record_file;

status record_open(record_file *r, fault *f);
/* Starts a file that is built on disk, for data larger than memory. REFUSED, FAULT: the file cannot
 * be written at this path. */
status record_open_beside(record_file *r, const char *path, fault *f);
/* Writes the file and frees its memory. path NULL: writes nothing. A file built on disk is written
 * to the path that was given when it was opened. */
status record_close(record_file *r, const char *path, fault *f);
/* Frees the memory without writing the file. Returns `outcome`. */
status record_drop(record_file *r, status outcome);

void record_text(record_file *r, hid_t at, const char *name, const char *text);
/* Writes an attribute text[count]. */
void record_text_list(record_file *r, hid_t at, const char *name, int count,
                      const char *const text[]);
void record_count(record_file *r, hid_t at, const char *name, long value);
void record_number(record_file *r, hid_t at, const char *name, double value);
/* Creates a data set of any type. Large data sets are compressed. The caller closes the data set
 * with H5Dclose. */
hid_t record_array(record_file *r, hid_t at, const char *name, hid_t type, int rank,
                   const hsize_t size[], const void *value);
/* Creates a data set of rank 0 to 3 with its unit (NULL: none). The caller closes the data set with
 * H5Dclose. */
hid_t record_values(record_file *r, hid_t at, const char *name, int rank, const hsize_t size[],
                    const double value[], const char *unit);
/* Returns a fixed-length UTF-8 type. The caller closes the type with H5Tclose. */
hid_t record_text_type(size_t length);
/* Creates a data set row[count] of the given type. The caller closes the data set with H5Dclose. */
hid_t record_table(record_file *r, hid_t at, const char *name, hid_t type, int count,
                   const void *row);

/* A results file for all experiments. */

#define KEPT_GROUPS "experiments"
#define KEPT_SWEEP  "sweep"
/* Attribute of the group of a sweep, or of the root of a file that was written for a single sweep.
 * If another experiment is added to such a file, its root becomes the group. */
#define KEPT_SWEEP_MARK "beamwork_sweep"

enum { KEPT_NAMES = 200 };
/* Writes the names of the experiments whose results the file contains, or "no experiment". */
void kept_names(hid_t file, char text[KEPT_NAMES]);
/* Creates the group for the output of an experiment; name NULL: the root. The caller closes the
 * group with H5Gclose. */
hid_t kept_group(record_file *r, const char *name);
/* Like record_close, but keeps the other experiments in the file at `path`. After FAULT, the file
 * is unchanged. */
status kept_close(record_file *r, const char *name, const char *path, fault *f);
/* Checks an existing file before the computation. REFUSED: the message gives the reason. FAULT: the
 * file cannot be locked. */
status kept_check(const char *path, fault *f);

/* Summary of a verification as Markdown, for the description of a pull request. */

void markdown_write(FILE *to, const sweep *s, const evaluation *j, const overview *o,
                    const environment *e);

/* A folder that appears complete or not at all. */

typedef struct output_folder {
    file_place to;
    char temporary[PATH_MAX];
} output_folder;

/* Checks that the folder can be created, and sets *where. REFUSED: the path exists and is not an
 * empty folder. FAULT: the folder cannot be written. */
status output_folder_try(const char *path, file_place *where, fault *f);
status output_folder_open(const char *path, output_folder *out, fault *f);
/* Creates a file in the folder, such as "K.mtx" or "state/K.mtx", with the output of `write` for
 * `what`. */
status output_folder_file(const output_folder *, const char *name,
                          void (*write)(FILE *, const void *what), const void *what, fault *f);
/* Renames the folder if `written` is OK, otherwise removes it. */
status output_folder_finish(output_folder *, status written, fault *f);

#define REACH_LINE_LEVEL 0.01 /* level if none is requested */

/* Writes one line such as "for 1 % in every quantity: collocation n = 1 (0.3 ms), sheet_third n = 2
 * (0.4 ms): costs tie; beamw n = 8 (2 ms)". The times are the costs of the counted work. The line
 * refers to the first point. */
void reach_line_write(FILE *to, const sweep *s, const truths *t, double level);
/* Writes one line with the difference of the passing formulations from a solid, plate or shell.
 * Writes nothing if the difference is unknown. */
void reach_model_write(FILE *to, const sweep *s, const truths *t, double level);

/* Like record_rows_of_type, for records that the context does not identify. */
void record_rows_alone(record_file *r, hid_t at, const record_type *type, int count,
                       const subject row[]);
/* Writes a record as attributes. */
void record_fields(record_file *r, hid_t at, const record_type *type, const subject *s);

/* Hash for the content of a stored run. */

typedef struct results_hash {
    char text[DIGEST_TEXT];
    long values; /* number of hashed numbers and texts */
} results_hash;

/* Hashes every data set of results.h5 or of another beamwork file, row by row and in the order of
 * names. Omits the tables `timings`, data sets and columns with names `seconds...`, and attributes.
 * FAULT: the file is not a beamwork file. */
status results_hash_of(const char *path, results_hash *out, fault *f);

/* results.h5: all results of a sweep, for the reports. */

typedef struct store {
    record_file file;
    hid_t root, cases;
    const char *experiment; /* experiment whose group is written; NULL: the root is written */
    const sweep *sweep;
    const evaluation *evaluated;
} store;

/* Opens the store. The arguments must exist as long as the file is open. */
status store_open(const char *experiment, const sweep *s, const evaluation *j, store *out,
                  fault *f);
/* Adds a case. All its series must already have been evaluated. */
void store_case(store *, const case_type *);
/* Adds the remaining cases and the description of the run. The file is written under a temporary
 * name and renamed. After FAULT, no file remains. path NULL: nothing is written. */
status store_close(store *, const char *path, const environment *e, fault *f);

/* Writes the whole file under a temporary name and renames it. After FAULT, no file remains. */
status store_write(const char *path, const char *experiment, const sweep *s, const evaluation *j,
                   const environment *e, fault *f);
/* Writes the first cell of a sweep, without verdicts, in the same way as store_write. Its shapes
 * are also written for VTK. */
status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f);

/* Writes the program, the commit and the time as attributes of a group. */
void store_environment(record_file *r, hid_t at, const environment *e);

/* A folder with the matrices of small motions about the states of a solution, one folder per state.
 * dofs.csv: meaning of each row; loads.csv: meaning of each column of B; states.csv: meaning of
 * each folder. */

/* Writes the folder, which appears complete or not at all. REFUSED: the path exists and is not an
 * empty folder. FAULT: a write error, or out of memory. title: description of the solution in one
 * line, for the comments of the matrices. */
status system_folder_write(const char *path, const char *title, const scene *,
                           const system_matrices *, fault *);

/* Reads columns of an HDF5 table into rows of the caller. The contents of the file are checked. */

/* A column is read into a member of the row: INT, LONG, DOUBLE, FLAG (a signed char), or a text of
 * at most room - 1 bytes. An ENUM is stored as its word. */
typedef struct table_column {
    const char *name;
    field_kind kind;
    size_t offset, room; /* room: capacity for a text */
} table_column;

/* Reads the table and returns the number of rows. Each row has `size` bytes. The caller frees the
 * rows. Returns -1 if the table or a column of this kind is missing, or if memory is
 * insufficient. */
int table_reader_rows(hid_t at, const char *name, int columns, const table_column column[],
                      size_t size, void **rows);

/* Reads a text attribute of fixed length. Returns 0 if the attribute is missing, too long or of
 * another type. */
int table_reader_attribute_text(hid_t at, const char *name, char *text, size_t size);
/* Reads an integer from a scalar attribute. Returns 0 if the attribute is missing or of another
 * type. */
int table_reader_attribute_count(hid_t at, const char *name, long *out);

#endif
