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
/* The same of a printf. */
void paragraph_say(FILE *to, int at, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A paragraph that is written word by word: between the two, to the stream that the first returns
 * (where memory is short, that is `to` itself, and lines are as long as they are). */
typedef struct paragraph {
    FILE *to, *words;
    char *text;
    size_t size;
} paragraph;
FILE *paragraph_begin(paragraph *, FILE *to);
/* As paragraph_write. */
void paragraph_end(paragraph *, int at, int indent);
/* The same of a command, whose lines but the last end in " \", as a shell reads it. */
void paragraph_end_command(paragraph *, int at, int indent);

#endif
