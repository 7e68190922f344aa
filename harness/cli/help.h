/* What a verb says of itself. */
#ifndef BEAMWORK_HELP_H
#define BEAMWORK_HELP_H

#include <argp.h>
#include <stdio.h>

/* A verb for its help. */
typedef struct help_subject {
    const char *verb, *arguments;
    const char *doc;                  /* what it does; behind '\v' examples, a line each */
    const struct argp_option *chosen; /* what it takes, ending with a name of NULL */
} help_subject;

/* How it is written: as a text for a terminal, a manual page, words that complete a line. */
typedef void help_writer(FILE *to, const help_subject *s, const void *context);
/* From now on -h of every verb is written by this one. */
void help_use(help_writer *writer, const void *context);
/* As help_use said; else usage, what it does, options, examples: within PARAGRAPH_WIDTH columns. */
void help_write(FILE *to, const help_subject *s);
/* Is help all that a verb is called for? arguments[0]: the verb. */
int help_asked(int count, char *const arguments[]);

#endif
