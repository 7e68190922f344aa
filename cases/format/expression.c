#include "cases/format/format_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/scene/scene.h"

/* Returns the index of the section constant with this name, or -1. */
static int section_names_index(const char *name, size_t length);

static int report_unknown(const name_context *c, const char *text, int from, int length,
                          expression_mistake *why)
{
    char name[64], remedy[FAULT_TEXT];
    snprintf(name, sizeof name, "%.*s", length, text + from);
    const int is_time = c->in_time && (strcmp(name, "time") == 0 || strcmp(name, "T") == 0);
    const char *known = strcmp(name, "t") == 0 ? NULL : scope_nearest(c->names, name);
    expression_wrong(
        why, from, "unknown name '%s'%s", name,
        mistakes_remedy(is_time ? "t" : known,
                        c->in_time
                            ? "; a function of time may contain t, pi, deg, functions such as "
                              "sin and exp, and the names of 'parameters' and 'let'"
                        : known == NULL && strcmp(name, "t") == 0
                            ? "; the time t is available only in functions of time"
                            : "; define it above, under 'parameters' or 'let'",
                        remedy));
    return 0;
}

/* Reads SECTION.CONSTANT. `length` includes the point. */
static int constant(const name_context *c, const char *text, int *at, int length, double *out,
                    expression_mistake *why)
{
    const int from = *at, behind = from + length;
    const int rest = (int)expression_name_length(text + behind);
    const scope *known = scope_find(c->names, text + from, (size_t)length);
    const int index = section_names_index(text + behind, (size_t)rest);
    *at = behind + rest;
    if (known == NULL)
        expression_wrong(why, from,
                         "section '%.*s' is unknown here; correct its name, or move the expression "
                         "out of 'parameters', 'sections' and the scene's 'let'",
                         length - 1 < 40 ? length - 1 : 40, text + from);
    else if (index < 0)
        expression_wrong(why, behind, "a section has no constant '%.*s'; its constants are %s",
                         rest < 40 ? rest : 40, text + behind, section_names_all);
    else
        *out = known->constants[index];
    return known != NULL && index >= 0 && !isnan(*out);
}

int names_number(const void *context, const char *text, int *at, double *out,
                 expression_mistake *why)
{
    const name_context *c = context;
    const int from = *at, length = (int)expression_name_length(text + from);
    why->what[0] = '\0';
    if (text[from + length] == '.' && expression_name_length(text + from + length + 1) > 0)
        return constant(c, text, at, length + 1, out, why);
    const scope *known = scope_find(c->names, text + from, (size_t)length);
    *at += length;
    if (known == NULL || text[*at + (int)strspn(text + *at, " ")] == '(')
        return report_unknown(c, text, from, length, why);
    if (known->word != NULL)
        expression_wrong(why, from,
                         "'%s' is the word '%.40s', but a number is expected; give a number, or "
                         "{%s: {WORD: NUMBER, ...}}",
                         known->name, known->word, known->name);
    *out = known->number;
    return known->word == NULL && !isnan(*out);
}

static int expression_part(const document_node *n, int from, int length, const scope *names,
                           mistakes *m, double *out)
{
    const name_context context = {names, 0};
    expression_mistake why;
    *out = 0;
    if (expression_value(n->text, from, from + length, names_number, &context, out, &why) ==
        STATUS_OK)
        return 1;
    if (why.what[0] != '\0')
        document_mistake(m, n, why.at, "%s", why.what);
    return 0;
}

int expression_number(const document_node *n, const scope *names, mistakes *m, double *out)
{
    *out = 0;
    if (n->kind == DOCUMENT_TEXT)
        return expression_part(n, 0, (int)strlen(n->text), names, m, out);
    document_mistake(m, n, 0, "this is a %s; give a number or an expression",
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

/* Returns the last position after `from` at which a string occurs outside parentheses, or -1. */
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

/* Computes the n + 1 values of a range a..b/n, which includes both ends. a..b/n:log has equal
 * ratios. */
static int divide(const document_node *n, double from, double to, int at, const scope *names,
                  arena *a, mistakes *m, double **out)
{
    const int length = (int)strlen(n->text), tail = (int)strlen(":log"),
              by_ratio = length - at > tail && strcmp(n->text + length - tail, ":log") == 0;
    double parts;
    if (!expression_part(n, at, length - at - (by_ratio ? tail : 0), names, m, &parts))
        return -1;
    if (by_ratio && !(from > 0 && to > 0) && !(from < 0 && to < 0)) {
        document_mistake(m, n, 0,
                         "a range with equal ratios cannot go from %g to %g; give nonzero ends of "
                         "the same sign, "
                         "or remove ':log'",
                         from, to);
        return -1;
    }
    if (!(parts >= 1 && parts < MOST) || parts != floor(parts)) {
        document_mistake(m, n, at, "the range has %g parts; give a whole number from 1 to %d",
                         parts, MOST - 1);
        return -1;
    }
    const int count = (int)parts + 1;
    const int filled = fill(from, to, (to - from) / parts, count, a, m, out);
    for (int i = 1; by_ratio && i < filled; i++)
        (*out)[i] = from * pow(to / from, i / parts);
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
                         "the range from %g to %g in steps of %g is empty; correct the ends or the "
                         "sign of the step",
                         from, to, step);
        return -1;
    }
    if (steps >= MOST) {
        document_mistake(m, n, 0, "the range has more than %d values; use larger steps", MOST);
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

static int section_names_index(const char *name, size_t length)
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
