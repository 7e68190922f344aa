/* records/: result files and other formats of results, comparison of runs.
 *
 * Sections, in this order: assumptions; stored runs; comparison; csv; schema; lines of CSV;
 * digest; positions of records; followed modes; gather; json; junit; paths; output; HDF5 files;
 * kept (one file for all experiments); markdown; output folders; reach; rows; hash; store;
 * system folder; columns. */
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

/* Assumptions on the sections of a user's scene: properties that their numbers do not give
 * are zero; physics of them that no formulation models is omitted. One list for text, CSV, JSON,
 * HDF5 and the report. */

typedef enum assumption_kind {
    ASSUMPTION_NOT_KNOWN,
    ASSUMPTION_NOT_MODELLED,
    ASSUMPTION_KINDS
} assumption_kind;

enum { ASSUMPTION_TEXT = 320 };
typedef struct assumption {
    assumption_kind kind;
    int section;                /* of the scene */
    char physics[100];          /* "shear, warping": in words of `omit`; "": none of these */
    char text[ASSUMPTION_TEXT]; /* what is assumed, with the name of the section */
} assumption;

const char *assumptions_kind(int kind); /* "not known" */
/* The index-th of the point. 0: there is none. */
int assumptions_at(const sweep_point *p, int index, assumption *out);
/* All of them, "kind: text", with semicolons between; what finds no room is counted. */
void assumptions_words(const sweep_point *p, size_t size, char out[]);

/* Results of a stored run: errors and work, cell by cell, and in one line for each series of
 * meshes. Read back from results.h5, or from the short table of its series that can be committed.
 */

typedef enum results_work {
    WORK_ITERATIONS,
    WORK_EVALUATIONS,
    WORK_FACTORISATIONS,
    RESULTS_WORKS
} results_work;
extern const char *const results_work_names[RESULTS_WORKS];

/* Errors below this, relative to the reference value, are round-off and the criterion of
 * iterations. */
#define RESULTS_FLOOR 1e-8

enum { RESULTS_STATUS = 16, RESULTS_MOST_ELEMENTS = 10000000 };

typedef struct result_value {
    char quantity[SCENE_NAME];
    double value,
        near_zero; /* [unit of the quantity]; NAN: none; below near_zero it counts as zero */
    double error;  /* relative to the reference value; NAN: no truth */
    double limit;  /* of the series, at its finest mesh of a default point; NAN: none */
} result_value;

typedef struct result_cell {
    char *name; /* case/parameters/formulation */
    int elements;
    char status[RESULTS_STATUS];
    long work[RESULTS_WORKS];
    double cost; /* of counted work [s], of a sweep; not positive or NAN: not known */
    int values;
    result_value *value;
} result_cell;

typedef struct result_mesh {
    int elements;
    char status[RESULTS_STATUS];
} result_mesh;

typedef struct result_limit {
    char quantity[SCENE_NAME];
    double value, near_zero; /* as of a value; near_zero 0: not known */
} result_limit;

/* Largest of the |errors| of one mesh. elements 0: no value has an error. */
typedef struct result_error {
    double size;
    int elements;
    char quantity[SCENE_NAME];
} result_error;

/* All meshes of a formulation at a parameter point. */
typedef struct result_series {
    char *name; /* case/parameters/formulation */
    int meshes, limits;
    result_mesh *mesh;        /* [meshes] ascending by elements */
    long work[RESULTS_WORKS]; /* sums over the meshes */
    int errors;               /* values that have one, of all meshes */
    double decades; /* sum of log10(|error| + RESULTS_FLOOR) over them: moves with every one */
    result_error least, largest; /* of the mesh where it is least; of all meshes */
    result_limit *limit;         /* [limits] of a default point, in the order of its quantities */
} result_series;

/* The selection of a run: series outside it were not requested; they are not missing. NULL: all. */
typedef struct results_part {
    char *select;               /* expression of harness/formulations/formulations.h */
    char *cases, *formulations; /* a line each */
    char *fresh;                /* formulations that do not affect the exit status yet, a line
                                   each; NULL: none */
} results_part;

