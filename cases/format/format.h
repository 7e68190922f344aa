/* Reading and writing of scene files. */
#ifndef BEAMWORK_CASES_FORMAT_FORMAT_H
#define BEAMWORK_CASES_FORMAT_FORMAT_H

#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/scene/scene.h"
#include "elements/shared/status.h"

/* Memory that is released as a whole and holds all data of a scene file. */

typedef struct arena {
    struct arena_block *block;
    size_t used, total; /* bytes used in the first block, and bytes in all blocks */
    int failed;         /* 1 after an error: out of memory, or above the limit for a file */
} arena;

/* Makes room for another entry in a list of `count` entries. Returns the list, a copy with twice
 * the room, or NULL if out of memory. */
void *arena_grow(arena *a, void *list, int count, size_t size);
void arena_free(arena *a);

/* Errors in a scene file with their positions, which are reported together. */

enum { MISTAKES_MOST = 20 };

typedef struct mistake {
    int line, column; /* starting at 1 */
    char text[FAULT_TEXT];
} mistake;

typedef struct mistakes {
    const char *file; /* name used in messages */
    int count;
    int more;                    /* number of errors that did not fit */
    int out_of_memory;           /* 1 if memory ran out before the end of the file was read */
    mistake list[MISTAKES_MOST]; /* ordered by position */
} mistakes;

/* Adds an error, unless the list already contains an error at the same position. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void mistakes_add(mistakes *m, int line, int column, const char *format, ...);

/* Returns "; did you mean 'near'?", or the remedy if near is NULL. */
const char *mistakes_remedy(const char *near, const char *remedy, char text[FAULT_TEXT]);

/* Returns OK if there are no errors. Otherwise returns REFUSED, or FAULT if out of memory, and
 * writes the first error to f. */
status mistakes_status(const mistakes *m, fault *f);

/* Prints "file:line:column: what" in one line for each error, then the number of further errors. */
void mistakes_print(const mistakes *m, FILE *to);
/* Writes {"file": ..., "mistakes": [{"line", "column", "text"}, ...], "more": n} for editors.
 * Returns FAULT if out of memory. */
status mistakes_json(const mistakes *m, FILE *to, fault *f);

/* A YAML document as a tree of maps, lists and strings, each with its position in the file.
 *
 * Every scalar is a string until a number or a word is read from it; there are no implicit types.
 * Anchors, aliases, tags, merge keys, several documents, duplicate keys, and documents that are too
 * deep or too large are rejected. */

enum { DOCUMENT_BYTES = 1 << 20, DOCUMENT_DEPTH = 16, DOCUMENT_ENTRIES = 10000 };

typedef enum document_kind { DOCUMENT_TEXT, DOCUMENT_LIST, DOCUMENT_MAP } document_kind;

typedef struct document_node {
    document_kind kind;
    int line, column; /* position of the first character, starting at 1 */
    /* For a string that appears unchanged in the file, the number of columns from `column` to its
     * first character (1 after a quote). -1: the characters of the string do not correspond to
     * columns of the file (several lines, escapes, an inserted name). */
    int inset;
    const char *text;            /* without control characters */
    int count;                   /* number of entries of a list or map */
    struct document_node **item; /* values [count] */
    struct document_node **key;  /* keys [count], or NULL for a list */
} document_node;

/* Reads the bytes into a tree, which the arena owns. Returns NULL after an error. */
document_node *document_read(const char *bytes, size_t size, arena *a, mistakes *m);
/* Returns the value of a key, or NULL if the key is missing or `map` is not a map. */
const document_node *document_find(const document_node *map, const char *key);
/* Adds an error at character `offset` of the string, or at the start of the node if characters have
 * no positions. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void document_mistake(mistakes *m, const document_node *n, int offset, const char *format, ...);

/* Text of two paragraphs that precedes the list of keys. */
extern const char *const key_list_head[2];

/* Receives a key: its depth below the root (0), its form ("NAME: {...}") and its description. */
typedef void key_list_take(void *context, int depth, const char *name, const char *form,
                           const char *text);
/* Pass either the keys that every entry may have (loops) or all other keys. Each key follows its
 * parent. Keys that are not implemented are omitted. */
void key_list_loops(key_list_take *take, void *context);
void key_list_all(key_list_take *take, void *context);

