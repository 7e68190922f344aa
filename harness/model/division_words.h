/* Members that have more elements than was asked for, in words. */
#ifndef BEAMWORK_DIVISION_WORDS_H
#define BEAMWORK_DIVISION_WORDS_H

#include <stddef.h>

#include "cases/scene/scene.h"

/* "beam has 6 elements, 2 in each of 3 pieces: its loads begin, end or act at 0.3, 0.5 of its
 * length"; of many the first ones are named.  elements 0: of any number n.  "" where each has as
 * many as was asked for. */
void division_words(const scene *, int elements, char *text, size_t room);

#endif
