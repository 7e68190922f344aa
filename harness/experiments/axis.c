#include "harness/experiments/axis.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/number.h"
#include "harness/formulations/formulations.h"

enum { TEXT = 128 };

const char *axis_kind_name(axis_kind kind)
{
    static const char *const names[] = {"linear", "log", "list", "words"};
    return names[kind];
}

double axis_value(const sweep_axis *a, int i)
{
    if (a->value != NULL)
        return a->value[i];
    if (i == a->count - 1)
        return a->to;
    const int parts = a->count - 1;
    if (a->kind == AXIS_LOG)
        return i == 0 ? a->from : a->from * pow(a->to / a->from, (double)i / parts);
    const double step = (a->to - a->from) / parts; /* as cases/format/range.c has it */
    return a->from + i * step;
}

double axis_at(const sweep_axis *a, double share)
{
    if (a->value != NULL) {
        const int i = (int)(share * a->count);
        return a->value[i < a->count ? i : a->count - 1];
    }
    return a->kind == AXIS_LOG ? a->from * pow(a->to / a->from, share)
                               : a->from + share * (a->to - a->from);
}

void axis_text(const sweep_axis *a, double value, char *text, int size)
{
    assignment_value_text(a->of, value, text, size);
}

/* The parameter may have this value; else the words of --set. */
static status check(const case_type *type, const sweep_axis *a, double value, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    char text[TEXT + 40], word[ASSIGNMENT_VALUE];
    axis_text(a, value, word, sizeof word);
    snprintf(text, sizeof text, "%.60s=%s", a->of->name, word);
    return assignment_set(&list, text, values, NULL, NULL, f);
}

static status add_value(sweep_axis *a, double value, fault *f)
{
    for (int i = 0; i < a->count; i++)
        if (a->value[i] == value)
            return fault_set(f, STATUS_REFUSED, "--vary %s: a value is given twice; give it once",
                             a->of->name);
    double *more = realloc(a->value, (size_t)(a->count + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the values of --vary");
    a->value = more;
    a->value[a->count++] = value;
    return STATUS_OK;
}

/* Numbers or words between commas. */
static status read_list(const case_type *type, const char *text, sweep_axis *a, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    a->kind = a->of->choices != NULL ? AXIS_WORDS : AXIS_LIST;
    for (const char *at = text;; at += strcspn(at, ",") + 1) {
        const int length = (int)strcspn(at, ",");
        char one[2 * TEXT];
        if (length == 0 || length >= TEXT - 1)
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s=%.60s: a value is missing or too long; write %s=A..B/N or "
                             "%s=A,B,C",
                             a->of->name, text, a->of->name, a->of->name);
        snprintf(one, sizeof one, "%.60s=%.*s", a->of->name, length, at);
        TRY(assignment_set(&list, one, values, NULL, NULL, f));
        TRY(add_value(a, values[a->index], f));
        if (at[length] == '\0')
            return STATUS_OK;
    }
}

static status read_end(const sweep_axis *a, const char *text, size_t length, double *out, fault *f)
{
    char one[TEXT];
    const char *end;
    snprintf(one, sizeof one, "%.*s", (int)(length < TEXT ? length : TEXT - 1), text);
    if (length > 0 && length < TEXT && number_read(one, &end, out) && *end == '\0')
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "--vary %s: '%.60s' is not a number; values are SI without units, as "
                     "%s=0.1..0.5/4",
                     a->of->name, one, a->of->name);
}

/* Number of parts behind the '/'. */
static status read_parts(const char *text, size_t length, sweep_axis *a, fault *f)
{
    char one[TEXT], *end;
    snprintf(one, sizeof one, "%.*s", (int)(length < TEXT ? length : TEXT - 1), text);
    errno = 0;
    const long parts = strtol(one, &end, 10);
    if (end == one || *end != '\0' || errno != 0 || parts < 1 || parts >= AXIS_MOST_VALUES)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: '%.40s' parts; give a whole number from 1 to %d", a->of->name,
                         one, AXIS_MOST_VALUES - 1);
    a->count = (int)parts + 1;
    return STATUS_OK;
}

static status check_ends(const case_type *type, const sweep_axis *a, fault *f)
{
    if (a->kind == AXIS_LOG && !(a->from > 0 && a->to > 0) && !(a->from < 0 && a->to < 0))
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: equal ratios from %g to %g do not exist; give ends of one "
                         "sign, or leave out ':log'",
                         a->of->name, a->from, a->to);
    if (a->from == a->to)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: from %g to %g is one value; set it by --set", a->of->name,
                         a->from, a->to);
    TRY(check(type, a, a->from, f));
    TRY(check(type, a, a->to, f));
    /* of what may only be 0 or 1, for one */
    return check(type, a, a->count > 2 || a->count == 0 ? axis_at(a, 0.5) : a->to, f);
}

/* Behind the name: "A..B/N:log". */
static status read_range(const case_type *type, const char *text, const char *dots, sweep_axis *a,
                         fault *f)
{
    const char *to = dots + 2, *colon = strchr(to, ':');
    const size_t rest = colon != NULL ? (size_t)(colon - to) : strlen(to);
    const size_t end = strcspn(to, "/:");
    if (a->of->choices != NULL)
        return fault_set(f, STATUS_REFUSED, "--vary %s: words have no range; list those of %s",
                         a->of->name, a->of->choices);
    if (colon != NULL && strcmp(colon, ":log") != 0)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: '%.40s' is no kind of steps; write %s=A..B/N for equal steps, "
                         "%s=A..B/N:log for equal ratios",
                         a->of->name, colon, a->of->name, a->of->name);
    a->kind = colon != NULL ? AXIS_LOG : AXIS_LINEAR;
    TRY(read_end(a, text, (size_t)(dots - text), &a->from, f));
    TRY(read_end(a, to, end, &a->to, f));
    if (to[end] == '/')
        TRY(read_parts(to + end + 1, rest - end - 1, a, f));
    return check_ends(type, a, f);
}

static status read_values(const case_type *type, const char *text, sweep_axis *a, fault *f)
{
    const char *dots = strstr(text, "..");
    return dots != NULL ? read_range(type, text, dots, a, f) : read_list(type, text, a, f);
}

status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    int any[CASE_MAX_PARAMETERS] = {0};
    char name[TEXT], shown[ASSIGNMENT_SHOWN];
    const size_t length = strcspn(text, "=");
    assignment_shown(&list, shown);
    *out = (sweep_axis){.index = -1};
    if (length == 0 || length > 60 || text[length] == '\0' || text[length + 1] == '\0')
        return fault_set(f, STATUS_REFUSED,
                         "--vary '%.60s': write it as NAME=A..B/N or NAME=A,B,C; 'beamwork list "
                         "%.170s' shows names",
                         text, shown);
    snprintf(name, sizeof name, "%.*s=*", (int)length, text);
    TRY(assignment_set(&list, name, values, any, &out->index, f));
    out->of = parameter_at(type->parameters, out->index);
    const status outcome = read_values(type, text + length + 1, out, f);
    if (outcome != STATUS_OK)
        axis_free(out);
    return outcome;
}

void axis_free(sweep_axis *a)
{
    free(a->value);
    a->value = NULL;
}
