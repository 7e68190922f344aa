#include "harness/cli/names.h"

#include <string.h>
#include <strings.h>

#include "elements/shared/choice.h"
#include "harness/cli/case_input.h"
#include "harness/formulations/formulation.h"
#include "harness/formulations/formulations.h"
#include "harness/formulations/registry.h"
#include "harness/study/glossary.h"
#include "harness/study/truths.h"

void names_cases(const offer *o)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        offer_text(o, registry_cases[i]->name, registry_cases[i]->summary);
}

void names_formulations(const offer *o)
{
    for (int i = 0; formulations_at(i) != NULL; i++)
        offer_text(o, formulations_at(i)->name, formulations_at(i)->summary);
}

/* "NAME=" of a table, or behind "NAME=" the choices. */
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

/* Is it among those before, "name:mass=lumped,"? */
static int is_given(const char *before, int length, const char *name)
{
    const size_t size = strlen(name);
    for (int i = 1; i + (int)size < length; i++)
        if ((before[i - 1] == ':' || before[i - 1] == ',') &&
            strncmp(before + i, name, size) == 0 && before[i + (int)size] == '=')
            return 1;
    return 0;
}

void names_formulation_options(const offer *o)
{
    const size_t name = strcspn(o->begun, ":");
    if (o->begun[name] == '\0') {
        names_formulations(o);
        offer_text(o, "all", "every one");
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

void names_parameters(const offer *o, const case_type *type)
{
    const parameter_type *p;
    for (int i = 0; type != NULL && (p = parameter_at(type->parameters, i)) != NULL; i++)
        offer_assignment(o, p);
}

void names_numbers(const offer *o, const case_type *type)
{
    const parameter_type *p;
    for (int i = 0; type != NULL && (p = parameter_at(type->parameters, i)) != NULL; i++)
        if (p->choices == NULL)
            offer_assignment(o, p);
}

/* The next word of a term that begins as what was said. */
static void offer_term(const offer *o, const char *said, const char *term, const char *summary)
{
    const size_t length = strlen(said);
    char word[GLOSSARY_WORD];
    if (strncasecmp(term, said, length) != 0)
        return;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(term + length, " "), term + length);
    offer_text(o, word, summary);
}

static void offer_terms(const offer *o, const char *said, const glossary *g)
{
    char other[GLOSSARY_WORD];
    for (int i = 0; i < g->entries; i++) {
        offer_term(o, said, g->entry[i].term, g->entry[i].group);
        for (int k = 0; glossary_part(g->entry[i].also, k, other); k++)
            offer_term(o, said, other, g->entry[i].group);
    }
}

void names_words(const offer *o, const char *said)
{
    const command_request r = {0};
    const char *path = case_input_truths_path(&r);
    glossary g = {0};
    truths ledger = {0};
    if (glossary_read(path, &g, NULL) == STATUS_OK)
        offer_terms(o, said, &g);
    glossary_free(&g);
    if (said[0] != '\0')
        return;
    names_cases(o);
    names_formulations(o);
    if (truths_read_rules(path, &ledger, NULL) == STATUS_OK)
        for (int i = 0; i < ledger.rules; i++)
            offer_text(o, ledger.rule[i].name, "rule of the ledger");
    truths_free(&ledger);
}
