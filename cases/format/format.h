/* format/: scene files read and written. */
#ifndef BEAMWORK_CASES_FORMAT_FORMAT_H
#define BEAMWORK_CASES_FORMAT_FORMAT_H

#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/scene/scene.h"
#include "elements/shared/status.h"

/* Memory that is given back all at once: what a scene file is made of. */

typedef struct arena {
    struct arena_block *block;
    size_t used, total; /* bytes: of the first block; of all */
    int failed;         /* 1: memory, or the share of it that a file may take, ran out */
} arena;

/* Zeroed and aligned for every type; NULL when memory ran out, which `failed` keeps. {0} is an
 * empty arena. */
void *arena_take(arena *a, size_t size);
/* The first `length` bytes of a text, and a zero. */
const char *arena_copy(arena *a, const char *text, size_t length);
/* Room for one more entry in a list of `count`: the list, or a copy of it with twice the room; NULL
 * when memory ran out. */
void *arena_grow(arena *a, void *list, int count, size_t size);
void arena_free(arena *a);

/* Mistakes in a scene file: each with its position, all reported at once. */

enum { MISTAKES_MOST = 20 };

typedef struct mistake {
    int line, column; /* counted from 1 */
    char text[FAULT_TEXT];
} mistake;

typedef struct mistakes {
    const char *file; /* as messages call it */
    int count;
    int more;                    /* that found no room */
    int out_of_memory;           /* 1: the file was not read to its end for lack of it */
    mistake list[MISTAKES_MOST]; /* ascending by place */
} mistakes;

/* Adds one, unless there is one at that place. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void mistakes_add(mistakes *m, int line, int column, const char *format, ...);

/* "; did you mean 'near'?", or the remedy where near is NULL. */
const char *mistakes_remedy(const char *near, const char *remedy, char text[FAULT_TEXT]);

/* OK where there are none; else REFUSED, or FAULT out of memory, and the first of them in f. */
status mistakes_status(const mistakes *m, fault *f);

/* "file:line:column: what", a line each; after them how many more there are. */
void mistakes_print(const mistakes *m, FILE *to);
/* {"file": ..., "mistakes": [{"line", "column", "text"}, ...], "more": n}, for editors; FAULT out
 * of memory. */
status mistakes_json(const mistakes *m, FILE *to, fault *f);

/* A YAML document as a tree of maps, lists and texts, each with its position in the file.
 *
 * Every scalar is text until a number or a word is requested: there are no implicit types. Anchors,
 * aliases, tags, merge keys, several documents, duplicate keys, and documents that are too deep or
 * too large are refused. */

enum { DOCUMENT_BYTES = 1 << 20, DOCUMENT_DEPTH = 16, DOCUMENT_ENTRIES = 10000 };

typedef enum document_kind { DOCUMENT_TEXT, DOCUMENT_LIST, DOCUMENT_MAP } document_kind;

typedef struct document_node {
    document_kind kind;
    int line, column; /* of its first character, counted from 1 */
    /* A text that is in the file as it is: how many columns after `column` it begins (a
     * quote); -1: its characters have no place of their own (several lines, escapes, a name that
     * was put in). */
    int inset;
    const char *text;            /* of a text: without control characters */
    int count;                   /* entries of a list or map */
    struct document_node **item; /* [count] */
    struct document_node **key;  /* [count] texts; of a list NULL */
} document_node;

/* The tree of the bytes, owned by the arena; NULL after a mistake. */
document_node *document_read(const char *bytes, size_t size, arena *a, mistakes *m);
/* The entry of a map, or NULL; also of what is no map. */
const document_node *document_find(const document_node *map, const char *key);
/* Adds a mistake at the character `offset` of the text, or where the node begins. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void document_mistake(mistakes *m, const document_node *n, int offset, const char *format, ...);

/* The keys of scene files as a list to read. */

/* Text before the list: two paragraphs. */
extern const char *const key_list_head[2];

/* A key at its depth below the root (0), its form ("NAME: {...}") and what it is. */
typedef void key_list_take(void *context, int depth, const char *name, const char *form,
                           const char *text);
/* Keys that every entry may have (loops), and all other keys, each after the key that it belongs
 * to. Keys that are not carried yet are omitted. */
void key_list_loops(key_list_take *take, void *context);
void key_list_all(key_list_take *take, void *context);

