#include "harness/catalogue/number.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>

int number_read(const char *text, const char **end, double *out)
{
    char *behind;
    errno = 0;
    const double value = strtod(text, &behind);
    *end = behind;
    if (behind == text || errno == ERANGE || !isfinite(value))
        return 0;
    *out = value;
    return 1;
}
