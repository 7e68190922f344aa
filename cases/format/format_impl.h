/* The inside of format/. */
#ifndef BEAMWORK_CASES_FORMAT_FORMAT_IMPL_H
#define BEAMWORK_CASES_FORMAT_FORMAT_IMPL_H

#include <stdio.h>

#include "cases/case.h"
#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/section/section.h"

/* The names that expressions may use: parameters, derived values, loop names. */

/* The name added last; those before it stay visible. NULL: no name is known. */
typedef struct scope {
    const char *name;
    double number;           /* NAN: its expression has a mistake, which is reported */
    const char *word;        /* of a choice; NULL: a number */
    const char *choices;     /* "a|b|c" of a parameter; NULL: not known */
    const double *constants; /* of a section, whose name ends in a point; NULL: it is not one */
    const struct scope *before;
} scope;

/* The scope with one name more, a number or a word; the scope itself where memory ran out. */
const scope *scope_number(const scope *names, const char *name, double number, arena *a);
const scope *scope_word(const scope *names, const char *name, const char *word, arena *a);
/* A word of a parameter that has these. */
const scope *scope_choice(const scope *names, const char *name, const char *word,
                          const char *choices, arena *a);
/* Adds the constants of a section as names. */
const scope *scope_constants(const scope *names, const char *name, const double value[], arena *a);
/* The entry of a name of that length, or NULL. */
const scope *scope_find(const scope *names, const char *name, size_t length);
/* The known name, constant or function nearest to a misspelt one, or NULL. */
const char *scope_nearest(const scope *names, const char *name);
/* Can `key` be a new name: a letter, then letters, digits and _, not taken by another or by a
 * function? Else a mistake. */
int scope_accepts(const scope *names, const document_node *key, mistakes *m);

/* A checked tree and values of its parameters -> a scene. */

/* Ends of members that say nothing of their warping: as their supports say, or all free, as earlier
 * versions had them. */
typedef enum build_ends { BUILD_BY_SUPPORTS, BUILD_FREE } build_ends;

/* names: the parameters. The scene is valid where no mistake was found. The caller frees it in any
 * case. */
void build_scene(const document_node *root, const scope *names, build_ends ends, arena *a,
                 mistakes *m, scene *out);

/* Sections only, and their constants as names, into a builder with root and names. */
struct builder;
void build_sections(struct builder *b);

/* Loops and local names: the entries of a map or list with `for` and `let` written out. */

/* One entry as it was meant: $i in its name and texts is replaced, and its names are known. */
typedef struct unrolled {
    const char *name;           /* of an entry of a map; of a list NULL */
    const document_node *place; /* where messages point to: its key, or itself */
    const document_node *value;
    const document_node *written; /* the value as it is in the file */
    const scope *names;
    const struct placement *placed; /* of an instance of a part; NULL: of the scene itself */
} unrolled;

enum { UNROLL_MOST = 10000 };

/* Number of entries in the file's order; the first loop of an entry is the outermost. An error in a
 * loop is reported as a mistake, and its entry is omitted. */
int unroll_entries(const document_node *collection, const scope *names, arena *a, mistakes *m,
                   unrolled **out);
/* NAME: EXPR, in order, each known to those after it. */
const scope *unroll_let(const document_node *let, const scope *names, arena *a, mistakes *m);

/* Parts and their instances: sub-assemblies described once in axes of their own, and placed in the
 * scene. */

/* Position and orientation of an instance. */
typedef struct placement {
    const char *name;             /* of the instance: its entries are NAME.ENTRY */
    double origin[3];             /* [m] */
    int turned;                   /* 0: its axes are those of the scene */
    double R[9];                  /* columns: its axes in the scene, row-major */
    const document_node *connect; /* PORT: NODE; NULL: none */
} placement;

enum { PLACEMENT_LISTS = 4 };
/* Lists of a part: "nodes", "members", "springs", "loads". */
extern const char *const placement_list[PLACEMENT_LISTS];

/* Adds the entries of all instances of the scene after list[k] of count[k], in the order of
 * placement_list. */