typedef struct stored_results {
    results_part part;
    int cells, seriess;
    int whole;             /* 1: with cells, 0: with series only */
    int limits;            /* 1: limits were evaluated */
    int swept;             /* 1: a sweep; its cells of no mesh have the references of a point */
    result_cell *cell;     /* ascending by name and elements */
    result_series *series; /* ascending by name */
} stored_results;

/* HDF5 or table, distinguished by the first bytes. FAULT: missing, truncated, foreign or damaged,
 * or a sweep. */
status results_read(const char *path, stored_results *out, fault *f);
/* The same of an experiment: "verify", "bench", or "sweep", which has no series; NULL: the first of
 * these that is there. */
status results_read_any(const char *path, const char *experiment, stored_results *out, fault *f);
void results_free(stored_results *r);

/* A zeroed one at the end, or NULL. */
result_cell *results_add(stored_results *r);
result_series *results_add_series(stored_results *r);
result_mesh *results_add_mesh(result_series *s);
result_limit *results_add_limit(result_series *s);

int results_order(const result_cell *a, const result_cell *b); /* of name, then elements */
/* Fills the series from the cells, which are in order. FAULT: out of memory. */
status results_series_summarise(stored_results *r, fault *f);

/* Is the text one of the lines? lines NULL: no. */
int results_part_has(const char *lines, const char *text);
/* Was the quantity of a series (case/parameters/formulation) requested? */
int results_part_selects(const results_part *p, const char *series, const char *quantity);
/* Was a series that `other` alone has requested, of the run r: any of its quantities, as the two
 * know them? */
int results_part_wants(const stored_results *r, const stored_results *other, const char *series);
/* Were other quantities of a series requested in one run than in the other, as the two know them?
 */
int results_part_differ(const stored_results *a, const stored_results *b, const char *series);
/* Is its formulation new to the run? */
int results_part_is_fresh(const results_part *p, const char *series);
void results_part_free(results_part *);

status results_hdf5_read(const char *path, const char *experiment, stored_results *out, fault *f);
status results_table_read(const char *path, FILE *from, stored_results *out, fault *f);
void results_table_write(FILE *to, const stored_results *r);

/* Two stored runs side by side: what became worse, better, or is there in one of them only. Whole
 * runs, and sweeps, cell by cell and quantity by quantity, else series by series. No truth is
 * involved: a former run says nothing of what is right, only that something has changed. */

typedef struct comparison_limits {
    double error; /* relative change of an error */
    double floor; /* change of a value relative to its reference value that is round-off */
    double
        work; /* relative change of a count of one mesh; of a series: of the mean of its meshes */
} comparison_limits;
/* Default limits. */
extern const comparison_limits comparison_limits_default;

typedef enum comparison_kind {
    CHANGE_WORSE,
    CHANGE_BETTER,
    CHANGE_OTHER,
    CHANGE_GONE,
    CHANGE_NEW,
    COMPARISON_KINDS
} comparison_kind;
extern const char *const comparison_kind_names[COMPARISON_KINDS];

typedef struct comparison {
    int whole;                     /* 1: cell by cell; 0: series by series */
    int judged;                    /* 1: both have limits */
    int swept;                     /* 1: sweeps */
    int pairs;                     /* cells or series in both */
    int count[COMPARISON_KINDS];   /* lines of each kind */
    double work[2][RESULTS_WORKS]; /* sums over the pairs: old | new */
    double cost[2];                /* of counted work [s], of sweeps */
    /* series in one of the two only (old | new) that are no change: outside the selection of the
     * other run; of formulations that do not affect the exit status yet */
    int outside[2], fresh[2];
    int partial; /* series of which one run omits some quantities: neither their errors nor their
                    work are compared */
} comparison;

/* "error=0.01,floor=1e-8,work=0.02", any of them. REFUSED names the culprit. */
status comparison_limits_parse(const char *text, comparison_limits *out, fault *f);
/* Writes one line for each difference. Series outside the selection of one of the two are counted,
 * not written, and so are series of new formulations in one of them. Names that do not match
 * `select` (of study.h; NULL: all) are omitted. */
