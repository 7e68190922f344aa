#include "cases/scene/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/functions.h"

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

typedef struct formula_reader {
    const char *text;
    int at, depth; /* depth: of the stack; nested: of parentheses */
    int nested;
    formula *to;
    formula_mistake *mistake;
} formula_reader;

static status wrong(const formula_reader *r, const char *what)
{
    r->mistake->at = r->at;
    r->mistake->what = what;
    return STATUS_REFUSED;
}

static void skip_blanks(formula_reader *r)
{
    while (isspace((unsigned char)r->text[r->at]))
        r->at++;
}

static int takes(formula_reader *r, char sign)
{
    skip_blanks(r);
    if (r->text[r->at] != sign)
        return 0;
    r->at++;
    return 1;
}

/* What no t enters is one number: its derivatives are zero, also where those of a function are not
 * finite. 1: done. */
static int is_constant(formula_reader *r, jet_operation what, int grows)
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
static status emit(formula_reader *r, jet_operation what, double number, int grows)
{
    const instruction *last = r->to->count > 0 ? &r->to->step[r->to->count - 1] : NULL;
    if (what == JET_DIVIDE && last != NULL && last->what == JET_NUMBER && last->number == 0)
        return wrong(r, "division by zero; correct what stands before it");
    if (is_constant(r, what, grows))
        return isfinite(r->to->step[r->to->count - 1].number)
                   ? STATUS_OK
                   : wrong(r, "what stands before it has no finite value; correct it");
    if (r->to->count == MOST)
        return wrong(r, "too long; split it into pieces");
    r->to->step[r->to->count++] = (instruction){what, number};
    r->depth += grows;
    if (r->depth > r->to->deepest)
        r->to->deepest = r->depth;
    return r->depth < DEEPEST ? STATUS_OK : wrong(r, "too deeply nested");
}

static status read_sum(formula_reader *r);

/* The step last written is one number: its value; else NULL, t enters. */
static const double *constant_from(const formula_reader *r, int first)
{
    const instruction *step = &r->to->step[first];
    return r->to->count == first + 1 && step->what == JET_NUMBER ? &step->number : NULL;
}

/* Of numbers, behind "(": all are taken together as they are read. */
static status read_arguments(formula_reader *r, const expression_function *f, int word)
{
    int count = 0;
    do {
        const int first = r->to->count;
        TRY(read_sum(r));
        const double *given = constant_from(r, first);
        if (given == NULL && f->in_time == JET_NUMBER) {
            r->at = word;
            return wrong(
                r, !f->kinked ? "it is of numbers only, and t is in it; write it with atan or sqrt"
                              : "it makes kinks, where steps must end; give pieces instead");
        }
        if (count++ == 0)
            continue;
        double *before = &r->to->step[first - 1].number;
        *before = f->of_two != NULL ? f->of_two(*before, *given) : *before;
        r->to->count--;
        r->depth--;
    } while (takes(r, ','));
    if (!takes(r, ')'))
        return wrong(r, "missing )");
    if (f->arguments < 0 ? count < 2 : count != f->arguments)
        return wrong(r, "too few or too many arguments; see 'beamwork scene --keys'");
    return STATUS_OK;
}

static status read_function(formula_reader *r, const expression_function *f, int word)
{
    if (!takes(r, '('))
        return wrong(r, "a function needs its argument in parentheses");
    TRY(read_arguments(r, f, word));
    if (f->in_time != JET_NUMBER)
        return emit(r, f->in_time, 0, 0);
    double *number = &r->to->step[r->to->count - 1].number;
    *number = f->of_one != NULL ? f->of_one(*number) : *number;
    return isfinite(*number) ? STATUS_OK
                             : wrong(r, "what stands before it has no finite value; correct it");
}

static status read_word(formula_reader *r)
{
    const int first = r->at;
    int length = 0;
    while (isalnum((unsigned char)r->text[first + length]) || r->text[first + length] == '_')
        length++;
    const expression_function *f = functions_find(r->text + first, length);
    const int is_time = length == 1 && r->text[first] == 't';
    if (f == NULL && !is_time)
        return wrong(r,
                     "no such name; there are t, pi, deg, and functions as sin, cosh, exp, sqrt");
    r->at += length;
    if (is_time)
        return emit(r, JET_TIME, 0, 1);
    return f->arguments == 0 ? emit(r, JET_NUMBER, f->value, 1) : read_function(r, f, first);
}

/* Decimal. */
static status read_number(formula_reader *r)
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

static status read_atom(formula_reader *r)
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

static status read_signed(formula_reader *r);

static status read_power(formula_reader *r)
{
    TRY(read_atom(r));
    if (!takes(r, '^'))
        return STATUS_OK;
    TRY(read_signed(r));
    return emit(r, JET_POWER, 0, -1);
}

/* A sign binds weaker than ^. */
static status read_signed(formula_reader *r)
{
    if (++r->nested > DEEPEST)
        return wrong(r, "too deeply nested");
    const int minus = takes(r, '-'), plus = !minus && takes(r, '+');
    TRY(minus || plus ? read_signed(r) : read_power(r));
    r->nested--;
    return minus ? emit(r, JET_NEGATE, 0, 0) : STATUS_OK;
}

static status read_product(formula_reader *r)
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

static status read_sum(formula_reader *r)
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

static status read_all(formula_reader *r)
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
    formula_reader r = {.text = text, .to = *out, .mistake = mistake};
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