void placement_unroll(const document_node *root, const scope *names, arena *a, mistakes *m,
                      unrolled *list[], int count[]);

/* v <- R v; p <- origin + R p. NULL: nothing changes. */
void placement_turn(const placement *, double v[3]);
void placement_move(const placement *, double p[3]);
/* The scene's node that a port of the instance is connected to, or NULL: it is no port. */
const document_node *placement_port(const placement *, const char *name);

/* Units: SI throughout; what else is written is refused with the way to write it. */

/* A mistake where the text is none of the units that values have here. */
void units_check(const document_node *unit, mistakes *m);

/* Units of a scene: of length and force; those of stress and of mass (force s^2/length) follow. */
typedef struct unit_system {
    int given;            /* 0: SI */
    double length, force; /* [m], [N]: of one of them */
    const char *name_of_length, *name_of_force;
    char name_of_stress[16];
} unit_system;

/* Reads "mm, N, MPa" or [mm, N, MPa]; n NULL: SI. A mistake: units that are not consistent with
 * each other. */
void units_read(const document_node *n, mistakes *m, unit_system *out);
/* A unit of SI in those of the system: "N m" becomes "N mm"; seconds and angles stay. */
void units_translate(const unit_system *, const char *unit, size_t size, char out[]);

/* Builds a scene from a checked tree, and reads values of its maps by their keys.
 *
 * The tree has been checked by its keys: a requested value is a number, a word, or a
 * list where one is required. A value without meaning is a mistake, and some value is returned. */

typedef struct builder {
    arena *arena;
    mistakes *mistakes;
    scene *scene;
    const document_node *root;
    const scope *names; /* parameters and derived values */
    unit_system units;  /* of the numbers in the file */
    struct {
        unrolled *entry;
        int count;
        int incomplete;  /* 1: entries were omitted after mistakes */
    } list[SCENE_LISTS]; /* in the order of the scene's indices */
    const char **shared; /* names of warping coordinates that members share */
    int shares;
    int unsaid_warping; /* of ends of which nothing is said */
} builder;

/* One map: of an entry, or below one. */
typedef struct fields {
    builder *b;
    const scope *names;
    const document_node *map; /* NULL: it is not there, and has nothing */
    const document_node *place;
    const placement *placed; /* NULL: in the axes of the scene */
} fields;

fields fields_of(builder *b, const unrolled *entry);
fields fields_below(const fields *f, const char *key);
int fields_have(const fields *f, const char *key);
/* All values of the table that are in the struct of the entry; those of a map that is not there
 * stay as they are. */
void fields_read(const fields *f, const entry_field *table, void *entry);
double fields_number(const fields *f, const char *key, double otherwise);
int fields_whole(const fields *f, const char *key, int otherwise, int least, int most);
/* out[count] is left as it is, and 0 returned, where there is none. */
int fields_vector(const fields *f, const char *key, int count, double out[]);
/* A list or range: how many; 0 where there is none; *out is the arena's. */
int fields_values(const fields *f, const char *key, double **out);
const char *fields_text(const fields *f, const char *key, const char *otherwise);
/* Index in "a|b|c" of a word, or of the word that a parameter of that name has. */
int fields_word(const fields *f, const char *key, const char *choices, int otherwise);
int fields_word_of(const fields *f, const document_node *word, const char *what,
                   const char *choices, int otherwise);
/* Bits of one word or of a list of them. */
unsigned fields_words(const fields *f, const char *key, const char *choices);
/* Index of the entry that is named; SCENE_NONE where there is none. */
int fields_entry(const fields *f, const char *key, scene_list list);
int fields_entry_of(const fields *f, const document_node *name, scene_list list);
/* 1: there is an entry of that name. Reports nothing. */
int fields_names(const fields *f, const char *key, scene_list list);
/* "ux|uy|uz|rx|ry|rz" */
extern const char fields_components[];

/* Gives an entry of the scene the name that entry i of a list has. */
void builder_call(builder *b, scene_list list, int index, int i);

