/* How the program says that something went wrong, and with which exit status it ends. */
#ifndef BEAMWORK_MESSAGE_H
#define BEAMWORK_MESSAGE_H

#include "elements/shared/status.h"

/* At the end of the program: the exit code, or EXIT_FAULT when standard output could not be
 * written. */
int message_finish(int code);
/* One line on stderr; the exit code that belongs to a status. */
int message_fail(status s, const char *text);
/* The line, and the end of the program: what was asked for makes no sense. */
_Noreturn void message_refuse(const char *text);
/* EXIT_AS_EXPECTED, or message_fail with what is wrong. */
int message_exit(status s, const fault *f);

#endif
