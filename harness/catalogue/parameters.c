#include "harness/catalogue/parameters.h"

#include "harness/catalogue/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int parameters_count(const case_type *c)
{
    int n = 0;
    while (c->parameters[n].name != NULL)
        n++;
    return n;
}

void parameters_default(const case_type *c, double value[])
{
    for (int i = 0; c->parameters[i].name != NULL; i++)
        value[i] = c->parameters[i].value;
}

int choice_index(const char *choices, const char *word)
{
    const size_t length = strlen(word);
    int index = 0;
    for (const char *at = choices; at != NULL; index++) {
        const size_t here = strcspn(at, "|");
        if (here == length && strncmp(at, word, length) == 0)
            return index;
        at = at[here] == '|' ? at + here + 1 : NULL;
    }
    return -1;
}

void choice_name(const char *choices, int index, char *text, int size)
{
    const char *at = choices;
    for (int i = 0; i < index && at != NULL; i++) {
        at = strchr(at, '|');
        at = at != NULL ? at + 1 : NULL;
    }
    snprintf(text, (size_t)size, "%.*s", at != NULL ? (int)strcspn(at, "|") : 0,
             at != NULL ? at : "");
}

enum { LONGEST = 64 };

static int distance(const char *a, const char *b)
{
    int row[LONGEST + 1];
    const int n = (int)strnlen(b, LONGEST);
    for (int j = 0; j <= n; j++)
        row[j] = j;
    for (int i = 1; a[i - 1] != '\0' && i < LONGEST; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= n; j++) {
            const int substituted = diagonal + (a[i - 1] != b[j - 1]);
            const int shorter = row[j] < row[j - 1] ? row[j] + 1 : row[j - 1] + 1;
            diagonal = row[j];
            row[j] = substituted < shorter ? substituted : shorter;
        }
    }
    return row[n];
}

const char *nearest_name(const char *word, const char *(*next)(const void *, int),
                         const void *context)
{
    const char *nearest = NULL, *name;
    int least = (int)strnlen(word, LONGEST) / 2 + 2;
    for (int i = 0; (name = next(context, i)) != NULL; i++) {
        const int d = strncmp(name, word, strlen(word)) == 0 ? 1 : distance(word, name);
        if (d < least) {
            least = d;
            nearest = name;
        }
    }
    return nearest;
}

static const char *parameter_name(const void *context, int i)
{
    const case_type *c = context;
    return c->parameters[i].name;
}

static status set_value(const case_parameter *p, const char *text, double *value, fault *f)
{
    if (p->choices != NULL) {
        const int index = choice_index(p->choices, text);
        if (index < 0)
            return fault_set(f, STATUS_REFUSED, "parameter %s: unknown choice '%s'; give one of %s",
                             p->name, text, p->choices);
        *value = index;
        return STATUS_OK;
    }
    const char *end;
    double number;
    if (!number_read(text, &end, &number) || *end != '\0')
        return fault_set(f, STATUS_REFUSED,
                         "parameter %s: '%.60s' is not a finite number, or too small for one",
                         p->name, text);
    if (number < p->min || number > p->max)
        return fault_set(f, STATUS_REFUSED, "parameter %s = %g %s is outside its range %g .. %g",
                         p->name, number, p->unit, p->min, p->max);
    const int whole = strcmp(p->unit, "1") == 0 && p->min == 0 && p->max == 1;
    if (whole && number != 0 && number != 1)
        return fault_set(f, STATUS_REFUSED, "parameter %s = %g: give 0 or 1", p->name, number);
    *value = number;
    return STATUS_OK;
}

static const case_parameter *find(const case_type *c, const char *name, size_t length, int *index)
{
    for (int i = 0; c->parameters[i].name != NULL; i++)
        if (strlen(c->parameters[i].name) == length &&
            strncmp(c->parameters[i].name, name, length) == 0) {
            *index = i;
            return &c->parameters[i];
        }
    return NULL;
}

static status set_one(const case_type *c, const char *assignment, double value[], int any[],
                      fault *f)
{
    const char *equals = strchr(assignment, '=');
    const size_t length = equals != NULL ? (size_t)(equals - assignment) : strlen(assignment);
    int index = 0;
    const case_parameter *p = find(c, assignment, length, &index);
    if (p == NULL) {
        char name[LONGEST];
        snprintf(name, sizeof name, "%.*s", (int)length, assignment);
        const char *near = nearest_name(name, parameter_name, c);
        return fault_set(f, STATUS_REFUSED, "case %s has no parameter '%s'%s%s%s", c->name, name,
                         near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
                         near != NULL ? "'?" : "");
    }
    if (equals == NULL)
        return fault_set(f, STATUS_REFUSED, "parameter %s: no value; write %s=VALUE", p->name,
                         p->name);
    if (any != NULL && strcmp(equals + 1, "*") == 0) {
        any[index] = 1;
        return STATUS_OK;
    }
    return set_value(p, equals + 1, &value[index], f);
}

status parameters_set(const case_type *c, const char *assignment, double value[], fault *f)
{
    return set_one(c, assignment, value, NULL, f);
}

status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f)
{
    const int n = parameters_count(c), all = strcmp(text, "*") == 0;
    parameters_default(c, value);
    for (int i = 0; i < n && any != NULL; i++)
        any[i] = all;
    for (const char *at = all ? "" : text; *at != '\0';) {
        char one[128];
        const size_t length = strcspn(at, ";");
        if (length >= sizeof one)
            return fault_set(f, STATUS_REFUSED, "parameter '%.40s...': too long", at);
        snprintf(one, sizeof one, "%.*s", (int)length, at);
        const status outcome = set_one(c, one, value, any, f);
        if (outcome != STATUS_OK)
            return outcome;
        at += length + (at[length] == ';');
    }
    return STATUS_OK;
}

void parameters_value_text(const case_parameter *p, double value, char *text, int size)
{
    if (p->choices != NULL) {
        choice_name(p->choices, (int)value, text, size);
        return;
    }
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, (size_t)size, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return;
    }
}

void parameters_text(const case_type *c, const double value[], char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (int i = 0; c->parameters[i].name != NULL && used < size; i++) {
        char number[64];
        if (value[i] == c->parameters[i].value)
            continue;
        parameters_value_text(&c->parameters[i], value[i], number, sizeof number);
        used += snprintf(text + used, (size_t)(size - used), "%s%s=%s", used > 0 ? ";" : "",
                         c->parameters[i].name, number);
    }
}

uint64_t parameters_hash(const case_type *c, const double value[], const int any[])
{
    uint64_t hash = 14695981039346656037ull;
    for (int i = 0; c->parameters[i].name != NULL; i++) {
        char text[128];
        if (any != NULL && any[i])
            snprintf(text, sizeof text, "%s=*;", c->parameters[i].name);
        else
            snprintf(text, sizeof text, "%s=%.17g;", c->parameters[i].name, value[i]);
        for (const char *at = text; *at != '\0'; at++)
            hash = (hash ^ (unsigned char)*at) * 1099511628211ull;
    }
    return hash;
}
