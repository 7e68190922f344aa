#include "cases/scene/scene.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"

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

/* An operation without t gives one number: its derivatives are zero, also where those of a function
 * are not finite. Returns 1: done. */
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

/* Reads arguments after "("; all of them are combined as they are read. */
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

int function_add(scene_function *to, double until, const char *text)
{
    scene_piece *longer = realloc(to->piece, ((size_t)to->pieces + 1) * sizeof *longer);
    if (longer == NULL)
        return -1;
    fault ignored;
    to->piece = longer;
    scene_piece *p = &to->piece[to->pieces];
    *p = (scene_piece){until, strdup(text), NULL};
    if (p->text == NULL)
        return -1;
    formula_read(text, &p->is, &ignored);
    to->pieces++;
    return 0;
}

void function_free(scene_function *f)
{
    for (int i = 0; i < f->pieces; i++) {
        free(f->piece[i].text);
        formula_free(f->piece[i].is);
    }
    free(f->piece);
    *f = (scene_function){0, NULL, 0};
}

int function_copy(scene_function *to, const scene_function *from)
{
    for (int i = 0; i < from->pieces; i++)
        if (function_add(to, from->piece[i].until, from->piece[i].text) < 0)
            return -1;
    to->scale = from->scale;
    return 0;
}

status function_check(const scene_function *s, fault *f)
{
    for (int i = 0; i < s->pieces; i++) {
        formula *again = NULL;
        if (s->piece[i].is == NULL) {
            TRY(formula_read(s->piece[i].text, &again, f));
            formula_free(again);
            return fault_set(f, STATUS_FAULT, "out of memory for a function of time");
        }
        if (i > 0 && i < s->pieces - 1 && !(s->piece[i].until > s->piece[i - 1].until))
            return fault_set(f, STATUS_REFUSED,
                             "a function of time in pieces: the end of piece %d, %g s, is not "
                             "behind that of the one before; sort them",
                             i + 1, s->piece[i].until);
    }
    return STATUS_OK;
}

void function_at(const scene_function *f, double t, double out[3])
{
    int i = 0;
    while (i < f->pieces - 1 && t >= f->piece[i].until)
        i++;
    formula_at(f->piece[i].is, t, out);
    for (int k = 0; k < 3 && f->scale != 0; k++)
        out[k] *= f->scale;
}

/* Instants of a piece at which it is examined: both ends, and between. */
enum { LOOKS = 64 };

static int is_finite(const double at[3], int derivatives)
{
    for (int k = 0; k <= derivatives; k++)
        if (!isfinite(at[k]))
            return 0;
    return 1;
}

int function_finite(const scene_function *f, double end, int derivatives, double *time)
{
    double from = 0, at[3];
    for (int i = 0; i < f->pieces && from <= end; i++) {
        const int last = i == f->pieces - 1;
        const double to = last ? end : fmin(end, f->piece[i].until);
        for (int k = 0; k <= LOOKS && from <= to; k++) {
            *time = k == LOOKS ? to : from + k * (to - from) / LOOKS;
            formula_at(f->piece[i].is, *time, at);
            if (!is_finite(at, derivatives))
                return 0;
        }
        from = last ? INFINITY : fmax(from, f->piece[i].until);
    }
    return 1;
}

int function_smooth(const scene_function *f, double end, double *time, int *derivative)
{
    static const double noise = 1e-9;
    for (int i = 0; i + 1 < f->pieces; i++) {
        double before[3], behind[3];
        *time = f->piece[i].until;
        if (*time <= 0 || *time >= end)
            continue;
        formula_at(f->piece[i].is, *time, before);
        formula_at(f->piece[i + 1].is, *time, behind);
        for (*derivative = 0; *derivative < 2; ++*derivative)
            if (fabs(before[*derivative] - behind[*derivative]) >
                noise * (1 + fabs(before[*derivative])))
                return 0;
    }
    return 1;
}

static double sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* The remainder with the sign of the divisor, as of an angle in turns. */
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

const expression_function *functions_find(const char *name, int length)
{
    for (int i = 0; i < FUNCTIONS; i++)
        if (strlen(all[i].name) == (size_t)length && memcmp(all[i].name, name, (size_t)length) == 0)
            return &all[i];
    return NULL;
}

const char *functions_name(int i)
{
    return i < FUNCTIONS ? all[i].name : NULL;
}
