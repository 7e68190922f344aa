/* What may stand in a scene file: tables of keys, used to check, to describe and to tell what was
 * meant. */
#ifndef BEAMWORK_SCENE_KEYS_H
#define BEAMWORK_SCENE_KEYS_H

#include "cases/format/document.h"

typedef enum key_kind {
    KEY_TEXT,    /* any text */
    KEY_NAME,    /* of another entry */
    KEY_WORD,    /* one of `words`, or a parameter with such choices */
    KEY_WORDS,   /* one or a list of them */
    KEY_NUMBER,  /* an expression */
    KEY_VECTOR,  /* a list of `count` expressions */
    KEY_NUMBERS, /* a list of any length, or a range */
    KEY_FORMS,   /* several forms, as the summary says */
    KEY_MAP,     /* a map with the keys `below` */
    KEY_ENTRIES, /* names, each with such a map */
    KEY_LIST,    /* a list of such maps */
    KEY_NAMES,   /* names of one's own, each with one value as `below` (its first key) says */
    KEY_LATER    /* has a meaning, but is not carried yet */
} key_kind;

typedef struct scene_key {
    const char *name; /* NULL ends a table */
    key_kind kind;
    int needed; /* 1: must be there */
    int group; /* keys of one group > 0 exclude each other; with `needed`, one of them must be there
                */
    int count;
    const char *words; /* "a|b|c" */
    const struct scene_key *below;
    const char *unit, *summary;
    /* Where it is left out, of every key but those that must be there: what may be written instead,
     * in the words of the file, or what happens. */
    const char *usual, *left_out;
} scene_key;

extern const scene_key keys_root[], keys_section[], keys_node[], keys_member[], keys_spring[],
    keys_motion[], keys_load[], keys_analysis[], keys_quantity[], keys_truth[], keys_parameter[],
    keys_part[], keys_instance[];

/* `for` and `let`, which every entry may have. */
extern const scene_key keys_loop[];
/* May its entries have them? */
int keys_loops(const scene_key *table);

/* Unknown, missing, misplaced keys and values of the wrong form, in the whole tree. 1: none. */
int keys_check(const document_node *root, mistakes *m);

#endif
