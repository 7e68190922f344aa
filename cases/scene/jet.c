#include "cases/scene/jet.h"

#include <math.h>

/* g(x), with g' and g'' at its value. */
static jet chain(jet x, double g, double d, double dd)
{
    return (jet){g, d * x.d, dd * x.d * x.d + d * x.dd};
}

static jet product(jet a, jet b)
{
    return (jet){a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}

static jet quotient(jet a, jet b)
{
    const double v = a.v / b.v, d = (a.d - v * b.d) / b.v;
    return (jet){v, d, (a.dd - 2 * d * b.d - v * b.dd) / b.v};
}

static jet power(jet a, jet b)
{
    if (b.d == 0 && b.dd == 0) {
        const double n = b.v;
        return chain(a, pow(a.v, n), n == 0 ? 0 : n * pow(a.v, n - 1),
                     n == 0 || n == 1 ? 0 : n * (n - 1) * pow(a.v, n - 2));
    }
    const double v = log(a.v);
    const jet of = product(b, chain(a, v, 1 / a.v, -1 / (a.v * a.v)));
    return chain(of, exp(of.v), exp(of.v), exp(of.v));
}

static jet of_function(jet_operation what, jet x)
{
    const double v = x.v;
    switch (what) {
    case JET_SIN:
        return chain(x, sin(v), cos(v), -sin(v));
    case JET_COS:
        return chain(x, cos(v), -sin(v), -cos(v));
    case JET_TAN: {
        const double g = tan(v), d = 1 + g * g;
        return chain(x, g, d, 2 * g * d);
    }
    case JET_ASIN: {
        const double s = 1 - v * v;
        return chain(x, asin(v), 1 / sqrt(s), v / (s * sqrt(s)));
    }
    case JET_ACOS: {
        const double s = 1 - v * v;
        return chain(x, acos(v), -1 / sqrt(s), -v / (s * sqrt(s)));
    }
    case JET_ATAN: {
        const double s = 1 + v * v;
        return chain(x, atan(v), 1 / s, -2 * v / (s * s));
    }
    case JET_SINH:
        return chain(x, sinh(v), cosh(v), sinh(v));
    case JET_COSH:
        return chain(x, cosh(v), sinh(v), cosh(v));
    case JET_TANH: {
        const double g = tanh(v), d = 1 - g * g;
        return chain(x, g, d, -2 * g * d);
    }
    case JET_EXP:
        return chain(x, exp(v), exp(v), exp(v));
    case JET_LOG:
        return chain(x, log(v), 1 / v, -1 / (v * v));
    default: /* JET_SQRT */
        return chain(x, sqrt(v), 0.5 / sqrt(v), -0.25 / (v * sqrt(v)));
    }
}

jet jet_of(jet_operation what, jet a, jet b)
{
    switch (what) {
    case JET_NEGATE:
        return (jet){-a.v, -a.d, -a.dd};
    case JET_ADD:
        return (jet){a.v + b.v, a.d + b.d, a.dd + b.dd};
    case JET_SUBTRACT:
        return (jet){a.v - b.v, a.d - b.d, a.dd - b.dd};
    case JET_MULTIPLY:
        return product(a, b);
    case JET_DIVIDE:
        return quotient(a, b);
    case JET_POWER:
        return power(a, b);
    default:
        return of_function(what, a);
    }
}
