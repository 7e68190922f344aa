#include "harness/formulations/formulations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

/* Copies a word without its quotation marks. Returns the rest of the text; NULL: a quotation mark
 * is not closed. */
static const char *take(const char *from, char **to)
{
    char quote = '\0';
    for (; *from != '\0' && (quote != '\0' || strchr(" \t\n", *from) == NULL); from++)
        if (quote != '\0' && *from == quote)
            quote = '\0';
        else if (quote == '\0' && (*from == '\'' || *from == '"'))
            quote = *from;
        else
            *(*to)++ = *from;
    *(*to)++ = '\0';
    return quote == '\0' ? from : NULL;
}

status words_split(const char *command, char ***words, fault *f)
{
    const size_t list = (WORDS_MOST + 1) * sizeof(char *);
    char **out = malloc(list + strlen(command) + WORDS_MOST + 1);
    int count = 0;
    if (out == NULL)
        return fault_memory(f, "a command");
    char *to = (char *)out + list;
    const char *from = command + strspn(command, " \t\n"), *why = NULL;
    while (from != NULL && *from != '\0' && count < WORDS_MOST) {
        out[count++] = to;
        from = take(from, &to);
        if (from != NULL)
            from += strspn(from, " \t\n");
    }
    out[count] = NULL;
    if (from == NULL)
        why = "a quotation mark is not closed; close it";
    else if (*from != '\0')
        why = "too many words; write them into a script";
    else if (count == 0 || out[0][0] == '\0')
        why = "no command is given; give one such as 'exec:python3 my_beam.py'";
    if (why == NULL) {
        *words = out;
        return STATUS_OK;
    }
    free(out);
    return fault_set(f, STATUS_REFUSED, "exec:%.100s: %s", command, why);
}

void words_quote(FILE *to, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=:,./@%";
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        fputs(word, to);
        return;
    }
    fputc('\'', to);
    for (; *word != '\0'; word++)
        if (*word == '\'')
            fputs("'\\''", to);
        else
            fputc(*word, to);
    fputc('\'', to);
}

void words_quoted(const char *word, char *out, size_t size)
{
    FILE *to = fmemopen(out, size, "w");
    out[0] = '\0';
    if (to == NULL)
        return;
    words_quote(to, word);
    fclose(to);
    out[size - 1] = '\0';
}

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

void parameter_unit_words(const parameter_type *p, char out[PARAMETER_UNIT_WORDS])
{
    const int plain = p->unit[0] == '\0' || strcmp(p->unit, "1") == 0;
    out[0] = '\0';
    if (!plain)
        snprintf(out, PARAMETER_UNIT_WORDS, " in %.40s, without the unit", p->unit);
}

static status set_value(const assignment_list *l, const parameter_type *p, const char *text,
                        double *value, fault *f)
{
    double number;
    char unit[PARAMETER_UNIT_WORDS];
    parameter_unit_words(p, unit);
    if (!assignment_value(p, text, &number))
        return p->choices != NULL
                   ? fault_set(f, STATUS_REFUSED,
                               "%s %s of %s: unknown choice '%.60s'; give one of %s", l->what,
                               p->name, l->owner, text, p->choices)
                   : fault_set(f, STATUS_REFUSED,
                               "%s %s of %s: '%.60s' is not a finite number, or is too small; give "
                               "a number%s",
                               l->what, p->name, l->owner, text, unit);
    if (p->choices == NULL) {
        const int plain = strcmp(p->unit, "1") == 0, flag = plain && p->min == 0 && p->max == 1;
        if (number < p->min || number > p->max)
            return fault_set(
                f, STATUS_REFUSED,
                "%s %s of %s: %g%s%s is outside its range %g .. %g; give a value in it", l->what,
                p->name, l->owner, number, plain ? "" : " ", plain ? "" : p->unit, p->min, p->max);
        if (flag && number != 0 && number != 1)
            return fault_set(f, STATUS_REFUSED, "%s %s of %s: %g is not valid; give 0 or 1",
                             l->what, p->name, l->owner, number);
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
                     "%s has no %s '%.60s'%s%s%s'beamwork list %.170s' shows the names", l->owner,
                     l->what, name, near != NULL ? "; did you mean '" : "",
                     near != NULL ? near : "", near != NULL ? "'? " : "; ", shown);
}

