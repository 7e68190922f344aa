/* Outcomes and their words. */
#include "elements/math/status.h"

#include <stdarg.h>
#include <stdio.h>

status fault_set(fault *f, status s, const char *format, ...)
{
    if (f != NULL) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(f->text, sizeof f->text, format, arguments);
        va_end(arguments);
    }
    return s;
}

const char *status_name(status s)
{
    static const char *const names[] = {"ok", "not_converged", "singular", "refused", "fault", "time_limit"};
    return names[s];
}
