/* What entries of a scene consist of: a line for each key, with what a file calls it, where its
 * value is, its unit and its range.  From these lines a file is read, checked, described and
 * written, other units are taken, members are reversed, and scenes are compared. */
#ifndef BEAMWORK_SCENE_ENTRY_H
#define BEAMWORK_SCENE_ENTRY_H

#include <stddef.h>

#include "cases/scene/names.h"

typedef enum entry_kind {
    ENTRY_TEXT,      /* any text */
    ENTRY_NAME,      /* of another entry: int, its index, or SCENE_NONE */
    ENTRY_WORD,      /* one of `words`, or a parameter with such choices: int; double: left as it is
                        where the key is not there */
    ENTRY_FLAG,      /* one of `words`, those with an odd index mean 1: int */
    ENTRY_WORDS,     /* one or a list of them: unsigned, a bit for each */
    ENTRY_NUMBER,    /* an expression: double */
    ENTRY_WHOLE,     /* one without a fraction: int */
    ENTRY_VECTOR,    /* a list of `count` expressions: double[] */
    ENTRY_DIRECTION, /* one of three, which turns with the part it is in */
    ENTRY_POSITION,  /* one of three, which is placed with the part it is in */
    ENTRY_NUMBERS,   /* a list of any length, or a range: scene_path */
    ENTRY_FORMS,     /* several forms, as the summary says */
    ENTRY_MAP,       /* a map with the keys `below`, whose values are in the same struct */
    ENTRY_ENTRIES,   /* names, each with such a map */
    ENTRY_LIST,      /* a list of such maps */
    ENTRY_NAMES,     /* names of one's own, each with one value as `below` (its first key) says */
    ENTRY_LATER      /* has a meaning, but is not carried yet */
} entry_kind;

/* How a word turns with the axes. */
typedef enum entry_turns {
    ENTRY_STAYS,
    ENTRY_COMPONENT, /* as a displacement or a rotation along them */
    ENTRY_AXIS,      /* as a direction */
    ENTRY_DIAGONAL   /* as a component; what it is of keeps its sign */
} entry_turns;

enum { ENTRY_MOST_ORDER = 100000 }; /* of an eigenvalue, a point, a crossing */

struct quantity_type;

typedef struct entry_field {
    const char *name; /* NULL ends a table */
    entry_kind kind;
    int needed; /* 1: must be there */
    int group; /* keys of one group > 0 exclude each other; with `needed`, one of them must be there
                */
    int count;
    const char *words; /* "a|b|c" */
    const struct entry_field *below;
    /* of a number: gives the power of length and of force by which it is scaled; others: for the
     * reader */
    const char *unit, *summary;
    /* Where it is left out, of every key but those that must be there: what may be written instead,
     * in the words of the file, or what happens. */
    const char *usual, *left_out;
    /* Where its value is in the struct of the entry: ENTRY_IN. size 0: nowhere, functions of its
     * own read and write it. Of a map: of the int that says which of a group stands there. */
    size_t at, size;
    int first, falls;   /* value of the first word, or of the map; by how much the next is lower */
    double otherwise;   /* a number that is left out, where `usual` does not say it; NAN: none */
    double least, most; /* range of a number; both 0: any */
    const char *range;  /* in words; NULL: by these two */
    scene_list of;      /* NAME: in which list */
    size_t zeros;       /* of the unsigned in which the bit `zero` says that a zero is given */
    unsigned zero;      /* 0: there is no such bit */
    int always;         /* 1: written also where it could be left out */
    entry_turns turns;
    const struct quantity_type *type; /* of a map: what says its summary, keys and value */
    const char *mirrors; /* "++-": signs of its numbers when the ends of its member are exchanged */
} entry_field;

#define ENTRY_IN(type, member) .at = offsetof(type, member), .size = sizeof(((type *)0)->member)

#define ENTRY_COMPONENTS "ux|uy|uz|rx|ry|rz"

extern const entry_field entry_section[], entry_node[], entry_member[], entry_spring[],
    entry_driver[], entry_load[], entry_analysis[], entry_quantity[];

/* The key of the vector of a load: "force", with its unit. */
const entry_field *entry_of_load(scene_load_kind);

/* Of a map: its keys; of all: what it is. */
const entry_field *entry_below(const entry_field *);
const char *entry_summary(const entry_field *);
/* What a number is where the file does not say. */
double entry_usual(const entry_field *);
/* Of a word: the int of that index, its index, and the int that it stands for. */
int entry_value(const entry_field *, int index);
int entry_index(const entry_field *, int value);
int entry_word(const entry_field *, const char *word);
/* Is the value as if the key were left out? */
int entry_is_usual(const entry_field *, const void *entry);
/* Of a map in a group: is it the one that stands there? Of others: 1. */
int entry_stands(const entry_field *, const void *entry);
/* "at least 0" */
const char *entry_range(const entry_field *, char text[FAULT_TEXT]);
int entry_in_range(const entry_field *, double value);
/* REFUSED: a number is none or beyond its range ("damping = -1; give at least 0"), a name is that
 * of no entry, a word is none of its words. */
status entry_check(const scene *s, const entry_field *table, const void *entry, fault *f);

typedef enum entry_base { ENTRY_LENGTH, ENTRY_FORCE } entry_base;
/* Power of length or force in a unit, seconds and angles kept: of "kg/m^3" -4 and 1. */
int entry_power(const char *unit, entry_base);
/* All numbers that have a unit, when there are `times` of one base unit in its place. */
void entry_scale(const entry_field *table, void *entry, entry_base, double times);
/* Its member's ends are exchanged. */
void entry_mirror(const entry_field *table, void *entry);
/* Bit for bit, but for what functions of its own read and write. */
int entry_same(const entry_field *table, const void *a, const void *b);

#endif