void builder_sections(builder *b);
void builder_nodes(builder *b);
void builder_members(builder *b);
void builder_springs(builder *b);
void builder_motions(builder *b);
void builder_loads(builder *b);
void builder_analyses(builder *b);
void builder_quantities(builder *b);
/* Settings of a transient analysis that the table does not cover. */
void builder_in_time(const fields *f, scene_motion *how);
/* Adds a piece to the function of time of an entry of the scene. */
typedef void builder_piece(scene *, int index, double until, const char *text);
/* Adds the function that `time`, `pieces` or `table` gives; values of a table are joined by lines,
 * or by a cubic spline that begins and ends at rest. */
void builder_function(const fields *f, int index, builder_piece *add, int spline);
/* Is there one? */
int builder_has_function(const fields *f);
/* Reports that the analysis of a quantity does not have it, and which kinds of analysis do. */
void builder_no_quantity(const fields *what, const char *key, const scene_quantity *q);
/* `path` and as many `values` as it has stations: their number; 0 after a mistake or where there
 * are none. */
int builder_stations(const fields *f, const char *values, double **path, double **value);
/* Analyses and quantities where the file has none. */
void builder_defaults(builder *b);

/* Sections by their sizes: I, channel, Z, angle, box. */

/* 1, and points and walls, where the section is one of them. */
int build_shapes_read(const fields *f, section_spec *spec);

/* Entries and values that depend on the values of names. */

/* {NAME: VALUE, NAME: [VALUE, ...], ...}: has each name one of its values? 0 after a mistake. NULL:
 * 1. */
int choose_holds(const document_node *conditions, const scope *names, mistakes *m);
/* {NAME: {VALUE: ..., else: ...}}: what is after the value that the name has; anything else is
 * itself. NULL after a mistake. */
const document_node *choose_value(const document_node *n, const scope *names, mistakes *m);

/* Numbers as expressions (cases/scene/expression.c); mistakes are reported with the position of
 * their character. */

/* An expression_name of what a scope has; context: a name_context. */
typedef struct name_context {
    const scope *names;
    int in_time; /* 1: of a function of time */
} name_context;
int names_number(const void *context, const char *text, int *at, double *out, expression_mistake *);

/* 1 and the value, or 0 after a mistake. */
int expression_number(const document_node *n, const scope *names, mistakes *m, double *out);
/* The same of `length` bytes of the text from `from`. */
int expression_part(const document_node *n, int from, int length, const scope *names, mistakes *m,
                    double *out);
/* Exactly `count` numbers of a list. */
int expression_vector(const document_node *n, int count, const scope *names, mistakes *m,
                      double out[]);

/* Tables of the keys of scene files. They check and describe a file, and suggest the key that was
 * meant. */

extern const entry_field keys_let[], keys_refusal[], keys_root[], keys_truth[], keys_parameter[],
    keys_part[], keys_instance[];

/* `for`, `let` and `if`, which every entry may have. */
extern const entry_field keys_loop[];
/* May its entries have them? */
int keys_loops(const entry_field *table);

/* Unknown, missing, misplaced keys and values of the wrong form, in the whole tree. 1: none. */
int keys_check(const document_node *root, mistakes *m);

/* Parts of the words of a quantity, for the files that put them together. */

/* Writes which states of which analysis: ", at the end of the static path". */
void meaning_state(FILE *to, const scene *s, const scene_quantity *q);

/* A scene file as the build writes it into the program (harness/tools/pack_case.c): read and
 * checked there, without a pointer in it, and a case like any other here. */

typedef struct document_packed {
    int kind, line, column, inset; /* as document_node has them */
    /* Text: where it begins in all texts. List: its first entry, which the others follow. Map: its
     * first key, which the other keys follow, and then its entries. */
    int first;
    int count;
} document_packed;

typedef struct scene_packed {
    const char *file, *texts;
    const parameter_type *parameters; /* of the file */
    const document_packed *node;      /* the first one is the root */
    int nodes;
} scene_packed;

/* The build_from of such a case; context: a scene_packed. */
status scene_packed_build(const void *context, const double value[], scene *s, fault *f);

/* Lists of numbers, written out or as a range. */

