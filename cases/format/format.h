#ifndef BEAMWORK_CASES_FORMAT_FORMAT_H
#define BEAMWORK_CASES_FORMAT_FORMAT_H

#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/scene/scene.h"
#include "elements/shared/status.h"

/* Memory for all data of a scene file, which is released as a whole. */

typedef struct arena {
    struct arena_block *block;
    size_t used, total; /* bytes used in the first block, and bytes in all blocks */
    int failed;         /* 1 if out of memory, or if the file needs more memory than allowed */
} arena;

/* Makes room for another entry in a list of `count` entries. Returns the list, a copy with twice
 * the room, or NULL if out of memory. */
void *arena_grow(arena *a, void *list, int count, size_t size);
void arena_free(arena *a);

enum { MISTAKES_MOST = 20 };

typedef struct mistake {
    int line, column; /* starting at 1 */
    char text[FAULT_TEXT];
} mistake;

typedef struct mistakes {
    const char *file; /* name used in messages */
    int count;
    int more;                    /* number of further errors, which are not in the list */
    int out_of_memory;           /* 1 if out of memory before the whole file was read */
    mistake list[MISTAKES_MOST]; /* ordered by position */
} mistakes;

/* Adds an error, unless the list already contains an error at the same position. If the list is
 * full, the last of the errors in the file is only counted. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void mistakes_add(mistakes *m, int line, int column, const char *format, ...);

/* Writes "; did you mean 'near'?" to `text`, or the remedy if near is NULL. Returns `text`. */
const char *mistakes_remedy(const char *near, const char *remedy, char text[FAULT_TEXT]);

/* Returns OK if there are no errors. Otherwise returns REFUSED, or FAULT if out of memory, and
 * writes the first error to f. */
status mistakes_status(const mistakes *m, fault *f);

/* Prints one line "file:line:column: what" for each error, then the number of further errors. */
void mistakes_print(const mistakes *m, FILE *to);
/* Writes {"file": ..., "mistakes": [{"line", "column", "text"}, ...], "more": n} for editors.
 * Returns FAULT if out of memory. */
status mistakes_json(const mistakes *m, FILE *to, fault *f);

/* A YAML document as a tree of maps, lists and strings, each with its position in the file.
 *
 * Scalars are strings: types are not inferred. Anchors, aliases, tags, merge keys, several
 * documents, duplicate keys, and documents beyond the limits below are rejected. */

enum { DOCUMENT_BYTES = 1 << 20, DOCUMENT_DEPTH = 16, DOCUMENT_ENTRIES = 10000 };

typedef enum document_kind { DOCUMENT_TEXT, DOCUMENT_LIST, DOCUMENT_MAP } document_kind;

typedef struct document_node {
    document_kind kind;
    int line, column; /* position of the first character, starting at 1 */
    /* Number of columns from `column` to the first character of a string: 0, or 1 after a quote. -1
     * if the characters do not correspond to columns, for example in a string with escapes or
     * inserted names. */
    int inset;
    const char *text;            /* text without control characters */
    int count;                   /* number of entries of a list or map */
    struct document_node **item; /* values [count] */
    struct document_node **key;  /* keys [count], or NULL for a list */
} document_node;

/* Reads the bytes into a tree, which the arena owns. Returns NULL after an error. */
document_node *document_read(const char *bytes, size_t size, arena *a, mistakes *m);
/* Returns the value of a key, or NULL if the key is missing or `map` is not a map. */
const document_node *document_find(const document_node *map, const char *key);
/* Adds an error at character `offset` of the string, or at the start of the node if inset is -1. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void document_mistake(mistakes *m, const document_node *n, int offset, const char *format, ...);

/* A scene file that the build stores in the program (harness/tools/pack_case.c). Its nodes contain
 * no pointers. */

typedef struct document_packed {
    int kind, line, column, inset; /* values of document_node */
    /* String: its position among all strings. List: its first entry, followed by the others. Map:
     * its first key, followed by the other keys and then by the values. */
    int first;
    int count;
} document_packed;

typedef struct scene_packed {
    const char *file, *texts;
    const parameter_type *parameters; /* parameters of the file */
    const document_packed *node;      /* the first one is the root */
    int nodes;
} scene_packed;

/* Builds the scene of a stored file (case_type.build_from). `context` is a scene_packed. */
status scene_packed_build(const void *context, const double value[], scene *s, fault *f);

/* Two paragraphs that precede the list of keys. */
extern const char *const key_list_head[2];

/* Receives a key: its depth (0 for keys of the root), its form such as "NAME: {...}" and its
 * description. */
typedef void key_list_take(void *context, int depth, const char *name, const char *form,
                           const char *text);
