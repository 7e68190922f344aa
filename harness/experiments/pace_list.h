/* Steps and tolerances as a command line lists them. */
#ifndef BEAMWORK_PACE_LIST_H
#define BEAMWORK_PACE_LIST_H

#include "elements/shared/status.h"

enum { PACE_LIST_MOST = 16 };

typedef struct pace_list {
    int count;
    double value[PACE_LIST_MOST];
} pace_list;

/* "0.1,0.05" or "0.1..0.0125", which is divided by `ratio` from the first to the last; positive
 * numbers. option: its name, for messages. */
status pace_list_read(const char *option, const char *text, double ratio, pace_list *out, fault *f);
/* first, divided by ratio again and again. */
pace_list pace_list_divided(double first, double ratio, int count);

#endif
