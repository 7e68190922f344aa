#include "harness/cli/message.h"

#include <stdio.h>
#include <stdlib.h>

#include "harness/cli/command.h"

int message_finish(int code)
{
    const int told = code == EXIT_REFUSED || code == EXIT_FAULT; /* that line is enough */
    if ((fflush(stdout) == 0 && !ferror(stdout)) || told)
        return code;
    return message_fail(STATUS_FAULT, "standard output cannot be written");
}

int message_exit(status s, const fault *f)
{
    return s == STATUS_OK ? EXIT_AS_EXPECTED : message_fail(s, f->text);
}

int message_fail(status s, const char *text)
{
    fprintf(stderr, "beamwork: %s\n", text);
    switch (s) {
    case STATUS_OK:
        return EXIT_AS_EXPECTED;
    case STATUS_NOT_CONVERGED:
    case STATUS_SINGULAR:
    case STATUS_TIME_LIMIT:
    case STATUS_NO_VALUE:
        return EXIT_DIFFERS;
    case STATUS_REFUSED:
        return EXIT_REFUSED;
    case STATUS_FAULT:
        break;
    }
    return EXIT_FAULT;
}

void message_refuse(const char *text)
{
    exit(message_fail(STATUS_REFUSED, text));
}
