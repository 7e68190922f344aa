/* results.h5: everything a sweep found, for the reports. Layout: harness/README.md. */
#ifndef BEAMWORK_STORE_H
#define BEAMWORK_STORE_H

#include "harness/run/environment.h"
#include "harness/run/verdict.h"

enum { STORE_VERSION = 1 };

/* Written beside and renamed: FAULT leaves nothing behind. */
status store_write(const char *path, const sweep *s, const judgement *j, const environment *e, fault *f);

#endif
