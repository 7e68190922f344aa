#ifndef BEAMWORK_CASES_FORMAT_FORMAT_IMPL_H
#define BEAMWORK_CASES_FORMAT_FORMAT_IMPL_H

#include <stdio.h>

#include "cases/case.h"
#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/section/section.h"

/* Returns zeroed memory that is aligned for every type. If out of memory, returns NULL and sets
 * `failed`. An arena initialised with {0} is empty. */
void *arena_take(arena *a, size_t size);
const char *arena_copy(arena *a, const char *text, size_t length);

/* A list of the names that expressions may use: parameters, derived values and loop names. Points
 * to the last name; NULL is an empty list. */
typedef struct scope {
    const char *name;
    double number;       /* NAN if its expression has an error, which has been reported */
    const char *word;    /* word of a choice, or NULL if the name stands for a number */
    const char *choices; /* choices "a|b|c" of a parameter, or NULL */
    const double
        *constants; /* constants of a section, whose name ends with a point; otherwise NULL */
    const struct scope *before;
} scope;

/* Adds a name for a number. Returns the new scope, or `names` if out of memory. */
const scope *scope_number(const scope *names, const char *name, double number, arena *a);
const scope *scope_word(const scope *names, const char *name, const char *word, arena *a);
const scope *scope_choice(const scope *names, const char *name, const char *word,
                          const char *choices, arena *a);
const scope *scope_constants(const scope *names, const char *name, const double value[], arena *a);
/* Returns the entry of the name, of `length` characters, or NULL. */
const scope *scope_find(const scope *names, const char *name, size_t length);
/* Returns the known name, constant or function that is nearest to a misspelt name, or NULL. */
const char *scope_nearest(const scope *names, const char *name);
/* Returns 1 if `key` can be a new name. Such a name has at most 40 letters, digits and underscores,
 * does not start with a digit, and differs from all other names, functions and constants. Otherwise
 * reports an error and returns 0. */
int scope_accepts(const scope *names, const document_node *key, mistakes *m);

/* Builds a scene from a checked tree and the parameters `names`. The caller frees it in either
 * case. */
void build_scene(const document_node *root, const scope *names, arena *a, mistakes *m, scene *out);

struct builder;
void build_sections(struct builder *b);

/* An entry of a map or list for one pass of its loops. Loop names $i in its name and strings are
 * replaced by their values. */
typedef struct unrolled {
    const char *name;           /* name of an entry of a map, or NULL for a list */
    const document_node *place; /* its position in messages: the key or the entry */
    const document_node *value;
    const document_node *written; /* the value as written in the file */
    const scope *names;
    const struct placement *placed; /* instance to which the entry belongs, or NULL for the scene */
} unrolled;

enum { UNROLL_MOST = 10000 };

/* Expands all entries in the order of the file. Returns their number. The first loop of an entry is
 * the outermost. An entry with an error in a loop is reported and omitted. */
int unroll_entries(const document_node *collection, const scope *names, arena *a, mistakes *m,
                   unrolled **out);
/* Reads the local names, NAME: EXPR. An expression may contain the names that precede it. */
const scope *unroll_let(const document_node *let, const scope *names, arena *a, mistakes *m);

/* Position and orientation of an instance of a part. A part is a sub-assembly in its own axes. */
typedef struct placement {
    const char *name; /* NAME; its entries have the names NAME.ENTRY */
    double origin[3]; /* [m] */
    int turned;       /* 0 if the axes of the instance are those of the scene */
    double R[9]; /* rotation matrix, row-major: column i is axis i of the instance in the axes of
                    the scene */
    const document_node *connect; /* PORT: NODE, or NULL */
} placement;

enum { PLACEMENT_LISTS = 4 };
/* Names of the lists of a part, such as "nodes". */
extern const char *const placement_list[PLACEMENT_LISTS];

/* Appends the entries of all instances to list[k], the list with the name placement_list[k], which
 * has count[k] entries. */
void placement_unroll(const document_node *root, const scope *names, arena *a, mistakes *m,
                      unrolled *list[], int count[]);

