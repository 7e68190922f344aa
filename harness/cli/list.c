#include <float.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/feature.h"
#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { COLUMN = 26, LINE = 4000 };

static const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;

static void hang(int indent, const char *text)
{
    const int word = (int)strcspn(text, " ");
    paragraph_write(stdout, printf("%*s%.*s ", indent, "", word, text), indent + 2, text + word);
}

/* Reads a declared field of a formulation, as in results files. Returns its number, and sets *out
 * to its text. */
static long declared(const formulation *chosen, const char *name, field_value *out)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const series one = {.formulation = *chosen};
    const subject s = {.series = &one};
    const int fields = schema_fields(&record_declaration, KEY, list);
    out->text = "";
    for (int i = 0; i < fields; i++)
        if (strcmp(list[i]->name, name) == 0)
            schema_read(&s, list[i], out);
    return out->whole;
}

static void show_declared(const formulation *chosen, const char *head, const char *name)
{
    field_value v = {.whole = 0};
    declared(chosen, name, &v);
    if (v.text[0] != '\0')
        paragraph_write(stdout, printf("  %s: ", head), 4, v.text);
}

static void show_numbers(const formulation *chosen)
{
    static const char *const order[][2] = {{"statics_least", "statics_highest"},
                                           {"vibration_least", "vibration_highest"},
                                           {"motion_least", "motion_highest"},
                                           {"buckling_least", "buckling_highest"}};
    static const char *const analysis[] = {"statics", "vibration", "motion", "linear buckling"};
    field_value v = {.whole = 0};
    char orders[200];
    int used = 0;
    const long nodes = declared(chosen, "nodes", &v), strains = declared(chosen, "strains", &v),
               inner = declared(chosen, "inner", &v);
    printf("  element: %ld nodes, %ld generalized strains", nodes, strains);
    printf(inner > 0 ? ", %ld internal unknowns\n" : "\n", inner);
    for (int i = 0; i < 4; i++) {
        const long least = declared(chosen, order[i][0], &v),
                   highest = declared(chosen, order[i][1], &v);
        used += snprintf(orders + used, sizeof orders - (size_t)used, "%s%ld", i > 0 ? ", " : "",
                         least);
        if (highest > least)
            used += snprintf(orders + used, sizeof orders - (size_t)used, " to %ld", highest);
        used += snprintf(orders + used, sizeof orders - (size_t)used, " in %s", analysis[i]);
    }
    paragraph_write(stdout, printf("  order of convergence: "), 4, orders);
}

static void show_features(const char *heading, unsigned features)
{
    if (features != 0)
        printf("%s\n", heading);
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if (features & bit)
            paragraph_write(stdout, printf("  %-*s", COLUMN - 2, feature_name(bit)), COLUMN,
                            feature_summary(bit));
}

static void list_formulation_option(const parameter_type *o)
{
    char value[ASSIGNMENT_VALUE];
    assignment_value_text(o, o->value, value, sizeof value);
    int at = printf("  %s=", o->name);
    at += o->choices != NULL ? printf("%s", o->choices) : printf("%g..%g", o->min, o->max);
    at += printf(", default %s: ", value);
    paragraph_write(stdout, at, 4, o->summary);
}

static void show_options(const element_type *t)
{
    const assignment_list list = formulation_options(t);
    const parameter_type *o;
    printf("options (-f %s:NAME=VALUE)\n", t->name);
    for (int i = 0; (o = parameter_at(list.part, i)) != NULL; i++)
        list_formulation_option(o);
}

static void show_verdicts(const rule *r)
{
    char line[LINE];
    snprintf(line, sizeof line, "in %s: ", r->cases);
    for (const char *v = r->verdicts; v != NULL;
         v = strchr(v, '|') != NULL ? strchr(v, '|') + 1 : NULL)
        snprintf(line + strlen(line), sizeof line - strlen(line), "%s%.*s",
                 v != r->verdicts ? "; " : "", (int)strcspn(v, "|"), v);
    hang(4, line);
}

static void show_rules(const formulation *chosen, const rule *rules, int count)
{
    int found = 0;
    for (int i = 0; i < count; i++) {
        const rule *r = &rules[i];
        if (!rules_apply_to(r, chosen->key))
            continue;
        if (found++ == 0)
            printf("known deviations ('beamwork explain RULE' shows the proof)\n");
        paragraph_write(stdout, printf("  %s: ", r->name), 4, r->cause);
        show_verdicts(r);
    }
    if (found == 0)
        printf("known deviations: none\n");
}

static void show_alike(const runs_on all[], int count, int first, const char *head)
{
    char line[LINE];
    int names = 0;
    for (int i = 0; i < first; i++)
        if (all[i].runs == all[first].runs && strcmp(all[i].words, all[first].words) == 0)
            return;
    snprintf(line, sizeof line, "%s%s: ", head, all[first].words);
    for (int i = first; i < count; i++)
        if (all[i].runs == all[first].runs && strcmp(all[i].words, all[first].words) == 0)
            snprintf(line + strlen(line), sizeof line - strlen(line), "%s%s",
                     names++ > 0 ? ", " : "", all[i].name);
    hang(2, line);
}

static void show_cases(const element_type *t)
{
    enum { ROOM = 256 };
    static runs_on all[ROOM];
    const int count = runs_on_cases(t, all, ROOM);
    printf("cases, at their default parameters\n");
    for (int i = 0; i < count; i++)
        if (all[i].runs && all[i].words[0] == '\0')
            show_alike(all, count, i, "runs");
    for (int i = 0; i < count; i++)
        if (all[i].runs && all[i].words[0] != '\0')
            show_alike(all, count, i, "runs, without ");
    for (int i = 0; i < count; i++)
        if (!all[i].runs)
            show_alike(all, count, i, "not run, because the formulation does not support ");
}

