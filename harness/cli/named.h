/* The formulations of a command line: those that -f names and those that --element loads, which may
 * stand behind the -f that names them. What is refused ends the program. */
#ifndef BEAMWORK_NAMED_H
#define BEAMWORK_NAMED_H

#include "harness/cli/command.h"

/* As -f and --element say them. */
void named_formulation(command_request *r, const char *text);
void named_element(command_request *r, const char *path);
/* When all options are known: the time limit holds for a process that says what it is. */
void named_load(command_request *r);
/* 1: every formulation of the request was asked for by its name; 0: all were, or none. */
int named_alone(const command_request *r);
/* One more of the request's formulations, or "all". */
void named_add(command_request *r, const char *text);

#endif