status assignment_set(const assignment_list *l, const char *text, double value[], int any[],
                      int *index, fault *f)
{
    char name[LONGEST];
    const size_t length = strcspn(text, "=");
    if (length == 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s '%.60s' of %s has no value; write NAME=VALUE, and separate several with '%c'",
            l->what, text, l->owner, l->separator);
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const parameter_type *p;
    int i = 0;
    while ((p = parameter_at(l->part, i)) != NULL && strcmp(p->name, name) != 0)
        i++;
    if (p == NULL)
        return unknown(l, name, f);
    if (text[length] == '\0')
        return fault_set(f, STATUS_REFUSED, "%s %s of %s has no value; write %s=VALUE", l->what,
                         name, l->owner, name);
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
            return fault_set(f, STATUS_REFUSED,
                             "%s '%.40s...' of %s is longer than %d characters; write NAME=VALUE, "
                             "and separate several with '%c'",
                             l->what, at, l->owner, LONGEST - 1, l->separator);
        snprintf(one, sizeof one, "%.*s", (int)length, at);
        TRY(assignment_set(l, one, value, any, &index, f));
        if (given[index]++)
            return fault_set(f, STATUS_REFUSED, "%s %s of %s is given twice; give one value",
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

/* Returns 1 if the program has added the parameter to a case. The original source of the case does
 * not have this parameter. */
static int is_shared(const parameter_type *p)
{
    return case_is_omit(p) || case_is_mass(p);
}

assignment_list parameters_list(const case_type *c)
{
    assignment_list list = {.what = "parameter",
                            .owner = c->name,
                            .option = c->file != NULL ? "--scene " : "",
                            .shown_by = c->file != NULL ? c->file : c->name,
                            .separator = ';'};
    memcpy(list.part, c->parameters, sizeof list.part);
    return list;
}

void parameters_shown(const case_type *c, char out[ASSIGNMENT_SHOWN])
{
    const assignment_list list = parameters_list(c);
    assignment_shown(&list, out);
}

int parameters_count(const case_type *c)
{
    return parameter_count(c->parameters);
}

void parameters_default(const case_type *c, double value[])
{
    parameter_defaults(c->parameters, value);
}

status parameters_set(const case_type *c, const char *assignment, double value[], fault *f)
{
    const assignment_list list = parameters_list(c);
    return assignment_set(&list, assignment, value, NULL, NULL, f);
}

status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f)
{
    const assignment_list list = parameters_list(c);
    const int n = parameters_count(c), all = strcmp(text, "*") == 0;
    parameters_default(c, value);
    if (any != NULL)
        for (int i = 0; i < n; i++)
            any[i] = all && !is_shared(parameter_at(c->parameters, i));
    return all ? STATUS_OK : assignment_parse(&list, text, value, any, f);
}

void parameters_text(const case_type *c, const double value[], char *text, int size)
{
    const assignment_list list = parameters_list(c);
    assignment_text(&list, value, text, size);
}

void parameters_source_text(const case_type *c, const double value[], char *text, int size)
{
    double of[CASE_MAX_PARAMETERS];
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        of[i] = is_shared(p) ? p->value : value[i];
    parameters_text(c, of, text, size);
}

int parameters_of_source(const case_type *c)
{
    int count = 0;
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        count += !is_shared(p);
    return count;
}

uint64_t parameters_hash(const case_type *c, const double value[], const int any[])
{
    parameters_words none;
    none.known = 0;
    return parameters_hash_next(c, value, any, &none);
}

/* Writes "name=%.17g;" or "name=*;" to words->text. */
static void write_word(const parameter_type *p, int i, double value, int any,
                       parameters_words *words)
{
    const size_t size = sizeof words->text[i];
    if (i < words->known && words->any[i] == any && words->value[i] == value &&
        !signbit(words->value[i]) == !signbit(value)) /* "-0" differs from "0" */
        return;
    words->value[i] = value;
    words->any[i] = any;
    if (any)
        snprintf(words->text[i], size, "%s=*;", p->name);
    else
        snprintf(words->text[i], size, "%s=%.17g;", p->name, value);
}

uint64_t parameters_hash_next(const case_type *c, const double value[], const int any[],
                              parameters_words *before)
{
    uint64_t hash = 14695981039346656037ull;
    const parameter_type *p;
    int i = 0;
    for (; (p = parameter_at(c->parameters, i)) != NULL; i++) {
        write_word(p, i, value[i], any != NULL && any[i], before);
        if (is_shared(p) && value[i] == 0)
            continue;
        for (const char *at = before->text[i]; *at != '\0'; at++)
            hash = (hash ^ (unsigned char)*at) * 1099511628211ull;
    }
    before->known = i;
    return hash;
}

static const char *case_name(const void *context, int i)
{
    (void)context;
    return registry_cases[i] != NULL ? registry_cases[i]->name : NULL;
}

const case_type *case_find(const char *name, fault *f)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0)
            return registry_cases[i];
    choice_unknown("case", name, case_name, f);
    return NULL;
}
