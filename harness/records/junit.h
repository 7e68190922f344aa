/* Verdicts for continuous integration: JUnit XML, values and tolerances as properties. */
#ifndef BEAMWORK_JUNIT_H
#define BEAMWORK_JUNIT_H

#include <stdio.h>

#include "harness/study/study.h"

void junit_write(FILE *to, const sweep *s, const judgement *j);

#endif
