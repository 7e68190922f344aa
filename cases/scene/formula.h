/* Functions of time as text: + - * / ^, parentheses, sin cos tan asin acos atan sinh cosh tanh exp
 * log sqrt, pi, deg and the time t. What has kinks is given in pieces (function.h), so that steps
 * can end there. */
#ifndef BEAMWORK_FORMULA_H
#define BEAMWORK_FORMULA_H

#include "elements/shared/status.h"

typedef struct formula formula;

/* REFUSED: what is wrong, and at which character (from 1). */
status formula_read(const char *text, formula **out, fault *f);
void formula_free(formula *);
/* Its value and its first two derivatives by t. */
void formula_at(const formula *, double t, double out[3]);

#endif
