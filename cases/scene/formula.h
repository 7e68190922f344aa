/* Functions of time as text: + - * / ^, parentheses, sin cos tan asin acos atan sinh cosh tanh exp
 * log sqrt, pi, deg and the time t [s]. Values are SI, angles in radians (30*deg*t). ^ binds to the
 * right and before signs: -t^2 = -(t^2). What has kinks is given in pieces (function.h), so that
 * steps can end there. */
#ifndef BEAMWORK_FORMULA_H
#define BEAMWORK_FORMULA_H

#include "elements/shared/status.h"

typedef struct formula formula;

typedef struct formula_mistake {
    int at;           /* character of the text, from 0 */
    const char *what; /* and what to do */
} formula_mistake;

/* REFUSED, FAULT out of memory: why. */
status formula_parse(const char *text, formula **out, formula_mistake *);
/* REFUSED: what is wrong, and at which character (from 1). */
status formula_read(const char *text, formula **out, fault *f);
void formula_free(formula *);
/* Its value and its first two derivatives by t; not finite where it has none. */
void formula_at(const formula *, double t, double out[3]);

#endif
