/* Expressions are converted to operations on a stack of values with their time derivatives. Parts
 * without t are evaluated during the conversion. */
#include "cases/scene/scene.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"

typedef struct jet {
    double v, d, dd;
} jet;

typedef enum jet_operation {
    JET_NUMBER, /* a constant */
    JET_TIME,
    JET_NEGATE,
    JET_ADD, /* operations on two values, up to JET_POWER */
    JET_SUBTRACT,
    JET_MULTIPLY,
    JET_DIVIDE,
    JET_POWER,
    JET_SIN, /* functions of one value, up to JET_SQRT */
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

/* Returns the jet of g(x) from g and its derivatives d = g' and dd = g'' at the value of x. */
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

/* Applies the operation to a and, if it has two operands, to b. The operation must not be
 * JET_NUMBER or JET_TIME. */
static jet jet_of(jet_operation what, jet a, jet b)
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

typedef struct expression_function {
    const char *name;
    int arguments; /* number of arguments; 0 for a constant, -1 for two or more */
    double value;  /* value of a constant */
    double (*of_one)(double);
    double (*of_two)(double, double); /* for two or more arguments: applied repeatedly */
    int kinked;
    jet_operation in_time;
} expression_function;

static double sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* Returns the remainder with the sign of the divisor. */
static double modulo(double x, double y)
{
    const double rest = fmod(x, y);
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}

static const expression_function all[] = {
    {.name = "pi", .value = PI},
    {.name = "deg", .value = PI / 180},
    {.name = "abs", .arguments = 1, .of_one = fabs, .kinked = 1},
    {.name = "sign", .arguments = 1, .of_one = sign_of, .kinked = 1},
    {.name = "sqrt", .arguments = 1, .of_one = sqrt, .in_time = JET_SQRT},
    {.name = "exp", .arguments = 1, .of_one = exp, .in_time = JET_EXP},
    {.name = "log", .arguments = 1, .of_one = log, .in_time = JET_LOG},
    {.name = "sin", .arguments = 1, .of_one = sin, .in_time = JET_SIN},
    {.name = "cos", .arguments = 1, .of_one = cos, .in_time = JET_COS},
    {.name = "tan", .arguments = 1, .of_one = tan, .in_time = JET_TAN},
    {.name = "asin", .arguments = 1, .of_one = asin, .in_time = JET_ASIN},
    {.name = "acos", .arguments = 1, .of_one = acos, .in_time = JET_ACOS},
    {.name = "atan", .arguments = 1, .of_one = atan, .in_time = JET_ATAN},
    {.name = "sinh", .arguments = 1, .of_one = sinh, .in_time = JET_SINH},
    {.name = "cosh", .arguments = 1, .of_one = cosh, .in_time = JET_COSH},
    {.name = "tanh", .arguments = 1, .of_one = tanh, .in_time = JET_TANH},
    {.name = "floor", .arguments = 1, .of_one = floor, .kinked = 1},
    {.name = "ceil", .arguments = 1, .of_one = ceil, .kinked = 1},
    {.name = "atan2", .arguments = 2, .of_two = atan2},
    {.name = "hypot", .arguments = 2, .of_two = hypot},
    {.name = "mod", .arguments = 2, .of_two = modulo, .kinked = 1},
    {.name = "min", .arguments = -1, .of_two = fmin, .kinked = 1},
    {.name = "max", .arguments = -1, .of_two = fmax, .kinked = 1},
};
enum { FUNCTIONS = sizeof all / sizeof all[0] };

static const expression_function *function_of(const char *name, size_t length)
{
    for (int i = 0; i < FUNCTIONS; i++)
        if (strlen(all[i].name) == length && memcmp(all[i].name, name, length) == 0)
            return &all[i];
    return NULL;
}

const char *expression_word(int i)
{
    return i < FUNCTIONS ? all[i].name : NULL;
}

int expression_is_word(const char *name, size_t length)
{
    return function_of(name, length) != NULL;
}

size_t expression_name_length(const char *text)
{
    static const char digits[] = "0123456789",
                      letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                  "0123456789";
    return strspn(text, digits) > 0 ? 0 : strspn(text, letters);
}

enum { MOST = 256, DEEPEST = 60, HIGHEST = 32, NUMBER_TEXT = 64 };

typedef struct instruction {
    jet_operation what;
    double number;
} instruction;

struct formula {
    int count;
    instruction step[MOST];
};

typedef struct reader {
    const char *text;
    int at, end;
    int nested, depth; /* nesting depth of parentheses, signs and powers, and depth of the stack */
    int in_time;
    expression_name *find;
    const void *names;
    formula *to;
    expression_mistake *mistake;
} reader;

status expression_wrong(expression_mistake *m, int at, const char *of, ...)
{
    va_list list;
    va_start(list, of);
    m->at = at;
    vsnprintf(m->what, sizeof m->what, of, list);
    va_end(list);
    return STATUS_REFUSED;
}

#define WRONG(r, place, ...) expression_wrong((r)->mistake, place, __VA_ARGS__)

static char here(reader *r)
{
    while (r->at < r->end && isspace((unsigned char)r->text[r->at]))
        r->at++;
    return r->at < r->end ? r->text[r->at] : '\0';
}

static int takes(reader *r, char sign)
{
    if (here(r) != sign)
        return 0;
    r->at++;
    return 1;
}

static status wrong_nested(const reader *r)
{
    return WRONG(r, r->at,
                 "the expression is nested too deeply; simplify it, or compute parts with 'let'");
}

static status emit(reader *r, jet_operation what, double number, int grows)
{
    if (r->to->count == MOST)
        return WRONG(r, r->at,
                     "the expression has too many operations; simplify it, or compute parts with "
                     "'let'");
    r->to->step[r->to->count++] = (instruction){what, number};
    r->depth += grows;
    return !r->in_time || r->depth < HIGHEST ? STATUS_OK : wrong_nested(r);
}

/* Returns the address of the last value if it is a single number, or NULL if it depends on t.
 * `first` is the index of its first operation. */
static double *number_from(const reader *r, int first)
{
    instruction *step = &r->to->step[first];
    return r->to->count == first + 1 && step->what == JET_NUMBER ? &step->number : NULL;
}

static double of_numbers(jet_operation what, double a, double b)
{
    switch (what) {
    case JET_ADD:
        return a + b;
    case JET_SUBTRACT:
        return a - b;
    case JET_MULTIPLY:
        return a * b;
    case JET_DIVIDE:
        return a / b;
    default:
        return pow(a, b);
    }
}

/* Applies an operation to the last two values, which begin at the operations `left` and `right`.
 * `place` is the position of the operation in the text. */
static status operate(reader *r, jet_operation what, int place, int left, int right)
{
    const double *b = number_from(r, right);
    if (what == JET_DIVIDE && b != NULL && *b == 0)
        return WRONG(r, place, "division by zero; correct the divisor");
    if (b == NULL || left != right - 1 || r->to->step[left].what != JET_NUMBER)
        return emit(r, what, 0, -1);
    double *a = &r->to->step[left].number;
    const double base = *a, value = of_numbers(what, base, *b);
    r->to->count--;
    r->depth--;
    *a = value;
    if (isfinite(value))
        return STATUS_OK;
    return what == JET_POWER
               ? WRONG(r, place, "%g^%g has no value; correct the base or the exponent", base, *b)
               : WRONG(r, place, "the result is too large for a number; correct the values");
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Returns the number of characters of the number at the start of the text. A point that is followed
 * by another point does not belong to the number. */
static int number_length(const char *text, int most)
{
    int n = 0;
    while (n < most && is_digit(text[n]))
        n++;
    if (n < most && text[n] == '.' && !(n + 1 < most && text[n + 1] == '.'))
        for (n++; n < most && is_digit(text[n]); n++)
            ;
    if (n < most && (text[n] == 'e' || text[n] == 'E')) {
        int more = n + 1;
        more += more < most && (text[more] == '+' || text[more] == '-');
        if (more < most && is_digit(text[more]))
            for (n = more; n < most && is_digit(text[n]); n++)
                ;
    }
    return n;
}

static status read_literal(reader *r)
{
    const int from = r->at, length = number_length(r->text + from, r->end - from);
    char digits[NUMBER_TEXT];
    if (length == 0 || (length == 1 && !is_digit(r->text[from])))
        return WRONG(r, from, "a decimal point has no digits; write a number");
    if (length >= NUMBER_TEXT)
        return WRONG(r, from, "the number has more than 60 characters; shorten it");
    memcpy(digits, r->text + from, (size_t)length);
    digits[length] = '\0';
    errno = 0;
    const double value = strtod(digits, NULL);
    r->at += length;
    if (errno == ERANGE && fabs(value) < 1)
        return WRONG(r, from, "'%s' is too small; write 0, or at least 2.3e-308", digits);
    if (!isfinite(value))
        return WRONG(r, from, "'%s' is too large; the largest number is 1.8e308", digits);
    if (here(r) != '\0' && expression_name_length(r->text + r->at) > 0)
        return WRONG(r, r->at,
                     "'%.20s' follows a number; numbers have no unit: write 20 mm as 20e-3 (with "
                     "'units: mm, N, MPa' as 20), 45 degrees as 45*deg, and * between factors",
                     r->text + r->at);
    return emit(r, JET_NUMBER, value, 1);
}

static status read_sum(reader *r);

static status read_arguments(reader *r, const expression_function *f, int word, int *count)
{
    do {
        const int first = r->to->count;
        TRY(read_sum(r));
        const double *given = number_from(r, first);
        if (given == NULL && f->in_time == JET_NUMBER)
            return WRONG(
                r, word, "%s accepts only numbers, but its argument contains t; %s", f->name,
                f->kinked
                    ? "give 'pieces', because time steps must end at the kinks of this function"
                    : "write it with atan or sqrt");
        if ((*count)++ == 0 || given == NULL)
            continue;
        double *before = &r->to->step[first - 1].number;
        *before = f->of_two != NULL ? f->of_two(*before, *given) : *before;
        r->to->count--;
        r->depth--;
    } while (takes(r, ','));
    return takes(r, ')') ? STATUS_OK
                         : WRONG(r, r->at, "the arguments of %s are not closed; add ')'", f->name);
}

static status read_call(reader *r, const expression_function *f, int word)
{
    static const char *const several[] = {"no argument", "one argument", "two arguments"};
    const int first = r->to->count;
    int count = 0;
    TRY(read_arguments(r, f, word, &count));
    if (f->arguments < 0 ? count < 2 : count != f->arguments)
        return WRONG(r, word, "%s takes %s, not %d", f->name,
                     f->arguments < 0 ? "two or more arguments" : several[f->arguments], count);
    double *number = number_from(r, first);
    if (number == NULL)
        return emit(r, f->in_time, 0, 0);
    *number = f->of_one != NULL ? f->of_one(*number) : *number;
    return isfinite(*number)
               ? STATUS_OK
               : WRONG(r, word, "%s has no value for its arguments; correct them", f->name);
}

static status read_name(reader *r)
{
    const int from = r->at;
    const size_t length = expression_name_length(r->text + from);
    const char *behind = r->text + from + length;
    double value;
    const int dotted = *behind == '.' && expression_name_length(behind + 1) > 0;
    const expression_function *f = dotted ? NULL : function_of(r->text + from, length);
    if (f == NULL && r->in_time && length == 1 && r->text[from] == 't') {
        r->at++;
        return emit(r, JET_TIME, 0, 1);
    }
    if (f == NULL && r->find == NULL)
        return WRONG(r, from,
                     "the name '%.*s' is unknown; give one of %spi, deg, and functions such "
                     "as sin, cosh, exp, sqrt",
                     (int)length, r->text + from, r->in_time ? "t, " : "");
    if (f == NULL)
        return r->find(r->names, r->text, &r->at, &value, r->mistake)
                   ? emit(r, JET_NUMBER, value, 1)
                   : STATUS_REFUSED;
    r->at += (int)length;
    if (f->arguments == 0)
        return emit(r, JET_NUMBER, f->value, 1);
    return takes(r, '(') ? read_call(r, f, from)
                         : WRONG(r, from, "%s is a function; write %s(...)", f->name, f->name);
}

static status read_primary(reader *r)
{
    const char c = here(r);
    const int from = r->at;
    if (is_digit(c) || c == '.')
        return read_literal(r);
    if (takes(r, '(')) {
        TRY(read_sum(r));
        return takes(r, ')') ? STATUS_OK : WRONG(r, from, "'(' is not closed; add ')'");
    }
    if (c != '\0' && expression_name_length(r->text + from) > 0)
        return read_name(r);
    return c == '\0'
               ? WRONG(r, from,
                       "the expression ends where a number, a name or '(' is expected; complete it")
               : WRONG(r, from, "found '%c' where a number, a name or '(' is expected; correct it",
                       c >= ' ' ? c : '?');
}

static status deeper(reader *r)
{
    return ++r->nested <= DEEPEST ? STATUS_OK : wrong_nested(r);
}

static status read_signed(reader *r);

static status read_power(reader *r)
{
    const int left = r->to->count;
    TRY(read_primary(r));
    if (here(r) != '^')
        return STATUS_OK;
    const int place = r->at++, right = r->to->count;
    TRY(deeper(r));
    TRY(read_signed(r));
    r->nested--;
    return operate(r, JET_POWER, place, left, right);
}

static status read_signed(reader *r)
{
    const int minus = takes(r, '-'), first = r->to->count;
    if (!minus && !takes(r, '+'))
        return read_power(r);
    TRY(deeper(r));
    TRY(read_signed(r));
    r->nested--;
    double *number = number_from(r, first);
    if (minus && number == NULL)
        return emit(r, JET_NEGATE, 0, 0);
    if (minus)
        *number = -*number;
    return STATUS_OK;
}

static status read_terms(reader *r, const char sign[2], const jet_operation what[2],
                         status (*term)(reader *))
{
    const int left = r->to->count;
    TRY(term(r));
    for (char c = here(r); c == sign[0] || c == sign[1]; c = here(r)) {
        const int place = r->at++, right = r->to->count;
        TRY(term(r));
        TRY(operate(r, what[c == sign[1]], place, left, right));
    }
    return STATUS_OK;
}

static status read_product(reader *r)
{
    static const jet_operation what[2] = {JET_MULTIPLY, JET_DIVIDE};
    return read_terms(r, "*/", what, read_signed);
}

static status read_sum(reader *r)
{
    static const jet_operation what[2] = {JET_ADD, JET_SUBTRACT};
    TRY(deeper(r));
    TRY(read_terms(r, "+-", what, read_product));
    r->nested--;
    return STATUS_OK;
}

static status read_all(reader *r)
{
    TRY(read_sum(r));
    const char rest = here(r);
    if (rest == '\0')
        return STATUS_OK;
    return rest == '.'
               ? WRONG(r, r->at, "this is a range; give one number")
               : WRONG(r, r->at,
                       "'%.20s' follows a complete expression; add an operator, or remove it",
                       r->text + r->at);
}

status expression_value(const char *text, int from, int end, expression_name *find,
                        const void *names, double *out, expression_mistake *mistake)
{
    formula steps;
    reader r = {text, from, end, 0, 0, 0, find, names, &steps, mistake};
    steps.count = 0;
    TRY(read_all(&r));
    *out = steps.step[0].number;
    return STATUS_OK;
}

status formula_parse(const char *text, formula **out, expression_mistake *mistake)
{
    *out = calloc(1, sizeof **out);
    if (*out == NULL) {
        expression_wrong(mistake, 0, "out of memory for a function of time");
        return STATUS_FAULT;
    }
    reader r = {text, 0, (int)strlen(text), 0, 0, 1, NULL, NULL, *out, mistake};
    const status outcome = read_all(&r);
    if (outcome != STATUS_OK) {
        formula_free(*out);
        *out = NULL;
    }
    return outcome;
}

status formula_read(const char *text, formula **out, fault *f)
{
    expression_mistake mistake;
    const status outcome = formula_parse(text, out, &mistake);
    if (outcome == STATUS_FAULT)
        return fault_set(f, outcome, "%s", mistake.what);
    if (outcome != STATUS_OK)
        return fault_set(f, outcome, "function of time \"%.100s\", character %d: %s", text,
                         mistake.at + 1, mistake.what);
    return STATUS_OK;
}

void formula_free(formula *f)
{
    free(f);
}

void formula_at(const formula *f, double t, double out[3])
{
    jet stack[HIGHEST + 1] = {{0, 0, 0}};
    int top = -1;
    for (int i = 0; i < f->count; i++) {
        const instruction *s = &f->step[i];
        if (s->what == JET_NUMBER || s->what == JET_TIME) {
            stack[++top] = s->what == JET_TIME ? (jet){t, 1, 0} : (jet){s->number, 0, 0};
            continue;
        }
        const jet right = stack[top];
        if (s->what >= JET_ADD && s->what <= JET_POWER)
            top--;
        stack[top] = jet_of(s->what, stack[top], right);
    }
    out[0] = stack[0].v;
    out[1] = stack[0].d;
    out[2] = stack[0].dd;
}
