/* Running text on a terminal. */
#ifndef BEAMWORK_PARAGRAPH_H
#define BEAMWORK_PARAGRAPH_H

#include <stdio.h>

enum { PARAGRAPH_WIDTH = 100 /* columns */ };

/* Columns that a text takes. */
int paragraph_columns(const char *text);
/* Words of the text up to the last column, further lines indented, and the end of the line; a word
 * that is longer than a line stays whole. at: columns that the first line has already. */
void paragraph_write(FILE *to, int at, int indent, const char *text);
/* The same of a command, whose lines but the last end in " \", as a shell reads it. */
void paragraph_command(FILE *to, int at, int indent, const char *text);
/* paragraph_write of a printf. */
void paragraph_say(FILE *to, int at, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
