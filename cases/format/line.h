/* Lines of other programs' files as text, fields, numbers. Nothing is believed of them. */
#ifndef BEAMWORK_LINE_H
#define BEAMWORK_LINE_H

#include <stdio.h>

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

#endif
