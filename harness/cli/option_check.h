/* The options of a command line, before they are taken: what is none, or lacks its value, is
 * refused in one line with the nearest one. */
#ifndef BEAMWORK_OPTION_CHECK_H
#define BEAMWORK_OPTION_CHECK_H

#include <argp.h>

#include "elements/shared/status.h"

/* chosen: what the verb takes, ending with a name of NULL. argument[0] is the program. */
status option_check(const char *verb, const struct argp_option chosen[], int count,
                    char *const argument[], fault *f);

#endif
