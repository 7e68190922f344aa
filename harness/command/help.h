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

/* Usage, what it does, options, examples: within PARAGRAPH_WIDTH columns. */
void help_write(FILE *to, const help_subject *s);

#endif
