/* Second-order jets: a value with its gradient and Hessian in six variables (forward differentiation, exact).
 * hessian holds the upper triangle, row by row. */
#ifndef BEAMWORK_JET_H
#define BEAMWORK_JET_H

#include <math.h>

enum { JET_VARIABLES = 6, JET_PAIRS = 21 };

typedef struct jet {
    double value, gradient[JET_VARIABLES], hessian[JET_PAIRS];
} jet;

static inline jet jet_add(const jet *a, double ca, const jet *b, double cb) /* ca a + cb b */
{
    jet c;
    c.value = ca * a->value + cb * b->value;
    for (int i = 0; i < JET_VARIABLES; i++)
        c.gradient[i] = ca * a->gradient[i] + cb * b->gradient[i];
    for (int i = 0; i < JET_PAIRS; i++)
        c.hessian[i] = ca * a->hessian[i] + cb * b->hessian[i];
    return c;
}

static inline jet jet_mul(const jet *a, const jet *b)
{
    jet c;
    int k = 0;
    c.value = a->value * b->value;
    for (int i = 0; i < JET_VARIABLES; i++)
        c.gradient[i] = a->value * b->gradient[i] + b->value * a->gradient[i];
    for (int i = 0; i < JET_VARIABLES; i++)
        for (int j = i; j < JET_VARIABLES; j++, k++)
            c.hessian[k] = a->value * b->hessian[k] + b->value * a->hessian[k] + a->gradient[i] * b->gradient[j] +
                           a->gradient[j] * b->gradient[i];
    return c;
}

/* f(a) from f, f', f'' at a's value. */
static inline jet jet_compose(const jet *a, double f, double first, double second)
{
    jet c;
    int k = 0;
    c.value = f;
    for (int i = 0; i < JET_VARIABLES; i++)
        c.gradient[i] = first * a->gradient[i];
    for (int i = 0; i < JET_VARIABLES; i++)
        for (int j = i; j < JET_VARIABLES; j++, k++)
            c.hessian[k] = first * a->hessian[k] + second * a->gradient[i] * a->gradient[j];
    return c;
}

static inline jet jet_sqrt(const jet *a)
{
    const double root = sqrt(a->value);
    return jet_compose(a, root, 0.5 / root, -0.25 / (root * a->value));
}

/* Angle of (x, y): x d - y c form, whole circle. */
static inline jet jet_atan2(const jet *y, const jet *x)
{
    const double r2 = x->value * x->value + y->value * y->value, cosine = x->value / r2, sine = y->value / r2;
    jet c;
    int k = 0;
    double along[JET_VARIABLES]; /* gradient of log r */
    c.value = atan2(y->value, x->value);
    for (int i = 0; i < JET_VARIABLES; i++) {
        c.gradient[i] = cosine * y->gradient[i] - sine * x->gradient[i];
        along[i] = cosine * x->gradient[i] + sine * y->gradient[i];
    }
    for (int i = 0; i < JET_VARIABLES; i++)
        for (int j = i; j < JET_VARIABLES; j++, k++)
            c.hessian[k] = cosine * y->hessian[k] - sine * x->hessian[k] - along[i] * c.gradient[j] - along[j] * c.gradient[i];
    return c;
}

#endif