void comparison_run(FILE *to, const stored_results *before, const stored_results *after,
                    const comparison_limits *limits, const char *select, comparison *out);
int comparison_differs(const comparison *c);

/* Results for spreadsheets: one row per value, full precision, empty where there is none. */

void csv_solution(FILE *to, const sweep *s);
void csv_convergence(FILE *to, const sweep *s, const truths *t);
/* Table of a benchmark: a row for every cell and judged quantity. */
void csv_timing(FILE *to, const sweep *s, const judgement *j);

/* One schema for all records: a table of fields for each kind of record, from which HDF5, JSON, CSV
 * and `beamwork schema` are written, with the same names. A new field is one line of a table. */

enum { SCHEMA_VERSION = 3, SCHEMA_OLDEST = 2, SCHEMA_MOST_FIELDS = 96, FIELD_ROOM = 2048 };
#define SCHEMA_NAME "beamwork-results"
/* Unit of a number that is in the unit which the record's own field `unit` names. */
#define OWN_UNIT "unit"

/* Role of a field that identifies the subject of the record. KEY_AROUND: only where nothing around
 * the record identifies it (CSV, lists of JSON). */
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

/* A record in its surroundings; what does not apply is NULL (numbers: 0). */
typedef struct subject {
    const sweep *sweep;
    const sweep_point *point;
    const series *series;
    int mesh;           /* of the series */
    const void *record; /* what most offsets refer to */
    int index;          /* among its like: of a quantity, a step, an iteration, a station */
    int group;          /* step that an iteration belongs to; first point of a curve */
    const verdict *verdict;
    const truth *truth, *model_truth; /* that a quantity is compared with */
    const void *owner;                /* what the record is part of */
} subject;

/* Surroundings of a record: offsets may refer to it. */
typedef enum field_base {
    BASE_RECORD,
    BASE_SUBJECT,
    BASE_POINT,
    BASE_CASE, /* case_type */
    BASE_SERIES,
    BASE_FORMULATION, /* element_type */
    BASE_CELL,
    BASE_QUANTITY, /* scene_quantity that the index counts */
    BASE_TRUTH,
    BASE_MODEL_TRUTH
} field_base;

typedef struct schema_field schema_field;
/* The member that the kind names is set. */
typedef struct field_value {
    const schema_field *of;
    long whole;            /* INT, LONG, FLAG, ENUM */
    const double *numbers; /* DOUBLE: [count of the field]; NAN: there is none */
    const char *text;      /* TEXT, ENUM (its word) */
    double number;         /* room for one number ... */
    char room[FIELD_ROOM]; /* ... and for a text that is put together */
} field_value;

typedef void field_getter(const subject *s, field_value *out);

struct schema_field {
    const char *name, *unit; /* "1": a number without; "": not a number */
    field_kind kind;
    const char *summary;
    field_base base; /* that the offset refers to; where it is NULL there is no value */
    size_t offset;
    int address;              /* 1: a TEXT of which the address is there */
    field_getter *get;        /* derived: instead of what is at the offset */
    const char *(*word)(int); /* ENUM: its words ... */
    int words;                /* ... 0 to words - 1 */
    int count;                /* DOUBLE: numbers of an array (a square matrix); 0: a single one */
    int key;                  /* KEY, KEY_AROUND, or 0: it is what was found */
};

/* Value of a member of the record. */
#define AT(type, member) .offset = offsetof(type, member)
/* In a member of what surrounds it; the same, the address of a text. */
#define OF(place, type, member)      .base = BASE_##place, .offset = offsetof(type, member)
#define TEXT_OF(place, type, member) OF(place, type, member), .address = 1

/* Tables end with a field without name. */
enum { RECORD_PARTS = 5 };
typedef struct record_type {
    const char *name, *table, *summary;     /* table: in HDF5 and lists of JSON */
    const schema_field *part[RECORD_PARTS]; /* one after the other; NULL: no more */
} record_type;