/* Reports that the value of a parameter is below its minimum or above its maximum. */
void mistake_parameter(mistakes *m, const document_node *n, const parameter_type *p, double value);
/* Reports that two axes are not perpendicular, or that one of them is the zero vector. */
void mistake_axes(mistakes *m, const document_node *axes);

/* Transform a vector (v <- R v) or a position (p <- origin + R p) to the axes of the scene. If the
 * placement is NULL, nothing changes. */
void placement_turn(const placement *, double v[3]);
void placement_move(const placement *, double p[3]);
/* Returns the node of the scene that is connected to a port of the instance, or NULL if `name` is
 * not a port. */
const document_node *placement_port(const placement *, const char *name);

/* Reports an error if the text is not an SI unit. For other known units, the message contains the
 * conversion. */
void units_check(const document_node *unit, mistakes *m);

/* Units of a scene. The units of length and force determine those of stress and mass (force
 * s^2/length). */
typedef struct unit_system {
    int given;            /* 0 for SI units */
    double length, force; /* size of one unit in m and in N */
    const char *name_of_length, *name_of_force;
    char name_of_stress[16];
} unit_system;

/* Reads "mm, N, MPa" or [mm, N, MPa]. If n is NULL, the units are SI. Inconsistent units are an
 * error. */
void units_read(const document_node *n, mistakes *m, unit_system *out);
/* Converts the name of an SI unit to that of the unit system; for example, "N m" becomes "N mm". */
void units_translate(const unit_system *, const char *unit, size_t size, char out[]);
/* Reports an error if the text contains a unit of length, force or stress that the unit system does
 * not use, or a unit of an angle or a time other than rad and s. */
void units_check_own(const document_node *unit, const unit_system *, mistakes *m);

/* State of a scene that is built from a checked tree. After an invalid value, the error is reported
 * and an arbitrary value is used. */

typedef struct builder {
    arena *arena;
    mistakes *mistakes;
    scene *scene;
    const document_node *root;
    const scope *names; /* names that expressions may use */
    unit_system units;  /* units of the numbers in the file */
    struct {
        unrolled *entry;
        int count;
        int incomplete;  /* 1 if entries were omitted after errors */
    } list[SCENE_LISTS]; /* entries of each list, in the order of the indices of the scene */
    const char **shared; /* names of warping coordinates shared by members */
    int shares;
    int default_warping; /* warping of ends for which the file gives none */
} builder;

/* A map: an entry, or a map inside an entry. */
typedef struct fields {
    builder *b;
    const scope *names;
    const document_node *map; /* NULL for an empty map */
    const document_node *place;
    const placement *placed; /* instance to which the map belongs, or NULL */
} fields;

fields fields_of(builder *b, const unrolled *entry);
fields fields_below(const fields *f, const char *key);
int fields_have(const fields *f, const char *key);
/* Reads all values of the table into the struct of the entry. If a map is missing, its values do
 * not change. */
void fields_read(const fields *f, const entry_field *table, void *entry);
double fields_number(const fields *f, const char *key, double otherwise);
int fields_whole(const fields *f, const char *key, int otherwise, int least, int most);
/* Reads a vector and returns 1, even after an error, which is reported. If the key is missing,
 * returns 0 and does not change out[count]. */
int fields_vector(const fields *f, const char *key, int count, double out[]);
/* Reads a list or range. Returns the number of values, or 0 if the key is missing or after an
 * error. *out belongs to the arena. */
int fields_values(const fields *f, const char *key, double **out);
/* Reads a 6 x 6 matrix, given by its 36 entries, or by the six of its diagonal (the other entries
 * of `out` then do not change). Returns 0 and does not change `out` if the key is missing or after
 * an error. */
int fields_matrix(const fields *f, const char *key, double out[36]);
const char *fields_text(const fields *f, const char *key, const char *otherwise);
/* Returns the index in "a|b|c" of the value of the key: a word, or a parameter whose value is a
 * word. Returns `otherwise` if the key is missing. */
int fields_word(const fields *f, const char *key, const char *choices, int otherwise);
int fields_word_of(const fields *f, const document_node *word, const char *what,
                   const char *choices, int otherwise);
