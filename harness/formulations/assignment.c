#include "harness/formulations/assignment.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "elements/shared/number.h"
#include "harness/formulations/words.h"

enum { LONGEST = 128, MOST = 64 };

int assignment_value(const parameter_type *p, const char *text, double *value)
{
    if (p->choices != NULL) {
        const int index = choice_index(p->choices, text);
        if (index >= 0)
            *value = index;
        return index >= 0;
    }
    const char *end;
    return number_read(text, &end, value) && *end == '\0';
}

static status set_value(const assignment_list *l, const parameter_type *p, const char *text,
                        double *value, fault *f)
{
    double number;
    if (!assignment_value(p, text, &number))
        return p->choices != NULL
                   ? fault_set(f, STATUS_REFUSED,
                               "%s %s of %s: unknown choice '%.60s'; give one of %s", l->what,
                               p->name, l->owner, text, p->choices)
                   : fault_set(f, STATUS_REFUSED,
                               "%s %s of %s: '%.60s' is not a finite number, or too small for one; "
                               "values are SI without units",
                               l->what, p->name, l->owner, text);
    if (p->choices == NULL) {
        const int flag = strcmp(p->unit, "1") == 0 && p->min == 0 && p->max == 1;
        if (number < p->min || number > p->max)
            return fault_set(f, STATUS_REFUSED, "%s %s of %s: %g %s is outside its range %g .. %g",
                             l->what, p->name, l->owner, number, p->unit, p->min, p->max);
        if (flag && number != 0 && number != 1)
            return fault_set(f, STATUS_REFUSED, "%s %s of %s: %g: give 0 or 1", l->what, p->name,
                             l->owner, number);
    }
    *value = number;
    return STATUS_OK;
}

static const char *name_at(const void *context, int i)
{
    const parameter_type *p = parameter_at(((const assignment_list *)context)->part, i);
    return p != NULL ? p->name : NULL;
}

void assignment_shown(const assignment_list *l, char out[ASSIGNMENT_SHOWN])
{
    const size_t used = (size_t)snprintf(out, ASSIGNMENT_SHOWN, "%.20s", l->option);
    words_quoted(l->shown_by, out + used, ASSIGNMENT_SHOWN - used);
}

static status unknown(const assignment_list *l, const char *name, fault *f)
{
    char shown[ASSIGNMENT_SHOWN];
    assignment_shown(l, shown);
    const char *near = choice_nearest(name, name_at, l);
    return fault_set(f, STATUS_REFUSED,
                     "%s has no %s '%.60s'%s%s%s; 'beamwork list %.170s' shows them", l->owner,
                     l->what, name, near != NULL ? ", did you mean '" : "",
                     near != NULL ? near : "", near != NULL ? "'?" : "", shown);
}

status assignment_set(const assignment_list *l, const char *text, double value[], int any[],
                      int *index, fault *f)
{
    char name[LONGEST];
    const size_t length = strcspn(text, "=");
    if (length == 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s '%.60s' of %s: write it as NAME=VALUE, joined by single '%c'", l->what,
                         text, l->owner, l->separator);
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const parameter_type *p;
    int i = 0;
    while ((p = parameter_at(l->part, i)) != NULL && strcmp(p->name, name) != 0)
        i++;
    if (p == NULL)
        return unknown(l, name, f);
    if (text[length] == '\0')
        return fault_set(f, STATUS_REFUSED, "%s %s of %s: no value; write %s=VALUE", l->what, name,
                         l->owner, name);
    if (index != NULL)
        *index = i;
    if (any != NULL && strcmp(text + length + 1, "*") == 0) {
        any[i] = 1;
        return STATUS_OK;
    }
    return set_value(l, p, text + length + 1, &value[i], f);
}

status assignment_parse(const assignment_list *l, const char *text, double value[], int any[],
                        fault *f)
{
    const char separators[] = {l->separator, '\0'};
    char given[MOST] = {0};
    for (const char *at = text; at != NULL && *text != '\0';) {
        char one[LONGEST];
        const size_t length = strcspn(at, separators);
        int index = 0;
        if (length >= sizeof one)
            return fault_set(f, STATUS_REFUSED, "%s '%.40s...' of %s: too long", l->what, at,
                             l->owner);
        snprintf(one, sizeof one, "%.*s", (int)length, at);
        TRY(assignment_set(l, one, value, any, &index, f));
        if (given[index]++)
            return fault_set(f, STATUS_REFUSED, "%s %s of %s is given twice; give it one value",
                             l->what, parameter_at(l->part, index)->name, l->owner);
        at = at[length] != '\0' ? at + length + 1 : NULL;
    }
    return STATUS_OK;
}

void assignment_value_text(const parameter_type *p, double value, char *text, int size)
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

void assignment_text(const assignment_list *l, const double value[], char *text, int size)
{
    const parameter_type *p;
    int used = 0;
    text[0] = '\0';
    for (int i = 0; (p = parameter_at(l->part, i)) != NULL && used < size; i++) {
        char word[ASSIGNMENT_VALUE];
        if (value[i] == p->value)
            continue;
        assignment_value_text(p, value[i], word, sizeof word);
        const char joint[] = {used > 0 ? l->separator : '\0', '\0'};
        used += snprintf(text + used, (size_t)(size - used), "%s%s=%s", joint, p->name, word);
    }
}