/* Writes a text after `at` columns of a line, indents continuation lines, and ends the line. */
typedef void key_list_print(FILE *to, int at, int indent, const char *text);
/* Writes the name, form, unit, summary and words of each key. */
void key_list_write(FILE *to, key_list_print *print);

/* Opens a text file and skips a byte order mark at its start. Returns NULL and sets errno after a
 * failure. */
FILE *line_open(const char *path);
/* Skips the byte order mark of an open stream. */
void line_skip_mark(FILE *from);
/* Removes blanks at both ends of the line in place. */
char *line_trim(char *line);
/* Returns 1 if the line is UTF-8 without control characters. */
int line_is_text(const char *line);
/* Splits a line at commas in place, and trims the fields. A field may be in quotes, within which ""
 * stands for one quote. Returns the number of fields, or more than `most` if there are too many. */
int line_split(char *line, char *field[], int most);
/* Splits a line into words separated by blanks, in place. Returns the number of words, or more than
 * `most` if there are too many. */
int line_words(char *line, char *word[], int most);
/* Reads a finite number that fills the text, whose exponent may be written with D. Returns 1, or 0
 * if the text is not such a number. */
int line_number(const char *text, double *value);

/* Description of a quantity of a scene, made from the data of the scene. */

enum { MEANING_ROOM = 512 };

/* Writes one line without a full stop. The line contains the kind, the component, the node or
 * member with its position, and the station. The line also contains the analysis if the quantity
 * would otherwise be ambiguous. Quantities that differ in these data have different lines. Nodes
 * and members have the names that write_scene writes. Text that does not fit is truncated. */
void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size);

/* A scene file as a case: parameters, a function that builds the scene, and reference values. */

typedef struct scene_file scene_file;

/* Reference value that a file gives for a quantity at a parameter point. */
typedef struct scene_truth {
    const double *parameter;       /* values of the parameters [CASE_MAX_PARAMETERS] */
    double value, uncertainty, at; /* `at` is the abscissa on a curve, NAN for a scalar */
    const char *quantity, *unit, *kind, *formulation, *theory, *model, *convention, *source;
} scene_truth;
/* Receives a reference value, whose strings and numbers are valid only during the call. */
typedef status scene_truth_taker(void *to, const scene_truth *, fault *);

/* Reads the file and builds the scene once at the defaults, which checks them. After a failure *out
 * is NULL. Returns REFUSED with all errors in m and the first error in f, or FAULT if the file
 * cannot be read. `path` must outlive m and the file. */
status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f);
/* Reads the file but checks only the form and the parameters, for use with values other than the
 * defaults. scene_file_check checks the scene at such values. */
status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f);
/* Checks the scene at these parameter values. Returns REFUSED with all errors in m and the first
 * error in f. */
status scene_file_check(const scene_file *, const double value[], mistakes *m, fault *f);
/* Reads a scene file from memory, as scene_file_read does from a file. `path` is used in messages.
 */
status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f);
void scene_file_free(scene_file *);

/* Returns the case, which is valid as long as the file. */
const case_type *scene_file_case(const scene_file *);
/* Returns the path of the file from which a case was made, or NULL if the case is built-in. */
const char *scene_file_path(const case_type *type);
const struct document_node *scene_file_document(const scene_file *);
/* Returns 1 if the root of the file contains this key. */
int scene_file_states(const scene_file *, const char *key);
/* Passes the reference values that apply at a parameter point to `taker`, evaluated at that
 * point. */
status scene_file_truths(const scene_file *, const double value[], scene_truth_taker *, void *to,
                         fault *f);
/* Passes the reference values at the defaults and at every parameter point that a reference value
 * names. A value may be passed more than once. */
status scene_file_truths_all(const scene_file *, scene_truth_taker *, void *to, fault *f);

/* Writes the keys of scene files as a JSON Schema, for completion and checks in editors. */

status schema_file_write(FILE *to, fault *f);

/* Head of a scene that is written as a scene file. Reading this file gives the same scene, bit for
 * bit. */

typedef struct write_head {
    const char *name, *summary, *source;
} write_head;

/* Writes the scene with loops and expressions expanded. Numbers have as many digits as are needed
 * to reproduce them. Returns REFUSED if the scene contains data that a file cannot express. */
status write_scene(FILE *to, const scene *s, const write_head *head, fault *f);
/* Returns the text that write_scene writes, which the caller frees. Returns "" if s is NULL or a
 * file cannot express the scene, and NULL if out of memory. */
char *write_scene_text(const scene *s, const write_head *head);

#endif