/* Writes a text after `at` columns of a line, further lines indented, and the end of the line. */
typedef void key_list_say(FILE *to, int at, int indent, const char *text);
/* Name, form, unit, summary and words of each key. */
void key_list_write(FILE *to, key_list_say *say);

/* Lines of other programs' files as text, fields, numbers. Every line is checked. */

/* Opens a file to read text; a byte order mark at its beginning, as some editors put it, is no text
 * and skipped. NULL and errno. */
FILE *line_open(const char *path);
/* The same of a stream that was opened. */
void line_skip_mark(FILE *from);
/* Without blanks at both ends, within the line, which is cut. */
char *line_trim(char *line);
/* UTF-8 without control characters? */
int line_is_text(const char *line);
/* Fields between commas, trimmed, which may stand in quotes ("" inside them is one quote); their
 * number, more than `most` where there are too many. The line is cut. */
int line_split(char *line, char *field[], int most);
/* Words between blanks; the same. */
int line_words(char *line, char *word[], int most);
/* A finite number and nothing else; an exponent may be marked D. */
int line_number(const char *text, double *value);

/* Description of a quantity of a scene, in words made from the scene's own data. */

enum { MEANING_ROOM = 512 };

/* One line without a full stop: kind, component, node or member with its place, station, and
 * the analysis where another one would have the same line. Quantities of a scene that differ in
 * any of these have different lines. Nodes and members are
 * named as write_scene names them. The text is cut where it does not fit. */
void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size);

/* A scene file as a case like any other: parameters, a function that builds the scene, truths. */

typedef struct scene_file scene_file;

/* Reference value that a file gives for a quantity at a point of its parameters. */
typedef struct scene_truth {
    const double *parameter;       /* [CASE_MAX_PARAMETERS] */
    double value, uncertainty, at; /* at: an abscissa of a curve; NAN: it is a number */
    const char *quantity, *unit, *kind, *formulation, *theory, *model, *convention, *source;
} scene_truth;
/* Takes one, whose texts and numbers last as long as the call. */
typedef status scene_truth_taker(void *to, const scene_truth *, fault *);

/* The file, with its defaults built once to see that they are a scene. Not OK: *out is NULL;
 * REFUSED with all mistakes in m (and the first in f), FAULT when it cannot be read. path must
 * outlive m and the file. */
status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f);
/* Its form and parameters alone, where values other than the defaults are requested; what it is
 * at these says scene_file_check. */
status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f);
/* Is it a scene at these values of its parameters? REFUSED with all mistakes in m, the first in f.
 */
status scene_file_check(const scene_file *, const double value[], mistakes *m, fault *f);
/* The same as scene_file_read of bytes, which the fuzzer gives; path: as messages call it. */
status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f);
void scene_file_free(scene_file *);

/* Lives as long as the file. */
const case_type *scene_file_case(const scene_file *);
/* The path of the file that a case is made from; NULL: of none. */
const char *scene_file_path(const case_type *type);
const struct document_node *scene_file_document(const scene_file *);
/* Does the file say anything under this key? */
int scene_file_states(const scene_file *, const char *key);
/* The scene as earlier versions read it: ends that say nothing of their warping leave it free.
 * The caller frees it in any case. */
status scene_file_build_before(const scene_file *, const double value[], scene *, fault *);
/* Gives the reference values that hold at a point of the parameters, with their values there. */
status scene_file_truths(const scene_file *, const double value[], scene_truth_taker *, void *to,
                         fault *f);
/* The same at the defaults and at every point that a reference value names: some come several
 * times. */
status scene_file_truths_all(const scene_file *, scene_truth_taker *, void *to, fault *f);

/* The keys of scene files as a JSON Schema: editors complete and check with it. */

status schema_file_write(FILE *to, fault *f);

/* A scene -> a scene file that reads back as the same scene, bit for bit. */

typedef struct write_head {
    const char *name, *summary, *source;
} write_head;

/* Loops and expressions are written out, numbers with as many digits as they need. REFUSED: the
 * scene has something that no file can say. */
status write_scene(FILE *to, const scene *s, const write_head *head, fault *f);
/* The same in memory, which the caller frees; "" where there is no scene (NULL) or no file can say
 * it. NULL: out of memory. */
char *write_scene_text(const scene *s, const write_head *head);

#endif
