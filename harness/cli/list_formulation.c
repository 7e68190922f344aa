#include "harness/cli/list_formulation.h"

#include <stdio.h>
#include <string.h>

#include "elements/feature.h"
#include "harness/experiments/runs_on.h"
#include "harness/records/schema.h"
#include "harness/terminal/paragraph.h"

enum { COLUMN = 26, LINE = 4000 };

static const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;

/* A text whose further lines are indented by two more. */
static void hang(int indent, const char *text)
{
    const int word = (int)strcspn(text, " ");
    paragraph_write(stdout, printf("%*s%.*s ", indent, "", word, text), indent + 2, text + word);
}

/* What it declares, as result files have it; returns the text of a field, or its number. */
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
    printf(inner > 0 ? ", %ld unknowns inside\n" : "\n", inner);
    for (int i = 0; i < 4; i++) {
        const long least = declared(chosen, order[i][0], &v);
        used += snprintf(orders + used, sizeof orders - (size_t)used, "%s%ld to %ld in %s",
                         i > 0 ? ", " : "", least, declared(chosen, order[i][1], &v), analysis[i]);
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

void list_formulation_option(const parameter_type *o)
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

/* Where, and what comes of it. */
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
        if (!rules_speak_of(r, chosen->key))
            continue;
        if (found++ == 0)
            printf("known findings ('beamwork explain RULE' shows the proof)\n");
        paragraph_write(stdout, printf("  %s: ", r->name), 4, r->cause);
        show_verdicts(r);
    }
    if (found == 0)
        printf("known findings: none\n");
}

/* Those of one kind whose words are the same, behind the first of them. */
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
            show_alike(all, count, i, "not run, for want of ");
}

void list_formulation(const formulation *chosen, const rule *rules, int count)
{
    const element_type *t = chosen->type;
    paragraph_write(stdout, printf("%s: ", chosen->key), 2, t->summary);
    show_declared(chosen, "source", "source");
    show_declared(chosen, "family", "family");
    show_numbers(chosen);
    show_declared(chosen, "shear in stability", "shear_theory");
    show_declared(chosen, "restricted to", "limits");
    show_declared(chosen, "lacks", "lacks");
    show_features("offers", t->offers & ~theories);
    show_features("does not offer", ~t->offers & (FEATURE_END - 1) & ~theories);
    show_options(t);
    if (rules != NULL)
        show_rules(chosen, rules, count);
    show_cases(t);
    printf("next: beamwork converge CASE -f %s; 'beamwork explain WORD' for any word above\n",
           chosen->key);
}
