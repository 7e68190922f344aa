/* A YAML document as a tree of maps, lists and texts, each with its place in the file.
 *
 * Every scalar is text until somebody asks for a number or a word: there are no implicit types.
 * Anchors, aliases, tags, merge keys, several documents, duplicate keys and what is too deep or too
 * large are refused. */
#ifndef BEAMWORK_DOCUMENT_H
#define BEAMWORK_DOCUMENT_H

#include "cases/format/arena.h"
#include "cases/format/mistakes.h"

enum { DOCUMENT_BYTES = 1 << 20, DOCUMENT_DEPTH = 16, DOCUMENT_ENTRIES = 10000 };

typedef enum document_kind { DOCUMENT_TEXT, DOCUMENT_LIST, DOCUMENT_MAP } document_kind;

typedef struct document_node {
    document_kind kind;
    int line, column; /* of its first character, counted from 1 */
    /* A text that stands in the file as it is: how many columns behind `column` it begins (a
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

#endif