/* Returns one bit for each word of the value: a word or a list of words. */
unsigned fields_words(const fields *f, const char *key, const char *choices);
/* Returns the index of the entry that the key names, or SCENE_NONE. */
int fields_entry(const fields *f, const char *key, scene_list list);
int fields_entry_of(const fields *f, const document_node *name, scene_list list);
/* Returns the word of the parameter that the string names, or the string itself if there is no such
 * parameter. */
const char *fields_called(const fields *f, const document_node *name);
/* Returns 1 if the key names an existing entry. Reports no error. */
int fields_names(const fields *f, const char *key, scene_list list);
int fields_names_entry(const fields *f, const document_node *name, scene_list list);
extern const char fields_components[];

void builder_call(builder *b, scene_list list, int index, int i);

void builder_sections(builder *b);
void builder_nodes(builder *b);
void builder_axes(builder *b);
void builder_members(builder *b);
void builder_springs(builder *b);
void builder_constraints(builder *b);
void builder_imperfections(builder *b);
void builder_motions(builder *b);
void builder_cases(builder *b);
void builder_combinations(builder *b);
/* builder_read_cases reports an error for each load case that is not used. */
void builder_read_cases(builder *b);
void builder_loads(builder *b);
void builder_analyses(builder *b);
void builder_quantities(builder *b);
void builder_in_time(const fields *f, scene_motion *how);
/* Adds a piece to the function of time of an entry. */
typedef void builder_piece(scene *, int index, double until, const char *text);
/* Adds the function given by `time`, `pieces` or `table`. A table is interpolated linearly or, if
 * `spline` is 1, by a cubic spline that starts and ends at rest. */
void builder_function(const fields *f, int index, builder_piece *add, int spline);
/* Reports that the analysis does not support the quantity, and lists the kinds of analysis that
 * do. */
void builder_no_quantity(const fields *what, const char *key, const scene_quantity *q);
/* Reads the stations `path` and the key `values`, with one value per station. Returns the number of
 * stations, or 0 if there are none or after an error. */
int builder_stations(const fields *f, const char *values, double **path, double **value);
void builder_defaults(builder *b);

/* Reads a section given by dimensions (I, T, channel, Z, angle, box) or by the name of a rolled
 * section. Returns 1 and sets the points and walls. Returns 0 for other sections. */
int build_shapes_read(const fields *f, section_spec *spec);

/* Returns 1 if all conditions {NAME: VALUE, NAME: [VALUE, ...], ...} are satisfied or `conditions`
 * is NULL. A list is satisfied if the name has one of its values. Returns 0 otherwise and after an
 * error. */
int choose_holds(const document_node *conditions, const scope *names, mistakes *m);
/* Returns the entry of {NAME: {VALUE: ..., else: ...}} for the current value of the name. Returns n
 * if it does not have this form. Returns NULL after an error. */
const document_node *choose_value(const document_node *n, const scope *names, mistakes *m);

typedef struct name_context {
    const scope *names;
    int in_time; /* 1 if the expression is a function of time */
} name_context;
int names_number(const void *context, const char *text, int *at, double *out, expression_mistake *);

/* Evaluates an expression. Returns 1, or 0 after an error, which is reported at its character. */
int expression_number(const document_node *n, const scope *names, mistakes *m, double *out);
/* Reads a list of exactly `count` numbers. */
int expression_vector(const document_node *n, int count, const scope *names, mistakes *m,
                      double out[]);

/* Replaces the keys `file`, `at` and `value` of all tables, and the files of `shifts`, below the
 * node by the numbers in the files. Paths are relative to the folder of the scene file, whose path
 * is `beside`, or NULL. */
void table_files_read(document_node *, const char *beside, arena *a, mistakes *m);

extern const entry_field keys_let[], keys_refusal[], keys_root[], keys_truth[], keys_parameter[],
    keys_part[], keys_instance[];

/* `for`, `let` and `if`, which every entry may have. */
extern const entry_field keys_loop[];
/* Returns 1 if the entries of this table may have loops. */
int keys_loops(const entry_field *table);
int keys_is_loop(const char *name);
/* Returns the table of the values if the keys of a table are arbitrary names, otherwise NULL. */
const entry_field *keys_any(const entry_field *table);

