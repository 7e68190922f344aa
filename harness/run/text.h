/* Results as text: for people (tables), for spreadsheets (CSV) and for CI (JUnit). */
#ifndef BEAMWORK_TEXT_H
#define BEAMWORK_TEXT_H

#include <stdio.h>

#include "harness/run/verdict.h"

void text_solution(FILE *to, const sweep *s, const truths *t);
void text_solution_csv(FILE *to, const sweep *s);
void text_verdicts(FILE *to, const sweep *s, const judgement *j, const truths *t);
void text_convergence(FILE *to, const sweep *s, const truths *t);
void text_convergence_csv(FILE *to, const sweep *s, const truths *t);
void text_junit(FILE *to, const sweep *s, const judgement *j);

#endif
