/* A process that works for the one that started it: it ends with that one, and keeps a time limit
 * by itself. */
#ifndef BEAMWORK_CHILD_H
#define BEAMWORK_CHILD_H

#include <stddef.h>
#include <sys/types.h>

/* In the child, before all else: ends with its parent, even one that is killed or was already gone;
 * an alarm ends it. */
void child_begin(pid_t parent);
/* In the child: from now on so many seconds are left; 0: no limit. */
void child_alarm(int seconds);
/* In the parent: has it ended? It is not reaped. */
int child_is_gone(pid_t process);
/* In the parent, which waits two seconds at most: reaps one that ends, or kills one that does not.
 * Returns how it ended (of waitpid). */
int child_reap(pid_t process);
/* In the parent: how it ended (of waitpid), in words; late: it was ended for being late. Returns 1
 * when the time was over. */
int child_ended(int how, int late, int seconds, char *words, size_t size);

#endif
