/* Where data stand that the program reads: truths, programs that derive them. */
#ifndef BEAMWORK_DATA_PLACE_H
#define BEAMWORK_DATA_PLACE_H

#include <limits.h>

/* Beside the program or the shared library, or in the folder above (a clone), or in share/beamwork
 * of the folder that it is installed below, or of the prefix that it was built for; the first of
 * these that is there. 0: none is, and the path is that beside the program. */
int data_place(const char *name, char path[PATH_MAX]);
/* The packed truths: BEAMWORK_TRUTHS, or data_place. */
void data_place_truths(char path[PATH_MAX]);
/* Processes that are started from now on find beamwork_element.py behind all that PYTHONPATH names:
 * its folder, where there is one, is appended to it, and Python leaves no compiled files. */
void data_place_modules(void);

#endif
