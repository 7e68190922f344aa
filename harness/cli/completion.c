#include "harness/cli/cli.h"

#include <string.h>
#include <strings.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

void offer_text(const offer *o, const char *text, const char *summary)
{
    if (strncmp(text, o->begun, strlen(o->begun)) == 0)
        fprintf(o->to, "%.*s%s\t%s\n", o->length, o->before, text, summary);
}

static void offer_choices(const offer *o, const char *choices)
{
    char word[64];
    while (*choices != '\0') {
        const size_t length = strcspn(choices, "|");
        snprintf(word, sizeof word, "%.*s", (int)length, choices);
        offer_text(o, word, "");
        choices += length + (choices[length] == '|');
    }
}

/* Returns an offer whose word starts after the last of these characters. If the word contains none
 * of them, returns the offer unchanged. */
static offer offer_behind(const offer *o, const char *characters)
{
    offer behind = *o;
    for (const char *at = o->begun; *at != '\0'; at++)
        if (strchr(characters, *at) != NULL)
            behind.begun = at + 1;
    behind.length = (int)(o->length + (behind.begun - o->begun));
    return behind;
}

static void names_cases(const offer *o)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        offer_text(o, registry_cases[i]->name, registry_cases[i]->summary);
}

static void names_formulations(const offer *o)
{
    for (int i = 0; formulations_at(i) != NULL; i++)
        offer_text(o, formulations_at(i)->name, formulations_at(i)->summary);
}

static void offer_assignment(const offer *o, const parameter_type *p)
{
    char name[100];
    const size_t length = strlen(p->name);
    snprintf(name, sizeof name, "%.*s=", (int)sizeof name - 2, p->name);
    if (strncmp(o->begun, name, length + 1) != 0) {
        offer_text(o, name, p->summary);
    } else if (p->choices != NULL) {
        const offer value = offer_behind(o, "=");
        offer_choices(&value, p->choices);
    }
}

/* Returns 1 if the text before the cursor, such as "name:mass=lumped,", contains the option. */
static int is_given(const char *before, int length, const char *name)
{
    const size_t size = strlen(name);
    for (int i = 1; i + (int)size < length; i++)
        if ((before[i - 1] == ':' || before[i - 1] == ',') &&
            strncmp(before + i, name, size) == 0 && before[i + (int)size] == '=')
            return 1;
    return 0;
}

static void names_formulation_options(const offer *o)
{
    const size_t name = strcspn(o->begun, ":");
    if (o->begun[name] == '\0') {
        names_formulations(o);
        offer_text(o, "all", "all formulations");
        return;
    }
    const element_type *type = formulations_named(o->begun, name);
    const offer behind = offer_behind(o, ":,");
    if (type == NULL)
        return;
    const assignment_list all = formulation_options(type);
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(all.part, i)) != NULL; i++)
        if (!is_given(behind.before, behind.length, p->name))
            offer_assignment(&behind, p);
}

static void names_parameters(const offer *o, const case_type *type)
{
    const parameter_type *p;
    for (int i = 0; type != NULL && (p = parameter_at(type->parameters, i)) != NULL; i++)
        offer_assignment(o, p);
}

static void names_numbers(const offer *o, const case_type *type)
{
    const parameter_type *p;
    for (int i = 0; type != NULL && (p = parameter_at(type->parameters, i)) != NULL; i++)
        if (p->choices == NULL)
            offer_assignment(o, p);
}

static void offer_term(const offer *o, const char *typed, const char *term, const char *summary)
{
    const size_t length = strlen(typed);
    char word[GLOSSARY_WORD];
    if (strncasecmp(term, typed, length) != 0)
        return;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(term + length, " "), term + length);
    offer_text(o, word, summary);
}

static void offer_terms(const offer *o, const char *typed, const glossary *g)
{
    char other[GLOSSARY_WORD];
    for (int i = 0; i < g->entries; i++) {
        offer_term(o, typed, g->entry[i].term, g->entry[i].group);
        for (int k = 0; glossary_part(g->entry[i].also, k, other); k++)
            offer_term(o, typed, other, g->entry[i].group);
    }
}

static void names_words(const offer *o, const char *typed)
{
    const truths_options usual = {.packed = NULL};
    const char *path = user_tables_packed(&usual);
    glossary g = {0};
    truths deviations = {0};
    if (glossary_read(path, &g, NULL) == STATUS_OK)
        offer_terms(o, typed, &g);
    glossary_free(&g);
    if (typed[0] != '\0')
        return;
    names_cases(o);
    names_formulations(o);
    if (truths_read_rules(path, &deviations, NULL) == STATUS_OK)
        for (int i = 0; i < deviations.rules; i++)
            offer_text(o, deviations.rule[i].name, "known deviation");
    truths_free(&deviations);
}

enum { TYPED = 400 };

typedef struct completion_reading {
    const verb *verb;
    const verb_option *open; /* option whose value is at the cursor; NULL: none */
    int only_arguments;      /* "--" was given */
    const char *last;
    int arguments;
    const char *scene; /* value of --scene */
    char typed[TYPED];
} completion_reading;

static void keep_value(completion_reading *r, const verb_option *o, const char *value)
{
    if (o != NULL && strcmp(o->name, "scene") == 0)
        r->scene = value;
}

