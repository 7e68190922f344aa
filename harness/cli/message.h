/* How the program says that something went wrong, and with which exit status it ends. */
#ifndef BEAMWORK_MESSAGE_H
#define BEAMWORK_MESSAGE_H

#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"

/* At the end of the program: the exit code, or EXIT_FAULT when standard output could not be
 * written. */
int message_finish(int code);
/* One line on stderr; the exit code that belongs to a status. */
int message_fail(status s, const char *text);
/* The line, and the end of the program: what was asked for makes no sense. */
_Noreturn void message_refuse(const char *text);
/* EXIT_AS_EXPECTED, or message_fail with what is wrong. */
int message_exit(status s, const fault *f);

/* Ends that are not its own: signals, crashes, libraries that call exit(). */
/* A formulation from outside that runs in this process: when it crashes or does not come back,
 * the program ends with one line that names it. From now on; seconds: 0 for no limit. Does nothing
 * for formulations of the program's own. */
void guard_formulation(const formulation *chosen, int seconds);
/* Once, before any file is opened. Standard streams that are closed are put onto /dev/null, which
 * refuses what is written: no file is taken for one of them. Signals that end the program (SIGTERM,
 * SIGHUP, SIGINT) and crashes first delete unfinished output files; a crash, or an exit() of a
 * library or an element, is told in one line. */
void ending_begin(void);

#endif