/* A series of meshes, one mesh of it, what it found and how, its time, what the judge says. */
extern const record_type record_point, record_series, record_cell, record_quantity, record_curve,
    record_step, record_iteration, record_event, record_motion, record_matrix, record_timing,
    record_verdict, record_agreement, record_coverage, record_import, record_scene,
    record_parameter, record_meaning, record_assumption;
extern const record_type *const record_types[]; /* all of them; ends with NULL */
extern const record_type record_omission;       /* of a value, in the CSV of a solution only */
extern const record_type record_truth;          /* of a quantity, in JSON only */
extern const record_type record_declaration;    /* of a whole run, in HDF5 only */

/* Pointers to the fields whose key is at most `keys`, in order; their number. */
int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS]);
void schema_read(const subject *s, const schema_field *which, field_value *out);
const char *schema_kind_name(field_kind kind);
/* Helps getters: a text that may be NULL, a number. */
void schema_set_text(field_value *out, const char *text);
void schema_set_number(field_value *out, double number);

/* Records as lines of CSV: full precision, empty where there is no value. */

/* A line is made of several records of one subject each; of fields of the same name the first is
 * written. Matrices are omitted. */
typedef struct csv_part {
    const record_type *type;
    subject s;
} csv_part;

void csv_record_head(FILE *to, int parts, const csv_part part[]);
void csv_record_line(FILE *to, int parts, const csv_part part[]);

/* A field, in quotes where it must be. */
void csv_record_text(FILE *to, const char *text);

/* SHA-256 (FIPS 180-4) of bytes that come one after the other. */

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
/* The digits; the digest may be continued. */
void digest_text(const digest *, char out[DIGEST_TEXT]);
/* All bytes of a file. 0, or -1: it cannot be read. */
int digest_add_file(digest *, const char *path);

/* Identity of a record: the first fields of the tables of fields_*.c, and what these share. */

extern const schema_field keys_of_point[];     /* case, parameter point */
extern const schema_field keys_of_series[];    /* its parameters, formulation */
extern const schema_field key_of_mesh[];       /* elements of each member */
extern const schema_field names_of_quantity[]; /* its name and unit */

enum { STATUSES = STATUS_NO_VALUE + 1 };
/* ENUM fields: their words. */
const char *fields_keys_word_of_status(int status);
const char *fields_keys_word_of_moments(int convention);

/* The quantity that s->index counts. */
const scene_quantity *fields_keys_quantity(const subject *s);
const cell_result *fields_keys_cell(const subject *s);
/* Physics that the scene omits, in words. */
void fields_keys_omitted(const subject *s, field_value *out);

/* Assumptions on its sections, in words. */
void fields_keys_assumed(const subject *s, field_value *out);

/* Modes followed over a parameter, for programs. */

/* A row for each value and mode. */
void follow_record_csv(FILE *to, const char *parameter, const follow_curves *);
/* Columns of each mode, crossings and veerings. */
status follow_record_json(FILE *to, const char *parameter, const follow_curves *, fault *);

/* Lists of records of one kind, in the order of the series. */

typedef struct held_record held_record;
typedef struct subjects {
    int count, room;
    subject *row;
    held_record *held; /* that are in no result */
    int bad;           /* 1: out of memory */
} subjects;

/* Truths that quantities are compared with: those of the verdicts; where nothing was evaluated the
 * stored ones. Both may be NULL. */
typedef struct gathering {
    const sweep *sweep;
    const judgement *judged;
    const truths *truths;
} gathering;

/* Adds the records of all series of a case. */
void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out);
/* Adds those of one mesh; a kind that a mesh has none of adds nothing. */
void gather_mesh(const gathering *g, const record_type *type, int series_index, int mesh,
                 subjects *out);
