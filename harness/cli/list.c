#include <float.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/meaning.h"
#include "elements/feature.h"
#include "harness/cli/cli.h"
#include "harness/cli/list_formulation.h"
#include "harness/experiments/list_json.h"
#include "harness/experiments/list_subject.h"
#include "harness/experiments/runs_on.h"
#include "harness/formulations/formulations.h"
#include "harness/formulations/registry.h"
#include "harness/study/cell.h"
#include "harness/terminal/paragraph.h"

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
    runs_on here;
    const int at = printf("  %-28s ", type->name);
    runs_on_scene(s, type, &here);
    if (!here.runs)
        paragraph_write(stdout, at + printf("does not offer "), at, here.words);
    else if (here.words[0] != '\0')
        paragraph_say(stdout, at + printf("runs without "), at, "%s%s", here.words,
                      here.other ? " (another model)" : "");
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

/* The ledger, where there is one. */
static void read_ledger(const command_request *r, truths *ledger)
{
    memset(ledger, 0, sizeof *ledger);
    truths_read_rules(case_input_truths_path(r), ledger, NULL);
}

static void show_formulation(const command_request *r, const formulation *chosen)
{
    truths ledger;
    read_ledger(r, &ledger);
    list_formulation(chosen, ledger.rule, ledger.rules);
    truths_free(&ledger);
}

static int show(const command_request *r, const list_subject *what)
{
    if (what->type != NULL)
        return list_case(what->type);
    if (what->chosen.type != NULL)
        show_formulation(r, &what->chosen);
    if (what->cases)
        list_cases();
    if (what->formulations) {
        list_formulations();
        list_features();
    }
    return EXIT_AS_EXPECTED;
}

static status write_json(const list_subject *what, const truths *ledger, fault *f)
{
    if (what->type != NULL) {
        double value[CASE_MAX_PARAMETERS] = {0};
        parameters_default(what->type, value);
        return list_json_case(stdout, what->type, value, f);
    }
    if (what->chosen.type != NULL)
        return list_json_formulation(stdout, &what->chosen, ledger->rule, ledger->rules, f);
    return list_json_all(stdout, what->cases, what->formulations, f);
}

/* The file of the ledger also says which formulations gate. */
static int show_json(const command_request *r, const list_subject *what)
{
    truths ledger;
    fault f = {""};
    read_ledger(r, &ledger);
    const status written = write_json(what, &ledger, &f);
    truths_free(&ledger);
    return message_exit(written, &f);
}

static int list_request(command_request *r)
{
    list_subject what = {.cases = 0};
    fault f;
    case_input_example(r);
    if (r->scene_count > 0) {
        what.type = case_input_scene(r);
        if (what.type == NULL)
            return r->refusal;
    } else if (list_subject_find(r->case_name, &what, &f) != STATUS_OK)
        return message_fail(STATUS_REFUSED, f.text);
    if (strcmp(r->format, "csv") == 0)
        return message_fail(STATUS_REFUSED, "list: --format text or json");
    return strcmp(r->format, "json") == 0 ? show_json(r, &what) : show(r, &what);
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
        "FYTx", count, arguments, list_request);
}
