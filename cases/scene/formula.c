#include "cases/scene/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"

enum { MOST = 256, DEEPEST = 32 };

typedef enum operation {
    NUMBER,
    TIME,
    NEGATE,
    ADD,
    SUBTRACT,
    MULTIPLY,
    DIVIDE,
    POWER,
    SIN,
    COS,
    TAN,
    ASIN,
    ACOS,
    ATAN,
    SINH,
    COSH,
    TANH,
    EXP,
    LOG,
    SQRT
} operation;

typedef struct instruction {
    operation what;
    double number;
} instruction;

/* In the order in which they are carried out, on a stack. */
struct formula {
    int count, deepest;
    instruction step[MOST];
};

/* Value and derivatives. */
typedef struct jet {
    double v, d, dd;
} jet;

typedef struct reader {
    const char *text;
    int at, depth; /* depth: of the stack; nested: of parentheses */
    int nested;
    formula *to;
    fault *f;
} reader;

static status wrong(const reader *r, const char *what)
{
    return fault_set(r->f, STATUS_REFUSED, "function of time \"%s\", character %d: %s", r->text,
                     r->at + 1, what);
}

static void skip_blanks(reader *r)
{
    while (isspace((unsigned char)r->text[r->at]))
        r->at++;
}

static int takes(reader *r, char sign)
{
    skip_blanks(r);
    if (r->text[r->at] != sign)
        return 0;
    r->at++;
    return 1;
}

/* grows: values more on the stack. */
static status emit(reader *r, operation what, double number, int grows)
{
    if (r->to->count == MOST)
        return wrong(r, "too long; split it into pieces");
    r->to->step[r->to->count++] = (instruction){what, number};
    r->depth += grows;
    if (r->depth > r->to->deepest)
        r->to->deepest = r->depth;
    return r->depth < DEEPEST ? STATUS_OK : wrong(r, "too deeply nested");
}

static status read_sum(reader *r);

static const struct {
    const char *name;
    operation what;
} functions[] = {{"sin", SIN},   {"cos", COS},   {"tan", TAN},   {"asin", ASIN},
                 {"acos", ACOS}, {"atan", ATAN}, {"sinh", SINH}, {"cosh", COSH},
                 {"tanh", TANH}, {"exp", EXP},   {"log", LOG},   {"sqrt", SQRT}};

static status read_function(reader *r, operation what)
{
    if (!takes(r, '('))
        return wrong(r, "a function needs its argument in parentheses");
    TRY(read_sum(r));
    if (!takes(r, ')'))
        return wrong(r, "missing )");
    return emit(r, what, 0, 0);
}

static status read_word(reader *r)
{
    const int first = r->at;
    int length = 0;
    while (isalnum((unsigned char)r->text[first + length]) || r->text[first + length] == '_')
        length++;
    const char *word = r->text + first;
    if (length == 1 && *word == 't') {
        r->at += length;
        return emit(r, TIME, 0, 1);
    }
    if (length == 2 && strncmp(word, "pi", 2) == 0) {
        r->at += length;
        return emit(r, NUMBER, PI, 1);
    }
    if (length == 3 && strncmp(word, "deg", 3) == 0) {
        r->at += length;
        return emit(r, NUMBER, PI / 180, 1);
    }
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
        if ((int)strlen(functions[i].name) == length &&
            strncmp(functions[i].name, word, (size_t)length) == 0) {
            r->at += length;
            return read_function(r, functions[i].what);
        }
    return wrong(r, "no such name; there are t, pi, deg, sin, cos, tan, asin, acos, atan, sinh, "
                    "cosh, tanh, exp, log, sqrt");
}

static status read_atom(reader *r)
{
    skip_blanks(r);
    const char *from = r->text + r->at;
    if (takes(r, '(')) {
        TRY(read_sum(r));
        return takes(r, ')') ? STATUS_OK : wrong(r, "missing )");
    }
    if (isdigit((unsigned char)*from) || *from == '.') {
        char *end;
        const double number = strtod(from, &end);
        r->at += (int)(end - from);
        return end > from && isfinite(number) ? emit(r, NUMBER, number, 1)
                                              : wrong(r, "not a number");
    }
    if (isalpha((unsigned char)*from))
        return read_word(r);
    return wrong(r, *from == 0 ? "it ends where a value is due" : "a value is due");
}

static status read_signed(reader *r);

static status read_power(reader *r)
{
    TRY(read_atom(r));
    if (!takes(r, '^'))
        return STATUS_OK;
    TRY(read_signed(r));
    return emit(r, POWER, 0, -1);
}

