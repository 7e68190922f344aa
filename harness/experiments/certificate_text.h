/* Certificates for people, a screen each. */
#ifndef BEAMWORK_CERTIFICATE_TEXT_H
#define BEAMWORK_CERTIFICATE_TEXT_H

#include <stdio.h>

#include "harness/experiments/certificate.h"
#include "harness/terminal/terminal.h"

/* verbose: every claim with its numbers; quiet: only what is broken. */
void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet);

#endif
