#include "cases/scene/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/jet.h"
#include "elements/math/pi.h"

enum { MOST = 256, DEEPEST = 32 };

typedef struct instruction {
    jet_operation what;
    double number;
} instruction;

/* In the order in which they are carried out, on a stack. */
struct formula {
    int count, deepest;
    instruction step[MOST];
};

typedef struct reader {
    const char *text;
    int at, depth; /* depth: of the stack; nested: of parentheses */
    int nested;
    formula *to;
    formula_mistake *mistake;
} reader;

static status wrong(const reader *r, const char *what)
{
    r->mistake->at = r->at;
    r->mistake->what = what;
    return STATUS_REFUSED;
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

/* What no t enters is one number: its derivatives are zero, also where those of a function are not
 * finite. 1: done. */
static int is_constant(reader *r, jet_operation what, int grows)
{
    const int values = grows < 0 ? 2 : 1, first = r->to->count - values;
    if (grows > 0 || first < 0)
        return 0;
    instruction *of = &r->to->step[first];
    if (of[0].what != JET_NUMBER || of[values - 1].what != JET_NUMBER)
        return 0;
    of->number = jet_of(what, (jet){of[0].number, 0, 0}, (jet){of[values - 1].number, 0, 0}).v;
    r->to->count = first + 1;
    r->depth += grows;
    return 1;
}

/* grows: values more on the stack. */
static status emit(reader *r, jet_operation what, double number, int grows)
{
    const instruction *last = r->to->count > 0 ? &r->to->step[r->to->count - 1] : NULL;
    if (what == JET_DIVIDE && last != NULL && last->what == JET_NUMBER && last->number == 0)
        return wrong(r, "division by zero; mend what stands before it");
    if (is_constant(r, what, grows))
        return isfinite(r->to->step[r->to->count - 1].number)
                   ? STATUS_OK
                   : wrong(r, "what stands before it has no finite value; mend it");
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
    jet_operation what;
} functions[] = {{"sin", JET_SIN},   {"cos", JET_COS},   {"tan", JET_TAN},   {"asin", JET_ASIN},
                 {"acos", JET_ACOS}, {"atan", JET_ATAN}, {"sinh", JET_SINH}, {"cosh", JET_COSH},
                 {"tanh", JET_TANH}, {"exp", JET_EXP},   {"log", JET_LOG},   {"sqrt", JET_SQRT}};

/* Of the language of scene files, and not of time. */
static const char *const kinked[] = {"abs", "sign", "min", "max", "floor", "ceil", "mod"};

static status read_function(reader *r, jet_operation what)
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
        return emit(r, JET_TIME, 0, 1);
    }
    if (length == 2 && strncmp(word, "pi", 2) == 0) {
        r->at += length;
        return emit(r, JET_NUMBER, PI, 1);
    }
    if (length == 3 && strncmp(word, "deg", 3) == 0) {
        r->at += length;
        return emit(r, JET_NUMBER, PI / 180, 1);
    }
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
        if ((int)strlen(functions[i].name) == length &&
            strncmp(functions[i].name, word, (size_t)length) == 0) {
            r->at += length;
            return read_function(r, functions[i].what);
        }
    for (size_t i = 0; i < sizeof kinked / sizeof kinked[0]; i++)
        if ((int)strlen(kinked[i]) == length && strncmp(kinked[i], word, (size_t)length) == 0)
            return wrong(r, "it makes kinks, where steps must end; give pieces instead");
    return wrong(r, "no such name; there are t, pi, deg, sin, cos, tan, asin, acos, atan, sinh, "
                    "cosh, tanh, exp, log, sqrt");
}

/* Decimal. */
static status read_number(reader *r)
{
    const char *from = r->text + r->at;
    char *end;
    const double number = strtod(from, &end);
    if (end == from || (from[0] == '0' && (from[1] == 'x' || from[1] == 'X')))
        return wrong(r, "not a decimal number");
    if (!isfinite(number))
        return wrong(r, "a number that is too large; the largest is 1.8e308");
    r->at += (int)(end - from);
    if (isalpha((unsigned char)*end) || *end == '_')
        return wrong(r, "a name behind a number; put * between them, values are SI without units: "
                        "20e-3 for 20 mm, 45*deg for degrees");
    return emit(r, JET_NUMBER, number, 1);
}

static status read_atom(reader *r)
{
    skip_blanks(r);
    const char *from = r->text + r->at;
    if (takes(r, '(')) {
        TRY(read_sum(r));
        return takes(r, ')') ? STATUS_OK : wrong(r, "missing )");
    }
    if (isdigit((unsigned char)*from) || *from == '.')
        return read_number(r);
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
    return emit(r, JET_POWER, 0, -1);
}

/* A sign binds weaker than ^. */
static status read_signed(reader *r)
{
    if (++r->nested > DEEPEST)
        return wrong(r, "too deeply nested");
    const int minus = takes(r, '-'), plus = !minus && takes(r, '+');
    TRY(minus || plus ? read_signed(r) : read_power(r));
    r->nested--;
    return minus ? emit(r, JET_NEGATE, 0, 0) : STATUS_OK;
}

static status read_product(reader *r)
{
    TRY(read_signed(r));
    for (;;) {
        const int times = takes(r, '*'), over = !times && takes(r, '/');
        if (!times && !over)
            return STATUS_OK;
        TRY(read_signed(r));
        TRY(emit(r, times ? JET_MULTIPLY : JET_DIVIDE, 0, -1));
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
        TRY(emit(r, plus ? JET_ADD : JET_SUBTRACT, 0, -1));
    }
}

static status read_all(reader *r)
{
    TRY(read_sum(r));
    skip_blanks(r);
    return r->text[r->at] == 0 ? STATUS_OK : wrong(r, "an operator is due");
}

status formula_parse(const char *text, formula **out, formula_mistake *mistake)
{
    *out = calloc(1, sizeof **out);
    *mistake = (formula_mistake){0, "out of memory for a function of time"};
    if (*out == NULL)
        return STATUS_FAULT;
    reader r = {.text = text, .to = *out, .mistake = mistake};
    const status outcome = read_all(&r);
    if (outcome != STATUS_OK) {
        formula_free(*out);
        *out = NULL;
    }
    return outcome;
}

status formula_read(const char *text, formula **out, fault *f)
{
    formula_mistake mistake;
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
    jet stack[DEEPEST + 1] = {{0, 0, 0}};
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
