#include "cases/format/format_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

enum { DEEPEST = 60, NUMBER_TEXT = 64 };

typedef struct parser {
    const document_node *node;
    const char *text; /* whole */
    int at, end;      /* place in it; where the expression ends */
    int depth, failed;
    const scope *names;
    mistakes *mistakes;
} parser;

static double sum(parser *p);

/* The first mistake ends the expression. */
#define FAIL(p, offset, ...)                                                                       \
    do {                                                                                           \
        if (!(p)->failed)                                                                          \
            document_mistake((p)->mistakes, (p)->node, (offset), __VA_ARGS__);                     \
        (p)->failed = 1;                                                                           \
    } while (0)

static char here(parser *p)
{
    while (p->at < p->end && p->text[p->at] == ' ')
        p->at++;
    return p->at < p->end ? p->text[p->at] : '\0';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Digits, a point that is not the first of "..", digits, an exponent. */
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

static double literal(parser *p)
{
    const int from = p->at, length = number_length(p->text + from, p->end - from);
    char digits[NUMBER_TEXT];
    if (length == 1 && !is_digit(p->text[from])) {
        FAIL(p, from, "a point without digits; write a number");
        return 0;
    }
    if (length >= NUMBER_TEXT) {
        FAIL(p, from, "a number of more than 60 characters; shorten it");
        return 0;
    }
    memcpy(digits, p->text + from, (size_t)length);
    digits[length] = '\0';
    errno = 0;
    const double value = strtod(digits, NULL);
    p->at += length;
    if (errno == ERANGE && fabs(value) < 1)
        FAIL(p, from, "'%s' is too small; write 0, or at least 2.3e-308", digits);
    else if (!isfinite(value))
        FAIL(p, from, "'%s' is too large; the largest number is 1.8e308", digits);
    else if (here(p) != '\0' && scope_name_length(p->text + p->at) > 0)
        FAIL(p, p->at,
             "'%.20s' behind a number; values are SI without units: write 20e-3 for 20 mm, "
             "45*deg for degrees, and * between factors",
             p->text + p->at);
    return value;
}

/* Arguments of a function after its "(", and the ")". */
static double call(parser *p, const expression_function *f, int from)
{
    double value = 0;
    int count = 0;
    do {
        p->at++;
        const double one = sum(p);
        value = count == 0 || f->of_two == NULL ? one : f->of_two(value, one);
        count++;
        if (f->of_one != NULL)
            value = f->of_one(one);
    } while (!p->failed && here(p) == ',');
    if (!p->failed && here(p) != ')')
        FAIL(p, p->at, "the arguments of %s are not closed; put ')'", f->name);
    p->at++;
    static const char *const several[] = {"no argument", "one argument", "two arguments"};
    if (f->arguments < 0 ? count < 2 : count != f->arguments)
        FAIL(p, from, "%s takes %s, not %d", f->name,
             f->arguments < 0 ? "two arguments or more" : several[f->arguments], count);
    else if (!isfinite(value))
        FAIL(p, from, "%s has no value there; look at its arguments", f->name);
    return value;
}

static void tell_unknown(parser *p, const char *name, int from)
{
    char remedy[FAULT_TEXT];
    FAIL(p, from, "unknown name '%s'%s", name,
         mistakes_remedy(scope_nearest(p->names, name),
                         "; define it under 'parameters' or 'let', above", remedy));
}

/* SECTION.CONSTANT; `length` of the section's name with its point. */
static double constant(parser *p, int length)
{
    const int from = p->at, behind = from + length;
    const int rest = (int)scope_name_length(p->text + behind);
    const scope *known = scope_find(p->names, p->text + from, (size_t)length);
    const int index = section_names_index(p->text + behind, (size_t)rest);
    p->at = behind + rest;
    if (known == NULL)
        FAIL(p, from,
             "no section '%.*s' is known here; sections are named behind the list of "
             "sections only",
             length - 1 < 40 ? length - 1 : 40, p->text + from);
    else if (index < 0)
        FAIL(p, behind, "a section has no constant '%.*s'; it has %s", rest < 40 ? rest : 40,
             p->text + behind, section_names_all);
    else if (isnan(known->constants[index])) /* its own mistake is already reported */
        p->failed = 1;
    return known != NULL && index >= 0 ? known->constants[index] : 0;
}

static double named(parser *p)
{
    const int from = p->at;
    int length = (int)scope_name_length(p->text + from);
    if (p->text[from + length] == '.' && scope_name_length(p->text + from + length + 1) > 0)
        return constant(p, length + 1);
    length = length < p->end - from ? length : p->end - from;
    char name[NUMBER_TEXT];
    const size_t kept = length < NUMBER_TEXT ? (size_t)length : NUMBER_TEXT - 1;
    memcpy(name, p->text + from, kept);
    name[kept] = '\0';
    p->at += length;
    const expression_function *f = functions_find(p->text + from, length);
    const scope *known = scope_find(p->names, p->text + from, (size_t)length);
    if (f != NULL && f->arguments == 0)
        return f->value;
    if (f != NULL && here(p) == '(')
        return call(p, f, from);
    if (f != NULL)
        FAIL(p, from, "%s is a function; write %s(...)", name, name);
    else if (here(p) == '(' || known == NULL)
        tell_unknown(p, name, from);
    else if (isnan(known->number)) /* its own mistake is already reported */
        p->failed = 1;
    else if (known->word != NULL)
        FAIL(p, from, "'%s' is a choice of words ('%.40s'), not a number", name, known->word);
    return known != NULL ? known->number : 0;
}

static double primary(parser *p)
{
    const char c = here(p);
    if (is_digit(c) || c == '.')
        return literal(p);
    if (c == '(') {
        const int from = p->at++;
        const double value = sum(p);
        if (!p->failed && here(p) != ')')
            FAIL(p, from, "'(' is not closed; put ')'");
        p->at++;
        return value;
    }
    if (c != '\0' && scope_name_length(p->text + p->at) > 0)
        return named(p);
    if (c == '\0')
        FAIL(p, p->at, "the expression ends where a number, name or '(' is expected");
    else
        FAIL(p, p->at, "'%c' where a number, name or '(' is expected", c >= ' ' ? c : '?');
    return 0;
}

static double power(parser *p);

static double signed_power(parser *p)
{
    const char c = here(p);
    if (c != '-' && c != '+')
        return power(p);
    p->at++;
    if (++p->depth > DEEPEST)
        FAIL(p, p->at, "too many signs or parentheses in one another; split it with 'let'");
    const double value = p->failed ? 0 : signed_power(p);
    p->depth--;
    return c == '-' ? -value : value;
}

static double power(parser *p)
{
    const double base = primary(p);
    if (p->failed || here(p) != '^')
        return base;
    const int at = p->at++;
    if (++p->depth > DEEPEST)
        FAIL(p, at, "too many powers of powers; split it with 'let'");
    const double exponent = p->failed ? 0 : signed_power(p), value = pow(base, exponent);
    p->depth--;
    if (!p->failed && !isfinite(value))
        FAIL(p, at, "%g^%g has no value", base, exponent);
    return value;
}

static double product(parser *p)
{
    double value = signed_power(p);
    for (char c = here(p); !p->failed && (c == '*' || c == '/'); c = here(p)) {
        const int at = p->at++;
        const double factor = signed_power(p);
        if (c == '/' && factor == 0 && !p->failed)
            FAIL(p, at, "division by zero");
        value = c == '*' ? value * factor : value / factor;
        if (!isfinite(value))
            FAIL(p, at, "the result is too large for a number");
    }
    return value;
}

static double sum(parser *p)
{
    if (++p->depth > DEEPEST) {
        FAIL(p, p->at, "too many parentheses in one another; split it with 'let'");
        return 0;
    }
    double value = product(p);
    for (char c = here(p); !p->failed && (c == '+' || c == '-'); c = here(p)) {
        const int at = p->at++;
        const double term = product(p);
        value = c == '+' ? value + term : value - term;
        if (!isfinite(value))
            FAIL(p, at, "the result is too large for a number");
    }
    p->depth--;
    return value;
}

int expression_part(const document_node *n, int from, int length, const scope *names, mistakes *m,
                    double *out)
{
    parser p = {.node = n,
                .text = n->text,
                .at = from,
                .end = from + length,
                .names = names,
                .mistakes = m};
    *out = sum(&p);
    const char rest = here(&p);
    if (!p.failed && rest == '.')
        FAIL(&p, p.at, "a range where one number is expected");
    else if (!p.failed && rest != '\0')
        FAIL(&p, p.at, "'%.20s' behind the expression; is an operator missing?", n->text + p.at);
    return !p.failed;
}

int expression_number(const document_node *n, const scope *names, mistakes *m, double *out)
{
    *out = 0;
    if (n->kind == DOCUMENT_TEXT)
        return expression_part(n, 0, (int)strlen(n->text), names, m, out);
    document_mistake(m, n, 0, "a %s where one number is expected",
                     n->kind == DOCUMENT_LIST ? "list" : "map");
    return 0;
}

int expression_vector(const document_node *n, int count, const scope *names, mistakes *m,
                      double out[])
{
    int good = 1;
    memset(out, 0, (size_t)count * sizeof *out);
    if (n->kind != DOCUMENT_LIST || n->count != count) {
        document_mistake(m, n, 0, "a list of %d numbers is expected: [a, b, ...]", count);
        return 0;
    }
    for (int i = 0; i < count; i++)
        good &= expression_number(n->item[i], names, m, &out[i]);
    return good;
}

enum { MOST = 10000 };

/* Where a text stands outside parentheses, after `from`; the last such place; -1: nowhere. */
static int find_outside(const char *text, int from, const char *what)
{
    int depth = 0, found = -1;
    for (int i = from; text[i] != '\0'; i++) {
        depth += (text[i] == '(') - (text[i] == ')');
        if (depth == 0 && strncmp(text + i, what, strlen(what)) == 0)
            found = i;
    }
    return found;
}

static int fill(double from, double to, double step, int count, arena *a, mistakes *m, double **out)
{
    *out = arena_take(a, (size_t)count * sizeof **out);
    if (*out == NULL) {
        m->out_of_memory = 1;
        return -1;
    }
    for (int i = 0; i < count; i++)
        (*out)[i] = from + i * step;
    const double miss = fabs((*out)[count - 1] - to);
    if (count > 1 && miss > 0 && miss < 1e-9 * fabs(step))
        (*out)[count - 1] = to;
    return count;
}

/* a..b/n: the ends, and n - 1 points between them. */
static int divide(const document_node *n, double from, double to, int at, const scope *names,
                  arena *a, mistakes *m, double **out)
{
    double parts;
    if (!expression_part(n, at, (int)strlen(n->text) - at, names, m, &parts))
        return -1;
    if (!(parts >= 1 && parts < MOST) || parts != floor(parts)) {
        document_mistake(m, n, at, "%g parts; give a whole number from 1 to %d", parts, MOST - 1);
        return -1;
    }
    const int count = (int)parts + 1;
    const int filled = fill(from, to, (to - from) / parts, count, a, m, out);
    if (filled > 0)
        (*out)[count - 1] = to;
    return filled;
}

static int read_range(const document_node *n, int dots, const scope *names, arena *a, mistakes *m,
                      double **out)
{
    const char *text = n->text;
    const int length = (int)strlen(text), begin = dots + 2;
    const int word = find_outside(text, begin, " step ");
    const int slash = word < 0 ? find_outside(text, begin, "/") : -1;
    int end = slash >= 0 ? slash : length;
    if (word >= 0)
        end = word;
    double from, to, step = 1;
    int good = expression_part(n, 0, dots, names, m, &from);
    good &= expression_part(n, begin, end - begin, names, m, &to);
    if (word >= 0)
        good &= expression_part(n, word + 6, length - word - 6, names, m, &step);
    if (!good)
        return -1;
    if (slash >= 0)
        return divide(n, from, to, slash + 1, names, a, m, out);
    const double steps = (to - from) / step;
    if (!(step != 0 && steps >= -1e-9)) {
        document_mistake(m, n, word >= 0 ? word + 6 : 0,
                         "from %g to %g with steps of %g there is nothing; correct the ends or the "
                         "sign of the step",
                         from, to, step);
        return -1;
    }
    if (steps >= MOST) {
        document_mistake(m, n, 0, "more than %d values; take larger steps", MOST);
        return -1;
    }
    return fill(from, to, step, (int)floor(steps + 1e-9) + 1, a, m, out);
}

int range_is(const document_node *n)
{
    return n->kind == DOCUMENT_TEXT && strstr(n->text, "..") != NULL;
}

int range_values(const document_node *n, const scope *names, arena *a, mistakes *m, double **out)
{
    *out = NULL;
    if (range_is(n))
        return read_range(n, (int)(strstr(n->text, "..") - n->text), names, a, m, out);
    if (n->kind != DOCUMENT_LIST) {
        document_mistake(m, n, 0, "a list of numbers is expected: [a, b, ...] or a range a..b");
        return -1;
    }
    *out = arena_take(a, (size_t)(n->count + 1) * sizeof **out);
    if (*out == NULL) {
        m->out_of_memory = 1;
        return -1;
    }
    int good = 1;
    for (int i = 0; i < n->count; i++)
        good &= expression_number(n->item[i], names, m, &(*out)[i]);
    return good ? n->count : -1;
}

enum { CONSTANTS = 19 };

const char section_names_all[] =
    "A, Iy, Iz, It, Iw, Ip, ys, zs, Dy, Dz, Dw, Fy, Fz, Fw, beta, yc, zc, ey, ez";

int section_names_index(const char *name, size_t length)
{
    const char *at = section_names_all;
    for (int i = 0; i < CONSTANTS; i++) {
        const size_t this = strcspn(at, ",");
        if (this == length && strncmp(at, name, length) == 0)
            return i;
        at += this + 2;
    }
    return -1;
}

const scope *section_names_add(const scope *names, const char *section_name, const section *c,
                               arena *a)
{
    const size_t length = strlen(section_name) + 2;
    char *name = arena_take(a, length);
    double *value = arena_take(a, CONSTANTS * sizeof *value);
    if (name == NULL || value == NULL)
        return names;
    snprintf(name, length, "%s.", section_name);
    for (int i = 0; i < CONSTANTS && c == NULL; i++)
        value[i] = NAN;
    if (c != NULL) {
        const double turn[2] = {cos(c->axes_angle), sin(c->axes_angle)};
        const double all[CONSTANTS] = {c->A,
                                       c->Iy,
                                       c->Iz,
                                       c->It,
                                       c->Iw,
                                       c->Ip,
                                       c->ys,
                                       c->zs,
                                       c->D[0],
                                       c->D[4],
                                       c->D[8],
                                       c->F[0],
                                       c->F[4],
                                       c->F[8],
                                       c->axes_angle,
                                       c->centroid[0],
                                       c->centroid[1],
                                       turn[0] * c->ys - turn[1] * c->zs,
                                       turn[1] * c->ys + turn[0] * c->zs};
        memcpy(value, all, sizeof all);
    }
    return scope_constants(names, name, value, a);
}