/* Checks the whole tree for unknown, missing and misplaced keys and for values of the wrong form.
 * Returns 1 if there are no such errors. */
int keys_check(const document_node *root, mistakes *m);

/* Reads a list of numbers or a range: a..b (steps of 1), a..b step c, or a..b/n (n equal parts).
 * The last / precedes n, so a quotient as b must be in parentheses. Both ends are included, except
 * a b that is not a whole number of steps from a. Returns the number of values, or -1 after an
 * error. *out belongs to the arena. */
int range_values(const document_node *n, const scope *names, arena *a, mistakes *m, double **out);
/* Returns 1 if the node is a range. */
int range_is(const document_node *n);

struct scene_file {
    arena arena; /* holds the document and all strings */
    const char *path;
    const document_node *root;
    case_type type;
    parameter_type parameter[CASE_MAX_PARAMETERS + 1];
    int parameters;
};

/* Reads the parameter table. If there are no errors, the defaults are within their ranges. */
void parameter_table_read(scene_file *file, mistakes *m);
/* Returns the names of the parameters of a table, with these values. */
const scope *parameter_table_names(const parameter_type *, const double value[], arena *a);

/* Adds the constants of a section to the scope, with names such as SECTION.A. If c is NULL, the
 * section has an error, which has been reported. */
const scope *section_names_add(const scope *names, const char *section_name, const section *c,
                               arena *a);
/* Names of all constants, for messages. */
extern const char section_names_all[];

/* Replaces the loop names $i, or ${i} before letters, in strings by the values of the loops, which
 * are integers or words. Returns n if it contains no loop names, otherwise a copy, or NULL if out
 * of memory. A name without a value is reported and remains. */
const document_node *substitute_node(const document_node *n, const scope *names, arena *a,
                                     mistakes *m);
/* Returns the string with loop names replaced, for messages. Numbers have six digits. */
const char *substitute_for_message(const document_node *n, const scope *names, arena *a,
                                   mistakes *m);
/* Returns 1 if a loop name remains in the string, for which an error has been reported. */
int substitute_is_left(const char *text);

typedef struct writer {
    FILE *to;
    const scene *scene;
    int unwritable; /* 1 if a number is not finite */
    int begun;      /* 1 if the map already contains a key */
} writer;

typedef struct write_own {
    const char *key; /* "where" for a key in any map, "stress.where" for a key only in the map of
                        `stress`; NULL ends the list */
    void (*write)(writer *, const void *entry);
} write_own;

/* Writes a map with the keys of an entry that are required or always written, or whose values
 * differ from the defaults. `own` lists special forms, also for maps inside the entry, or is
 * NULL. */
void write_entry(writer *w, const entry_field *table, const void *entry, const write_own own[]);
void write_values_key(writer *w, const char *key);
/* Writes a list of words in brackets, one for each bit. */
void write_values_bits(writer *w, const char *words, unsigned bits);

/* Write the smallest number of digits, from six on, that reproduces the number; trailing zeros are
 * omitted. */
void write_values_number(writer *w, double value);
void write_values_numbers(writer *w, int count, const double value[]);
/* Writes the diagonal of a 6 x 6 matrix, or the whole matrix if other entries are not zero. */
void write_values_matrix(writer *w, const double A[36]);
int write_values_any(int count, const double value[]);
/* Writes the key and the number if the number differs from the default. */
void write_values_if(writer *w, const char *key, double value, double otherwise);
void write_values_quoted(writer *w, const char *text);
/* Writes the name of an entry. A name that is not unique or not allowed in a file is replaced by
 * one made from the index. */
void write_values_name(writer *w, scene_list list, int index);
void write_values_motion(writer *w, int index);
void write_values_named(writer *w, const char *before, scene_list list, int index);
extern const char *const write_values_component[6];

void write_sections(writer *w);
void write_structure(writer *w);
void write_analyses(writer *w);
void write_quantities(writer *w);

#endif