/* One of each formulation that was run here, in the order of the series. */
void gather_declarations(const gathering *g, subjects *out);
/* Assumptions on its sections. */
void gather_assumptions(const sweep_point *p, subjects *out);
subject gather_cell(const gathering *g, int series_index, int mesh);
subject gather_verdict(const gathering *g, const verdict *v);
subject gather_agreement(const gathering *g, const agreement *a);
subject gather_coverage(const gathering *g, const coverage *c, int left_out);
void gather_add(subjects *list, const subject *one);
/* A copy of a record that lives as long as the list; NULL: out of memory. */
const void *gather_keep(subjects *list, const void *record, size_t size);
void gather_free(subjects *list);

/* JSON of one solution and of a verification (jansson). */

/* Writes and frees root; FAULT when it is NULL (out of memory) or cannot be written. */
status json_finish(json_t *root, FILE *to, fault *f);

/* Adds the physics that the scene of a point omits ("omitted"), and the assumptions on its sections
 * ("assumptions"). */
void json_add_physics(json_t *root, const sweep_point *p);
/* Solution of one cell of a one-point sweep; t may be NULL. */
status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f);
/* Verdicts as text, while others are still reached. */
typedef struct json_part {
    int verdicts; /* that it has: the first ones */
    char *text;
    size_t size;
    FILE *to; /* NULL: out of memory */
} json_part;

/* It stays where it is until it is freed. */
void json_part_begin(json_part *);
/* Adds what has been evaluated since. */
void json_part_add(json_part *, const sweep *s, const judgement *j);
void json_part_free(json_part *);
/* part: what is there already; NULL: nothing. */
status json_write_verdicts(FILE *to, const sweep *s, const judgement *j, const environment *e,
                           json_part *part, fault *f);

/* JSON of what meshes show: values, limits, orders. */

/* Every quantity of every series over its meshes, with limit, order and verdict; which formulations
 * are within the level (relative error) in every quantity. */
status json_convergence_write(FILE *to, const sweep *s, const truths *t, double level, fault *f);

/* Records as objects of JSON, field by field. */

/* JSON has no NaN: a value that does not exist is null. */
json_t *json_record_numbers(int count, const double value[]);
/* keys: KEY_AROUND where nothing around the record says where it belongs; 0: all of it is said. */
json_t *json_record(const record_type *type, const subject *s, int keys);
void json_record_add(json_t *list, const record_type *type, const subject *s, int keys);
json_t *json_record_type(const record_type *type); /* what a record consists of */

/* Verdicts for continuous integration: JUnit XML, values and tolerances as properties. */

void junit_write(FILE *to, const sweep *s, const judgement *j);

/* Target of a path: its kind, and whether two paths lead to the same file. */

typedef enum place_kind {
    PLACE_FREE,   /* nothing is there, its folder is */
    PLACE_FILE,   /* a regular file */
    PLACE_STREAM, /* a pipe or a device, or the file that standard output or error goes to */
    PLACE_FOLDER
} place_kind;

typedef struct file_place {
    place_kind kind;
    int descriptor;      /* 1, 2: it is our own standard output or error; -1 */
    int shared;          /* 1: several may write there (a character device) */
    char path[PATH_MAX]; /* links followed; of a stream: as given */
    dev_t device;        /* of what is there; of a free place: of its folder */
    ino_t inode;
    mode_t mode; /* permissions of what is there */
    uid_t owner;
    gid_t group;
} file_place;

/* REFUSED: an empty path. FAULT: too long, or its folder is not there. */
status place_find(const char *path, file_place *out, fault *f);
/* The same file, by device and inode; of free places: the same name in the same folder. */
int place_same(const file_place *a, const file_place *b);
/* The part of a path after its folder. */
const char *place_leaf(const char *path);

/* Files that appear complete or not at all: written beside, then renamed onto the place that links
 * lead to. Pipes and devices are written to directly, and take text only. */

/* A whole file needs a regular file: it is read at any place, not from its beginning to its end. */
typedef enum output_form { OUTPUT_TEXT, OUTPUT_WHOLE_FILE } output_form;

typedef struct output {
    FILE *stream;
    file_place to;
    char temporary[PATH_MAX]; /* empty: written directly */
} output;