static void read_option(completion_reading *r, const char *word)
{
    const char *value;
    int begun;
    const verb_option *o = verb_word(r->verb, word, &value, &begun);
    if (value != NULL)
        keep_value(r, o, value);
    else if (o != NULL && o->argument != NULL && !verb_optional(o))
        r->open = o;
}

static void read_argument(completion_reading *r, const char *word)
{
    const size_t used = strlen(r->typed);
    r->last = word;
    r->arguments++;
    snprintf(r->typed + used, sizeof r->typed - used, "%s ", word);
}

static void read_word(completion_reading *r, const char *word)
{
    if (r->open != NULL) {
        keep_value(r, r->open, word);
        r->open = NULL;
    } else if (!r->only_arguments && strcmp(word, "--") == 0) {
        r->only_arguments = 1;
    } else if (!r->only_arguments && word[0] == '-' && word[1] != '\0') {
        read_option(r, word);
    } else {
        read_argument(r, word);
    }
}

static void offer_words(const offer *o, const completion_reading *r)
{
    const offer word = offer_behind(o, " ");
    const int here = (int)(word.begun - o->begun);
    char typed[2 * TYPED];
    snprintf(typed, sizeof typed, "%s%.*s", r->typed, here < TYPED ? here : 0, o->begun);
    names_words(&word, typed);
}

static void offer_part(const offer *o, const completion_reading *r, const char *part)
{
    char word[40];
    if (strcmp(part, "CASE") == 0)
        names_cases(o);
    else if (strcmp(part, "FORMULATION") == 0)
        names_formulations(o);
    else if (strcmp(part, "WORD") == 0)
        offer_words(o, r);
    else if (strcmp(part, "FOLDER") == 0)
        fprintf(o->to, ":folders\n");
    else if (strncmp(part, "FILE", 4) == 0 || strcmp(part, "OLD") == 0 || strcmp(part, "NEW") == 0)
        fprintf(o->to, ":files\n");
    else if (part[0] >= 'a' && part[0] <= 'z') {
        const int all = (int)strcspn(part, ":");
        snprintf(word, sizeof word, "%.*s", all + (part[all] == ':'), part);
        offer_text(o, word, "");
    }
}

static void offer_kinds(const offer *o, const completion_reading *r, const char *kinds)
{
    static const char between[] = "[]|. ";
    char part[40];
    for (kinds += strspn(kinds, between); *kinds != '\0'; kinds += strspn(kinds, between)) {
        const size_t length = strcspn(kinds, between);
        snprintf(part, sizeof part, "%.*s", (int)length, kinds);
        offer_part(o, r, part);
        kinds += length;
    }
}

static void offer_selection(const offer *o)
{
    const offer word = offer_behind(o, " (");
    names_cases(&word);
    names_formulations(&word);
    offer_choices(&word, "and|or|not");
}

static void offer_parameters(const offer *o, const completion_reading *r,
                             void names(const offer *, const case_type *))
{
    scene_file *file = NULL;
    mistakes m;
    if (r->scene != NULL && scene_file_read(r->scene, &file, &m, NULL) == STATUS_OK)
        names(o, scene_file_case(file));
    else if (r->scene == NULL && r->last != NULL)
        names(o, case_find(r->last, NULL));
    scene_file_free(file);
}

static void offer_value(const offer *o, const completion_reading *r, const verb_option *option)
{
    const char *name = option->name;
    const int other = strcmp(name, "against") == 0;
    if (strcmp(name, "formulation") == 0 || other)
        names_formulation_options(o);
    if (other)
        fprintf(o->to, ":files\n");
    else if (strcmp(name, "set") == 0)
        offer_parameters(o, r, names_parameters);
    else if (strcmp(name, "follow") == 0)
        offer_parameters(o, r, names_numbers);
    else if (strcmp(name, "select") == 0)
        offer_selection(o);
    else if (strcmp(name, "formulation") != 0)
        offer_kinds(o, r, option->argument);
}

static void offer_options(const offer *o, const completion_reading *r)
{
    const verb_option *one;
    char text[80];
    for (int i = 0; (one = verb_option_at(r->verb, i, NULL)) != NULL; i++) {
        snprintf(text, sizeof text, "--%s%s", one->name,
                 one->argument != NULL && !verb_optional(one) ? "=" : "");
        offer_text(o, text, one->help);
    }
}

static void offer_begun_option(FILE *to, const completion_reading *r, const char *word)
{
    const offer whole = {to, word, 0, word};
    const char *value;
    int begun;
    const verb_option *o = verb_word(r->verb, word, &value, &begun);
    if (value == NULL && word[1] != '-')
        value = word + strlen(word);
    const offer behind = {to, word, value != NULL ? (int)(value - word) : 0, value};
    if (o != NULL && o->argument != NULL && value != NULL)
        offer_value(&behind, r, o);
    else
        offer_options(&whole, r);
}

void completion_write(FILE *to, const verb *v, int count, char *const *word)
{
    const char *begun = word[count - 1];
    const offer whole = {to, begun, 0, begun};
    completion_reading r = {.verb = v};
    for (int i = 0; i + 1 < count; i++)
        read_word(&r, word[i]);
    if (r.open != NULL)
        offer_value(&whole, &r, r.open);
    else if (begun[0] == '-' && !r.only_arguments)
        offer_begun_option(to, &r, begun);
    else if (r.arguments < verb_most_arguments(v->arguments))
        offer_kinds(&whole, &r, v->arguments);
}