/* A sign binds weaker than ^. */
static status read_signed(reader *r)
{
    if (++r->nested > DEEPEST)
        return wrong(r, "too deeply nested");
    const int minus = takes(r, '-'), plus = !minus && takes(r, '+');
    TRY(minus || plus ? read_signed(r) : read_power(r));
    r->nested--;
    return minus ? emit(r, NEGATE, 0, 0) : STATUS_OK;
}

static status read_product(reader *r)
{
    TRY(read_signed(r));
    for (;;) {
        const int times = takes(r, '*'), over = !times && takes(r, '/');
        if (!times && !over)
            return STATUS_OK;
        TRY(read_signed(r));
        TRY(emit(r, times ? MULTIPLY : DIVIDE, 0, -1));
    }
}

static status read_sum(reader *r)
{
    TRY(read_product(r));
    for (;;) {
        const int plus = takes(r, '+'), minus = !plus && takes(r, '-');
        if (!plus && !minus)
            return STATUS_OK;
        TRY(read_product(r));
        TRY(emit(r, plus ? ADD : SUBTRACT, 0, -1));
    }
}

static status read_all(reader *r)
{
    TRY(read_sum(r));
    skip_blanks(r);
    return r->text[r->at] == 0 ? STATUS_OK : wrong(r, "an operator is due");
}

status formula_read(const char *text, formula **out, fault *f)
{
    *out = calloc(1, sizeof **out);
    if (*out == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a function of time");
    reader r = {.text = text, .to = *out, .f = f};
    const status outcome = read_all(&r);
    if (outcome != STATUS_OK) {
        formula_free(*out);
        *out = NULL;
    }
    return outcome;
}

void formula_free(formula *f)
{
    free(f);
}

/* g(x), with g' and g'' at its value. */
static jet chain(jet x, double g, double d, double dd)
{
    return (jet){g, d * x.d, dd * x.d * x.d + d * x.dd};
}

static jet product(jet a, jet b)
{
    return (jet){a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
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

static jet of_function(operation what, jet x)
{
    const double v = x.v;
    switch (what) {
    case SIN:
        return chain(x, sin(v), cos(v), -sin(v));
    case COS:
        return chain(x, cos(v), -sin(v), -cos(v));
    case TAN: {
        const double g = tan(v), d = 1 + g * g;
        return chain(x, g, d, 2 * g * d);
    }
    case ASIN: {
        const double s = 1 - v * v;
        return chain(x, asin(v), 1 / sqrt(s), v / (s * sqrt(s)));
    }
    case ACOS: {
        const double s = 1 - v * v;
        return chain(x, acos(v), -1 / sqrt(s), -v / (s * sqrt(s)));
    }
    case ATAN: {
        const double s = 1 + v * v;
        return chain(x, atan(v), 1 / s, -2 * v / (s * s));
    }
    case SINH:
        return chain(x, sinh(v), cosh(v), sinh(v));
    case COSH:
        return chain(x, cosh(v), sinh(v), cosh(v));
    case TANH: {
        const double g = tanh(v), d = 1 - g * g;
        return chain(x, g, d, -2 * g * d);
    }
    case EXP:
        return chain(x, exp(v), exp(v), exp(v));
    case LOG:
        return chain(x, log(v), 1 / v, -1 / (v * v));
    default: /* SQRT */
        return chain(x, sqrt(v), 0.5 / sqrt(v), -0.25 / (v * sqrt(v)));
    }
}

void formula_at(const formula *f, double t, double out[3])
{
    jet stack[DEEPEST + 1] = {{0, 0, 0}};
    int top = -1;
    for (int i = 0; i < f->count; i++) {
        const instruction *s = &f->step[i];
        if (s->what == NUMBER || s->what == TIME) {
            stack[++top] = s->what == TIME ? (jet){t, 1, 0} : (jet){s->number, 0, 0};
            continue;
        }
        jet *a = &stack[top];
        if (s->what == NEGATE) {
            *a = (jet){-a->v, -a->d, -a->dd};
            continue;
        }
        if (s->what >= SIN) {
            *a = of_function(s->what, *a);
            continue;
        }
        const jet b = *a;
        a = &stack[--top];
        if (s->what == ADD || s->what == SUBTRACT) {
            const double sign = s->what == ADD ? 1 : -1;
            *a = (jet){a->v + sign * b.v, a->d + sign * b.d, a->dd + sign * b.dd};
        } else if (s->what == MULTIPLY) {
            *a = product(*a, b);
        } else if (s->what == DIVIDE) {
            *a = product(*a, chain(b, 1 / b.v, -1 / (b.v * b.v), 2 / (b.v * b.v * b.v)));
        } else {
            *a = power(*a, b);
        }
    }
    out[0] = stack[0].v;
    out[1] = stack[0].d;
    out[2] = stack[0].dd;
}
