#include "elements/shared/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void shorten(const char *line, size_t length, char text[FAULT_TEXT])
{
    static const char gap[] = " ... ";
    const size_t room = FAULT_TEXT - sizeof gap, tail = room / 2, head = room - tail;
    memcpy(text, line, head);
    memcpy(text + head, gap, sizeof gap - 1);
    memcpy(text + head + sizeof gap - 1, line + length - tail, tail + 1);
}

status fault_set(fault *f, status s, const char *format, ...)
{
    if (f != NULL) {
        enum { LONGEST = 8192 };
        char line[LONGEST];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(line, sizeof line, format, arguments);
        va_end(arguments);
        const size_t length = strlen(line);
        if (length < FAULT_TEXT)
            memcpy(f->text, line, length + 1);
        else
            shorten(line, length, f->text);
    }
    return s;
}

status fault_memory(fault *f, const char *format, ...)
{
    char what[FAULT_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return fault_set(f, STATUS_FAULT,
                     "out of memory for %s; close other programs, or reduce the problem, for "
                     "example with fewer elements",
                     what);
}

status fault_unreadable(fault *f, const char *path, int why)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s cannot be read (%s); give the path of an existing, readable file",
                     path, strerror(why));
}

const char *status_name(status s)
{
    static const char *const names[] = {"ok",    "not_converged", "singular", "refused",
                                        "fault", "time_limit",    "no_value"};
    return names[s];
}
