/* Numbers as expressions: + - * / ^, parentheses, functions, names.
 *
 * ^ binds strongest and to the right (-2^2 = -4, 2^3^2 = 512), then signs, then * and /, then + and
 * -. Values are SI; results must be finite. What is wrong is told at its character. */
#ifndef BEAMWORK_EXPRESSION_H
#define BEAMWORK_EXPRESSION_H

#include "cases/format/scope.h"

/* 1 and the value, or 0 after a mistake. */
int expression_number(const document_node *n, const scope *names, mistakes *m, double *out);
/* The same of `length` bytes of the text from `from`. */
int expression_part(const document_node *n, int from, int length, const scope *names, mistakes *m,
                    double *out);
/* Exactly `count` numbers of a list. */
int expression_vector(const document_node *n, int count, const scope *names, mistakes *m,
                      double out[]);
#endif
