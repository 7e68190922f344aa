/* Formulations in processes of their own: --element 'exec:COMMAND'. */
#ifndef BEAMWORK_PROCESS_H
#define BEAMWORK_PROCESS_H

#include "elements/element.h"

enum { PROCESS_MOST = 16 };

/* The type that the command says it is. It and its process stay until this process ends. Each
 * process that uses it starts one of its own. REFUSED: no such command, or not the first line of
 * the protocol (protocol.md). */
status process_load(const char *command, const element_type **out, fault *f);
/* Is it computed by another process? */
int process_serves(const element_type *);
/* Seconds that an answer may take, from now on (120); 0: any time. */
void process_limit(int seconds);

#endif
