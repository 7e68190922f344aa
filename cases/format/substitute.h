/* Names of loops in texts: $i, or ${i} before letters, is replaced by the loop's whole number or
 * word. */
#ifndef BEAMWORK_SUBSTITUTE_H
#define BEAMWORK_SUBSTITUTE_H

#include "cases/format/scope.h"

/* The tree with all names replaced: itself where there are none, else a copy; NULL when memory ran
 * out. What cannot be replaced is a mistake and stays. */
const document_node *substitute_node(const document_node *n, const scope *names, arena *a,
                                     mistakes *m);
/* A text for people: numbers of any kind, with six digits. */
const char *substitute_said(const document_node *n, const scope *names, arena *a, mistakes *m);
/* 1: a loop name is left in this text: it could not be replaced, which was told. */
int substitute_is_left(const char *text);

#endif
