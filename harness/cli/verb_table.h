/* All verbs, and what the program says of itself. */
#ifndef BEAMWORK_VERB_TABLE_H
#define BEAMWORK_VERB_TABLE_H

/* `beamwork VERB ...`, `beamwork help [VERB]`, --help, --version: the exit code. arguments[0] is
 * the program. */
int verb_table_run(int count, char **arguments);

#endif
