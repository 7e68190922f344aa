/* The keys of scene files as a list to read. */
#ifndef BEAMWORK_KEY_LIST_H
#define BEAMWORK_KEY_LIST_H

#include <stdio.h>

/* Writes a text behind `at` columns of a line, further lines indented, and the end of the line. */
typedef void key_list_say(FILE *to, int at, int indent, const char *text);
/* Of each key: name, form, unit, summary, and its words. Keys that are not carried yet are left
 * out. */
void key_list_write(FILE *to, key_list_say *say);

#endif