/* key_list_loops passes the keys that every entry may have, and key_list_all all other keys. Each
 * key follows its parent. Keys that are not implemented are omitted. */
void key_list_loops(key_list_take *take, void *context);
void key_list_all(key_list_take *take, void *context);

/* Writes a text from column `at`. Continuation lines are indented by `indent`. */
typedef void key_list_print(FILE *to, int at, int indent, const char *text);
/* Writes the list of all keys with their descriptions. */
void key_list_write(FILE *to, key_list_print *print);

/* Opens a text file and skips its byte order mark. Returns NULL and sets errno after a failure. */
FILE *line_open(const char *path);
/* Skips the byte order mark of an open stream. */
void line_skip_mark(FILE *from);
/* Removes blanks at both ends of the line in place. */
char *line_trim(char *line);
/* Trims a line of `length` bytes in place. Returns NULL if the line is not UTF-8, or contains
 * control characters other than tabs. */
char *line_text(char *line, size_t length);
/* Error of such a line. A reader then stops, because each line of a binary file would be an
 * error. */
#define LINE_NOT_TEXT "the line is not UTF-8 text; give a CSV file, saved as UTF-8 text"
/* Splits a line at commas in place, and trims the fields. A field may be in quotes, within which ""
 * stands for one quote. Returns the number of fields, or a larger number than `most` if there are
 * too many. */
int line_split(char *line, char *field[], int most);
/* Splits a line into words separated by blanks or commas, in place. Returns the number of words, or
 * a larger number than `most` if there are too many. */
int line_words(char *line, char *word[], int most);
/* Returns 1 and sets *value if the whole text is a finite number, whose exponent may start with D.
 * Otherwise returns 0. */
int line_number(const char *text, double *value);

/* Sufficient room for the description of a quantity. */

enum { MEANING_ROOM = 512 };

/* Describes a quantity in one line without a full stop. The line contains the kind, the component,
 * the node or member with its position, and the station. Nodes and members have the names that
 * write_scene writes. */
void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size);

/* A scene file, which is a case: its parameters, its scene and its reference values. */

typedef struct scene_file scene_file;

/* Reference value in a scene file for a quantity at a parameter point. */
typedef struct scene_truth {
    const double *parameter;       /* values of the parameters [CASE_MAX_PARAMETERS] */
    double value, uncertainty, at; /* `at` is the abscissa on a curve, NAN for a scalar */
    const char *quantity, *unit, *kind, *formulation, *theory, *model, *convention, *source;
} scene_truth;
/* Receives a reference value, whose strings and numbers are valid only during the call. */
typedef status scene_truth_taker(void *to, const scene_truth *, fault *);

/* Reads the file and checks the scene at the default parameters. After a failure *out is NULL.
 * Returns REFUSED with all errors in m and the first error in f, or FAULT if the file cannot be
 * read. `path` must outlive m and the file. */
status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f);
/* Reads the file but checks only its form and its parameters. scene_file_check then checks the
 * scene at other values than the defaults. */
status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f);
/* Checks the scene at these parameter values. Returns REFUSED with all errors in m and the first
 * error in f. */
status scene_file_check(const scene_file *, const double value[], mistakes *m, fault *f);
/* Reads a scene file from memory, as scene_file_read does from a file. `path` is used in messages.
 */
status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f);
void scene_file_free(scene_file *);

/* Returns the case, which is valid until the file is freed. */
const case_type *scene_file_case(const scene_file *);
/* Returns the path of the file from which a case was made, or NULL if the case is built-in. */
const char *scene_file_path(const case_type *type);
const struct document_node *scene_file_document(const scene_file *);
/* Returns 1 if the root of the file contains this key. */
int scene_file_states(const scene_file *, const char *key);
/* Passes the reference values of a parameter point, evaluated at this point. */
status scene_file_truths(const scene_file *, const double value[], scene_truth_taker *, void *to,
                         fault *f);
/* Passes the reference values at the defaults and at all parameter points for which the file has
 * reference values. */
status scene_file_truths_all(const scene_file *, scene_truth_taker *, void *to, fault *f);

/* Writes the keys of scene files as a JSON Schema, for completion and checks in editors. */

status schema_file_write(FILE *to, fault *f);

typedef struct write_head {
    const char *name, *summary, *source;
} write_head;

/* Writes a scene file that gives the same scene, bit for bit. Loops and expressions are replaced by
 * their values. Returns REFUSED if the scene contains data that a file cannot express. */
status write_scene(FILE *to, const scene *s, const write_head *head, fault *f);
status write_scene_refused(const char *name, fault *f);
/* Returns the text that write_scene writes, which the caller frees. Returns "" if s is NULL or a
 * file cannot express the scene, and NULL if out of memory. */
char *write_scene_text(const scene *s, const write_head *head);

#endif
