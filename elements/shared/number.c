#include "elements/shared/number.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int number_read(const char *text, const char **end, double *out)
{
    char *behind;
    errno = 0;
    const double value = strtod(text, &behind);
    *end = behind;
    /* decimal numbers only: strtod reads 0x10 as 16 */
    if (behind == text || memchr(text, 'x', (size_t)(behind - text)) != NULL ||
        memchr(text, 'X', (size_t)(behind - text)) != NULL || errno == ERANGE || !isfinite(value))
        return 0;
    *out = value;
    return 1;
}