/* 1: its name says that it is HDF5. */
int output_is_hdf5(const char *path);
/* Text; path NULL: onto standard output. */
status output_open(const char *path, output *out, fault *f);
status output_open_whole(const char *path, output *out, fault *f);
/* Flushes and renames; every error is found here. On failure nothing is left. */
status output_close(output *out, fault *f);
/* Closes what was written and discards what was not. */
status output_finish(output *out, status written, fault *f);
/* Standard output has gone where it goes, or FAULT. */
status output_flush(fault *f);
/* Checks an output before anything is computed: REFUSED an invalid name or one that cannot take the
 * form, FAULT a file that cannot be written. *where: its location, for comparison with others. */
status output_try(const char *path, output_form form, file_place *where, fault *f);
/* Deletes the files and folders of this process that were written beside their places and are not
 * complete; a signal handler may call it. */
void output_abandon(void);
/* Calls `make` with an unpredictable name next to `path` and returns its result (-1 and errno: it
 * failed). The file counts as incomplete until output_forget. */
int output_beside(const char *path, int (*make)(const char *name), char temporary[PATH_MAX]);
void output_forget(const char *temporary);
/* A file, or a folder with all that is in it. */
void output_remove(const char *temporary);
/* "results.partial.h5" of "results.h5": of a run that was interrupted. A stream keeps its name. */
status output_partial(const char *path, char partial[PATH_MAX], fault *f);

/* Writing an HDF5 file that appears complete or not at all: it is made in memory and then written
 * beside, or made beside, and renamed. Every call is checked; after the first failure nothing more
 * is tried and record_close says so. */

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

/* One file of results for all experiments: each has a group of its own below /experiments, which a
 * later run replaces whole; what verify leaves is the root. Several runs may write one file at a
 * time: each reads again, under a lock, what the others have left. */

#define KEPT_GROUPS "experiments"
#define KEPT_SWEEP  "sweep"
/* An attribute of the group of a sweep, or of the root of a file that a sweep had for itself: the
 * group of such a file is made of it when others write there. */
#define KEPT_SWEEP_MARK "beamwork_sweep"

/* Group of an experiment's output; name NULL: the root. The caller closes it with H5Gclose. */
hid_t kept_group(record_file *r, const char *name);
/* As record_close, with all that the file at `path` holds of other experiments than `name`. On
 * FAULT the file is as it was. */
status kept_close(record_file *r, const char *name, const char *path, fault *f);
/* Before the work. REFUSED: HDF5 is there that is damaged, or not of results, and would be lost, or
 * another program does not let go of it; FAULT: it cannot be locked. */
status kept_check(const char *path, fault *f);

/* Summary of a verification as Markdown, for the description of a pull request. */

void markdown_write(FILE *to, const sweep *s, const judgement *j, const overview *o,
                    const environment *e);

/* A folder that appears complete or not at all: its files are written into one beside it, which is
 * then renamed.  Nothing that is there is replaced. */

typedef struct output_folder {
    file_place to;
    char temporary[PATH_MAX];
} output_folder;

/* Can it be made, at *where? REFUSED: something is there, other than an empty folder. FAULT: it
 * cannot be written. */
status output_folder_try(const char *path, file_place *where, fault *f);
status output_folder_open(const char *path, output_folder *out, fault *f);
/* A folder inside it. */
status output_folder_below(const output_folder *, const char *name, fault *f);
/* A file inside it, "K.mtx" or "state/K.mtx", is what `write` writes of `what`. */
status output_folder_file(const output_folder *, const char *name,
                          void (*write)(FILE *, const void *what), const void *what, fault *f);
/* Renames it where all was written, and else takes away what there is. */
status output_folder_finish(output_folder *, status written, fault *f);

/* Result of a table of convergence: which formulation, with how many elements. */

#define REACH_LINE_LEVEL 0.01 /* where none is requested */

