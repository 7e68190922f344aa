/* Numbers that a user writes. */
#ifndef BEAMWORK_NUMBER_H
#define BEAMWORK_NUMBER_H

/* The number that `text` begins with; *end: behind it. 0: there is none, or a double does not hold
 * it: it is infinite, or so small (below 2.2e-308) that it would become zero or lose digits. */
int number_read(const char *text, const char **end, double *out);

#endif
