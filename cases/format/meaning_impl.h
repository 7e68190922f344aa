/* Parts of the words of a quantity, for the files that put them together. */
#ifndef BEAMWORK_MEANING_IMPL_H
#define BEAMWORK_MEANING_IMPL_H

#include <stdio.h>

#include "cases/scene/meaning_words.h"

/* Of which states of which analysis: ", at the end of the static path". */
void meaning_state(FILE *to, const scene *s, const scene_quantity *q);

#endif
