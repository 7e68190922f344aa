/* The keys of scene files as a list to read. */
#ifndef BEAMWORK_KEY_LIST_H
#define BEAMWORK_KEY_LIST_H

#include <stdio.h>

/* A line for each key: name, form, unit, summary, and its words. Keys that are not carried yet are
 * left out. */
void key_list_write(FILE *to);

#endif
