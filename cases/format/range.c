#include "cases/format/range.h"

#include <math.h>
#include <string.h>

#include "cases/format/expression.h"

enum { MOST = 10000 };

/* Where a text stands outside parentheses, behind `from`; the last such place; -1: nowhere. */
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