/* "for 1 % in every quantity: collocation n = 1 (0.3 ms), sheet_third n = 2 (0.4 ms): within noise
 * of each other; beamw n = 8 (2 ms)": in the order of study.h, with the cost of their counted work;
 * after it those that have a defect, those that are not within the level, and how far the ones
 * that pass are from truths of another model. "in 5 of 6 quantities (without a reference:
 * frequency_1)" where some have neither a reference value nor an agreement; curves do not count. Of
 * the first point. One line. */
void reach_line_write(FILE *to, const sweep *s, const truths *t, double level);

/* Records as rows of a typed, compressed table; units and summaries of the columns are its
 * attributes. */

/* New table `name` below `at`; texts have the length of the longest in their column. */
void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[]);
/* The table of a kind of record, with its keys. */
void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[]);
/* The same where nothing around it says what the records belong to. */
void record_rows_alone(record_file *r, hid_t at, const record_type *type, int count,
                       const subject row[]);
/* A record as attributes. */
void record_fields(record_file *r, hid_t at, const record_type *type, const subject *s);

/* One number for all that a stored run says: two runs that differ in nothing but times, machines
 * and versions have the same. */

typedef struct results_hash {
    char text[DIGEST_TEXT]; /* SHA-256 */
    long values;            /* numbers and texts that it is of */
} results_hash;

/* Every dataset in the order of names, by rows: results.h5, and any other file of beamwork.
 * Omitted: tables `timings`, datasets named `seconds...`, attributes. FAULT: not a file of
 * beamwork. */
status results_hash_of(const char *path, results_hash *out, fault *f);

/* results.h5: everything a sweep found, for the reports. Below /cases/CASE a table for each kind of
 * record (record_type), the points of curves and the shapes in arrays beside; `beamwork schema`
 * describes them. */

/* A file that is filled case by case, while others are still run. */
typedef struct store {
    record_file file;
    hid_t root, cases;
    const char *experiment; /* whose group is filled; NULL: the root */
    const sweep *sweep;
    const judgement *judged;
} store;

/* All live as long as the file is open. */
status store_open(const char *experiment, const sweep *s, const judgement *j, store *out, fault *f);
/* A case, all of whose series have been evaluated. */
void store_case(store *, const case_type *);
/* Adds the cases that are not there yet, and the description of the run. Written next to the file
 * and renamed: FAULT leaves no file behind. path NULL: nothing is written. */
status store_close(store *, const char *path, const environment *e, fault *f);

/* Written beside and renamed: FAULT leaves no file behind. */
status store_write(const char *path, const char *experiment, const sweep *s, const judgement *j,
                   const environment *e, fault *f);
/* The first cell of a sweep in the same way, without verdicts, and its shapes for VTK too. */
status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f);

/* The attributes by which a group says of which program, commit and time it is. */
void store_environment(record_file *r, hid_t at, const environment *e);

/* A folder with the matrices of small motions about the states of a solution:
 *   dofs.csv    what each row is, loads.csv what each column of B is, states.csv what each folder
 * is STATE/      K.mtx, M.mtx, where the axes turn G.mtx, where there are loads B.mtx */

/* title: of the solution, one line, for the comments of the matrices. The folder appears complete
 * or not at all. */
status system_folder_write(const char *path, const char *title, const scene *,
                           const system_matrices *, fault *);

/* Reading columns of a table of HDF5 into rows of the caller. Everything in the file is checked. */

/* Into a member of the row: INT, LONG, DOUBLE, FLAG (a signed char), or a text of at most room - 1
 * bytes (an ENUM is stored as its word). */
typedef struct table_column {
    const char *name;
    field_kind kind;
    size_t offset, room; /* room: of a text */
} table_column;

/* Rows of `size` bytes, which the caller frees; their number. -1: the table, a column of that kind,
 * or memory is missing. */
int table_reader_rows(hid_t at, const char *name, int columns, const table_column column[],
                      size_t size, void **rows);

/* Text attribute of fixed length; 0: it is not there, too long or of another type. */
int table_reader_attribute_text(hid_t at, const char *name, char *text, size_t size);
/* Whole number of a scalar attribute; 0: it is not there or of another type. */
int table_reader_attribute_count(hid_t at, const char *name, long *out);

#endif
