#include <float.h>
#include <stdio.h>
#include <string.h>

#include "elements/feature.h"
#include "harness/catalogue/choice.h"
#include "harness/catalogue/formulations.h"
#include "harness/catalogue/registry.h"
#include "harness/cli/cli.h"
#include "harness/cli/list_formulation.h"
#include "harness/model/lacks.h"
#include "harness/model/missing.h"
#include "harness/scene_writer/meaning.h"
#include "harness/study/cell.h"
#include "harness/tables/paragraph.h"

enum { COLUMN = 27 };

static void list_formulations(void)
{
    printf("formulations ('beamwork list FORMULATION' tells about one)\n");
    for (int i = 0; formulations_at(i) != NULL; i++)
        paragraph_write(stdout, printf("  %-*s", COLUMN - 2, formulations_at(i)->name), COLUMN,
                        formulations_at(i)->summary);
    printf("options of all of them (-f NAME:OPTION=VALUE)\n");
    for (const parameter_type *o = formulation_common; o->name != NULL; o++)
        list_formulation_option(o);
}

static void list_features(void)
{
    printf("physics that a case can need and a formulation can offer\n");
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        paragraph_write(stdout, printf("  %-*s", COLUMN - 2, feature_name(bit)), COLUMN,
                        feature_summary(bit));
}

static void list_cases(void)
{
    printf("cases ('beamwork list CASE' shows parameters and quantities)\n");
    for (int i = 0; registry_cases[i] != NULL; i++)
        paragraph_write(stdout, printf("  %-*s", COLUMN - 2, registry_cases[i]->name), COLUMN,
                        registry_cases[i]->summary);
}

static void list_offer(const scene *s, const element_type *type)
{
    char words[200];
    const int at = printf("  %-28s ", type->name);
    if (missing_words(s, type, words, sizeof words))
        paragraph_write(stdout, at + printf("does not offer "), at, words);
    else if (lacks_of(s, type, words, sizeof words))
        paragraph_write(stdout, at + printf("runs without "), at, words);
    else
        printf("runs\n");
}

/* "what it is (range)". */
static void list_parameter(const parameter_type *p)
{
    char value[ASSIGNMENT_VALUE], text[400];
    assignment_value_text(p, p->value, value, sizeof value);
    if (p->choices != NULL)
        snprintf(text, sizeof text, "%s (%s)", p->summary, p->choices);
    else if (p->min == -DBL_MAX && p->max == DBL_MAX)
        snprintf(text, sizeof text, "%s (any)", p->summary);
    else
        snprintf(text, sizeof text, "%s (%g .. %g)", p->summary, p->min, p->max);
    paragraph_write(stdout, printf("  %-20s %-14s %-8s ", p->name, value, p->unit), 47, text);
}

static void list_parameters(const case_type *type)
{
    const parameter_type *p;
    paragraph_write(stdout, printf("%s: ", type->name), 2, type->summary);
    paragraph_write(stdout, printf("source: "), 2, type->source);
    printf("parameters (--set NAME=VALUE)\n");
    for (int i = 0; (p = parameter_at(type->parameters, i)) != NULL; i++)
        list_parameter(p);
}

/* What a case asks for at its default parameters, and who answers. */
static void list_scene(const scene *s)
{
    printf("quantities (along a path: a curve)\n");
    for (int i = 0; i < s->quantities; i++) {
        char meaning[MEANING_ROOM];
        meaning_of_quantity(s, i, meaning, sizeof meaning);
        paragraph_write(stdout, printf("  %-28s %-8s ", s->quantity[i].name, s->quantity[i].unit),
                        40, meaning);
    }
    printf("formulations\n");
    for (int i = 0; formulations_at(i) != NULL; i++)
        list_offer(s, formulations_at(i));
}

static int list_case(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    scene s;
    fault f;
    list_parameters(type);
    parameters_default(type, value);
    const status outcome = cell_scene(type, value, NULL, &s, &f);
    if (outcome == STATUS_OK)
        list_scene(&s);
    scene_free(&s);
    return message_exit(outcome, &f);
}

/* All names that may be asked about, one after the other. */
static const char *name_at(const void *context, int i)
{
    static const char *const words[] = {"cases", "formulations"};
    (void)context;
    if (i < 2)
        return words[i];
    i -= 2;
    for (int k = 0; registry_cases[k] != NULL; k++, i--)
        if (i == 0)
            return registry_cases[k]->name;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

static int refuse(const char *name)
{
    char text[300];
    const char *near = choice_nearest(name, name_at, NULL);
    snprintf(text, sizeof text,
             "'%.60s' is neither a case nor a formulation%s%s%s; 'beamwork list' shows them all",
             name, near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
             near != NULL ? "'?" : "");
    return message_fail(STATUS_REFUSED, text);
}

/* A formulation, perhaps with options: what the ledger says of it too, where there is one. */
static int list_one_formulation(const command_request *r)
{
    formulation chosen;
    truths ledger = {0};
    fault f;
    if (formulation_parse(r->case_name, &chosen, &f) != STATUS_OK)
        return message_fail(STATUS_REFUSED, f.text);
    const int known = truths_read_rules(case_input_truths_path(r), &ledger, NULL) == STATUS_OK;
    list_formulation(&chosen, known ? ledger.rule : NULL, ledger.rules);
    truths_free(&ledger);
    return EXIT_AS_EXPECTED;
}

static void list_all(int cases, int formulations)
{
    if (cases)
        list_cases();
    if (formulations) {
        list_formulations();
        list_features();
    }
}

static int list_name(const command_request *r)
{
    const char *name = r->case_name;
    char bare[SCENE_NAME];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(name, ":"), name);
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0)
            return list_case(registry_cases[i]);
    return formulation_find(bare) != NULL ? list_one_formulation(r) : refuse(name);
}

static int list_request(command_request *r)
{
    const char *name = r->case_name;
    if (r->scene_count > 0) {
        const case_type *own = case_input_scene(r);
        return own != NULL ? list_case(own) : r->refusal;
    }
    const int cases = name == NULL || strcmp(name, "cases") == 0,
              formulations = name == NULL || strcmp(name, "formulations") == 0;
    list_all(cases, formulations);
    return cases || formulations ? EXIT_AS_EXPECTED : list_name(r);
}

int cli_list(int count, char **arguments)
{
    return command_run(
        "list", "[cases|formulations|CASE|FORMULATION]",
        "Shows what there is: all cases and formulations; of a case its parameters, quantities and "
        "who can run it; of a formulation its theory, orders, options, what it offers and lacks, "
        "what the ledger knows of it, and the cases that it runs on."
        "\vbeamwork list\n"
        "beamwork list c_column\n"
        "beamwork list collocation",
        "YTx", count, arguments, list_request);
}
