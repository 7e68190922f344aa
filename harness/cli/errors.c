#include "harness/cli/errors.h"

#include <stdlib.h>

/* One of the list; returns where it ends, NULL: it is none. */
static const char *parse_one(const char *at, double *out)
{
    char *end;
    *out = strtod(at, &end);
    if (end == at)
        return NULL;
    if (*end == '%') {
        *out /= 100;
        end++;
    }
    return (*end == ',' || *end == '\0') && *out > 0 && *out < 1 ? end : NULL;
}

status errors_parse(const char *text, int most, double level[], int *count, fault *f)
{
    const char *at = text;
    *count = 0;
    do {
        at = *count < most ? parse_one(at, &level[*count]) : NULL;
        if (at == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "--error '%.60s': give at most %d between 0 and 100 %%, such as 1%%",
                             text, most);
        ++*count;
    } while (*at++ == ',');
    return STATUS_OK;
}
