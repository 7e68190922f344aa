/* Running text on a terminal. */
#ifndef BEAMWORK_PARAGRAPH_H
#define BEAMWORK_PARAGRAPH_H

#include <stdio.h>

enum { PARAGRAPH_WIDTH = 100 /* columns */ };

/* Words of the text up to the last column, further lines indented, and the end of the line. at:
 * columns that the first line has already. */
void paragraph_write(FILE *to, int at, int indent, const char *text);

#endif
