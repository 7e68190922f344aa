/* A value with its first two derivatives by the time, and what formulas do with such. */
#ifndef BEAMWORK_JET_H
#define BEAMWORK_JET_H

typedef struct jet {
    double v, d, dd;
} jet;

typedef enum jet_operation {
    JET_NUMBER, /* a constant */
    JET_TIME,
    JET_NEGATE,
    JET_ADD, /* of two, to JET_POWER */
    JET_SUBTRACT,
    JET_MULTIPLY,
    JET_DIVIDE,
    JET_POWER,
    JET_SIN, /* of one */
    JET_COS,
    JET_TAN,
    JET_ASIN,
    JET_ACOS,
    JET_ATAN,
    JET_SINH,
    JET_COSH,
    JET_TANH,
    JET_EXP,
    JET_LOG,
    JET_SQRT
} jet_operation;

/* The operation on a, and on b where it is of two; not finite where it has no value or no
 * derivative. Not of JET_NUMBER and JET_TIME. */
jet jet_of(jet_operation what, jet a, jet b);

#endif
