/* Where the packed truths are. */
#ifndef BEAMWORK_TRUTHS_PLACE_H
#define BEAMWORK_TRUTHS_PLACE_H

#include <limits.h>

/* BEAMWORK_TRUTHS; or truths.h5 beside the program or the shared library, or in share/beamwork of
 * the folder that it is installed below, or of the prefix that it was built for; the first that is
 * there, else the place beside the program. */
void truths_place(char path[PATH_MAX]);

#endif