/* A list of numbers, or a range: a..b (steps of 1), a..b step c, a..b/n (n equal parts; the last /
 * after .. always divides so, else put b in parentheses). Both ends are values. The count, or -1
 * after a mistake; *out is the arena's. */
int range_values(const document_node *n, const scope *names, arena *a, mistakes *m, double **out);
/* Is the text a range? */
int range_is(const document_node *n);

/* Parts of a scene file, for the files that read it. */

struct scene_file {
    arena arena; /* of the document and of all texts */
    const char *path;
    const document_node *root;
    case_type type;
    parameter_type parameter[CASE_MAX_PARAMETERS + 1];
    int parameters;
};

/* The table of parameters; defaults are in their ranges where there is no mistake. */
void parameter_table_read(scene_file *file, mistakes *m);
/* The names of the parameters of a table with these values. */
const scope *parameter_table_names(const parameter_type *, const double value[], arena *a);
/* Mistakes of the reference values, whose quantities are those of the scene, at a point. */
void scene_file_truths_check(const scene_file *file, const scene *s, const double value[],
                             mistakes *m);

/* Constants of sections as names of expressions: SECTION.A. */

/* The scope with the constants of one more section; c NULL: the section has a mistake, which is
 * reported. */
const scope *section_names_add(const scope *names, const char *section_name, const section *c,
                               arena *a);
/* Index of a constant's name among those of every section, or -1. */
int section_names_index(const char *name, size_t length);
/* All of them, for messages. */
extern const char section_names_all[];

/* Names of loops in texts: $i, or ${i} before letters, is replaced by the loop's whole number or
 * word. */

/* The tree with all names replaced: itself where there are none, else a copy; NULL when memory ran
 * out. What cannot be replaced is a mistake and stays. */
const document_node *substitute_node(const document_node *n, const scope *names, arena *a,
                                     mistakes *m);
/* A text for people: numbers of any kind, with six digits. */
const char *substitute_said(const document_node *n, const scope *names, arena *a, mistakes *m);
/* 1: a loop name remains in this text: it could not be replaced, which was reported. */
int substitute_is_left(const char *text);

/* Parts of a scene file, for the files that write it. */

typedef struct writer {
    FILE *to;
    const scene *scene;
    int unwritable; /* 1: a number that is not one */
    int begun;      /* 1: a key is in the map already */
} writer;

/* Functions that write an entry in a form of their own: its key, and all after it. */
typedef struct write_own {
    const char *key; /* NULL ends a list */
    void (*write)(writer *, const void *entry);
} write_own;

/* A map with the keys of an entry whose values are not the default. own: also for the maps below
 * it; NULL: none. */
void write_entry(writer *w, const entry_field *table, const void *entry, const write_own own[]);
/* "key: ", after ", " where it is not the first of its map. */
void write_values_key(writer *w, const char *key);
/* The word of that index in "a|b|c". */
void write_values_word(writer *w, const char *words, int index);
/* A list of words between [ and ]: a bit for each. */
void write_values_bits(writer *w, const char *words, unsigned bits);

/* Six digits, or as many more as give the same number. */
void write_values_number(writer *w, double value);
/* [a, b, c] */
void write_values_numbers(writer *w, int count, const double value[]);
/* The diagonal of a 6 x 6 matrix, or all of it where the rest is not zero. */
void write_values_matrix(writer *w, const double A[36]);
/* Is one of them not zero? */
int write_values_any(int count, const double value[]);
/* Key and number where it differs from what a reader takes when it is not there. */
void write_values_if(writer *w, const char *key, double value, double otherwise);
/* In double quotes. */
void write_values_quoted(writer *w, const char *text);
/* Name of an entry in the file: as in the scene where it is unique and a file can express it, else
 * its number. */
void write_values_name(writer *w, scene_list list, int index);
void write_values_motion(writer *w, int index);
/* `before` and the name of an entry. */
void write_values_named(writer *w, const char *before, scene_list list, int index);
/* "ux" .. "rz" */
extern const char *const write_values_component[6];

void write_sections(writer *w);
void write_structure(writer *w);
void write_analyses(writer *w);
void write_quantities(writer *w);

#endif
