/* Ends of the program that are not its own: signals, crashes, libraries that call exit(). */
#ifndef BEAMWORK_ENDING_H
#define BEAMWORK_ENDING_H

/* Once, before any file is opened. Standard streams that are closed are put onto /dev/null, which
 * refuses what is written: no file is taken for one of them. Signals that end the program (SIGTERM,
 * SIGHUP, SIGINT) and crashes first delete unfinished output files; a crash, or an exit() of a
 * library or an element, is told in one line. */
void ending_begin(void);

#endif
