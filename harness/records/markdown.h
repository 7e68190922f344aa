/* Summary of a verification as Markdown, for the description of a pull request. */
#ifndef BEAMWORK_MARKDOWN_H
#define BEAMWORK_MARKDOWN_H

#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

void markdown_write(FILE *to, const sweep *s, const judgement *j, const overview *o,
                    const environment *e);

#endif
