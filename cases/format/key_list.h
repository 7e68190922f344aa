/* The keys of scene files as a list to read. */
#ifndef BEAMWORK_KEY_LIST_H
#define BEAMWORK_KEY_LIST_H

#include <stdio.h>

/* What stands before the list: two paragraphs. */
extern const char *const key_list_head[2];

/* A key at its depth below the root (0), its form ("NAME: {...}") and what it is. */
typedef void key_list_take(void *context, int depth, const char *name, const char *form,
                           const char *text);
/* Those that every entry may have (loops), and all others, each behind that which it belongs to.
 * Keys that are not carried yet are left out. */
void key_list_loops(key_list_take *take, void *context);
void key_list_all(key_list_take *take, void *context);

/* Writes a text behind `at` columns of a line, further lines indented, and the end of the line. */
typedef void key_list_say(FILE *to, int at, int indent, const char *text);
/* Of each key: name, form, unit, summary, and its words. */
void key_list_write(FILE *to, key_list_say *say);

#endif