static void list_formulation(const formulation *chosen, const rule *rules, int count)
{
    const element_type *t = chosen->type;
    paragraph_write(stdout, printf("%s: ", chosen->key), 2, t->summary);
    show_declared(chosen, "source", "source");
    show_declared(chosen, "family", "family");
    show_numbers(chosen);
    show_declared(chosen, "shear in stability", "shear_theory");
    show_declared(chosen, "limitations", "limits");
    show_declared(chosen, "does not model", "lacks");
    show_features("supports", t->offers & ~theories);
    show_features("does not support", ~t->offers & (FEATURE_END - 1) & ~theories);
    show_options(t);
    if (rules != NULL)
        show_rules(chosen, rules, count);
    show_cases(t);
    printf("next: beamwork converge CASE -f %s; 'beamwork explain WORD' for any word above\n",
           chosen->key);
}

typedef struct list_request {
    case_options of;
    chosen_formulations chosen; /* formulations loaded by --element */
    truths_options truths;
    const char *format;
} list_request;

enum { NAMES = 27 };

static void list_formulations(void)
{
    printf("formulations ('beamwork list FORMULATION' describes one)\n");
    for (int i = 0; formulations_at(i) != NULL; i++)
        paragraph_write(stdout, printf("  %-*s", NAMES - 2, formulations_at(i)->name), NAMES,
                        formulations_at(i)->summary);
    printf("options of all formulations (-f NAME:OPTION=VALUE)\n");
    for (const parameter_type *o = formulation_common; o->name != NULL; o++)
        list_formulation_option(o);
}

static void list_features(void)
{
    printf("physics that a case can require and a formulation can support\n");
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        paragraph_write(stdout, printf("  %-*s", NAMES - 2, feature_name(bit)), NAMES,
                        feature_summary(bit));
}

static void list_cases(void)
{
    printf("cases ('beamwork list CASE' shows parameters and quantities)\n");
    for (int i = 0; registry_cases[i] != NULL; i++)
        paragraph_write(stdout, printf("  %-*s", NAMES - 2, registry_cases[i]->name), NAMES,
                        registry_cases[i]->summary);
}

static void list_offer(const scene *s, const element_type *type)
{
    runs_on here;
    const int at = printf("  %-28s ", type->name);
    runs_on_scene(s, type, &here);
    if (!here.runs)
        paragraph_write(stdout, at + printf("does not support "), at, here.words);
    else if (here.words[0] != '\0')
        paragraph_printf(stdout, at + printf("runs without "), at, "%s%s", here.words,
                         here.other ? " (another model)" : "");
    else
        printf("runs\n");
}

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

static void list_scene(const scene *s)
{
    printf("quantities with the default parameters (along a path: a curve)\n");
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

static void read_deviations(const list_request *r, truths *deviations)
{
    memset(deviations, 0, sizeof *deviations);
    truths_read_rules(user_tables_packed(&r->truths), deviations, NULL);
}

static void show_formulation(const list_request *r, const formulation *chosen)
{
    truths deviations;
    read_deviations(r, &deviations);
    list_formulation(chosen, deviations.rule, deviations.rules);
    truths_free(&deviations);
}

static int show(const list_request *r, const list_subject *what)
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

static status write_json(const list_subject *what, const truths *deviations, fault *f)
{
    if (what->type != NULL) {
        double value[CASE_MAX_PARAMETERS] = {0};
        parameters_default(what->type, value);
        return list_json_case(stdout, what->type, value, f);
    }
    if (what->chosen.type != NULL)
        return list_json_formulation(stdout, &what->chosen, deviations->rule, deviations->rules, f);
    return list_json_all(stdout, what->cases, what->formulations, f);
}

static int show_json(const list_request *r, const list_subject *what)
{
    truths deviations;
    fault f = {""};
    read_deviations(r, &deviations);
    const status written = write_json(what, &deviations, &f);
    truths_free(&deviations);
    return message_exit(written, &f);
}

static int answer(const command_line *l, void *request)
{
    list_request *r = request;
    (void)l;
    list_subject what = {.cases = 0};
    fault f;
    case_input_example(&r->of);
    if (r->of.scene_path != NULL) {
        what.type = case_input_scene(&r->of);
        if (what.type == NULL)
            return r->of.refusal;
    } else if (list_subject_find(r->of.name, &what, &f) != STATUS_OK)
        return message_fail(STATUS_REFUSED, f.text);
    return strcmp(r->format, "json") == 0 ? show_json(r, &what) : show(r, &what);
}

#define IN(at) .member = offsetof(list_request, at)
static const verb_group shared[] = {SHARED(scene, of),
                                    SHARED(element, chosen),
                                    SHARED(truths, truths),
                                    SHARED(record, format),
                                    {NULL, 0}};
const verb verb_list = {
    "list",
    "[cases|formulations|CASE|FORMULATION]",
    "lists cases and formulations, with parameters, quantities, orders and deviations",
    "Lists all cases and formulations. For a case it lists the parameters, the quantities and the "
    "formulations that support the case; for a formulation the theory, orders, options, features, "
    "limitations, known deviations and the supported cases.",
    "beamwork list\n"
    "beamwork list c_column\n"
    "beamwork list collocation",
    shared,
    NULL,
    sizeof(list_request),
    .place = VERB_LOOK + 10,
    .answer = answer};
