#include "harness/experiments/experiments.h"

#include <float.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/feature.h"
#include "elements/shared/choice.h"
#include "harness/model/model.h"

enum { MOST_CASES = 256 };

static json_t *value_of(const parameter_type *p, double value)
{
    char word[ASSIGNMENT_VALUE];
    if (p->choices == NULL)
        return json_real(value);
    choice_name(p->choices, (int)value, word, sizeof word);
    return json_string(word);
}

static json_t *choices_of(const parameter_type *p)
{
    json_t *list = json_array();
    for (int i = 0; i < parameter_choices(p); i++)
        json_array_append_new(list, value_of(p, i));
    return list;
}

static json_t *bound_of(const parameter_type *p, double value)
{
    const int none = p->choices != NULL || value <= -DBL_MAX || value >= DBL_MAX;
    return none ? json_null() : json_real(value);
}

/* Returns the parameters as a list. value NULL: default values. */
static json_t *parameters_of(const assignment_list *all, const double value[])
{
    json_t *list = json_array();
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(all->part, i)) != NULL; i++)
        json_array_append_new(
            list, json_pack("{s:s,s:s,s:o,s:o,s:o,s:o,s:o,s:s}", "name", p->name, "unit", p->unit,
                            "value", value_of(p, value != NULL ? value[i] : p->value), "default",
                            value_of(p, p->value), "min", bound_of(p, p->min), "max",
                            bound_of(p, p->max), "choices", choices_of(p), "summary", p->summary));
    return list;
}

static json_t *quantities_of(const scene *s)
{
    json_t *list = json_array();
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        char meaning[MEANING_ROOM];
        meaning_of_quantity(s, i, meaning, sizeof meaning);
        json_array_append_new(list, json_pack("{s:s,s:s,s:s,s:b}", "name", q->name, "unit", q->unit,
                                              "meaning", meaning, "is_curve",
                                              q->reduction == SCENE_CURVE));
    }
    return list;
}

static json_t *runs_of(const char *what, const runs_on *r)
{
    return json_pack("{s:s,s:b,s:s,s:b}", what, r->name, "runs", r->runs, "without", r->words,
                     "other_model", r->other);
}

static json_t *declaration_of(const formulation *chosen)
{
    const series one = {.formulation = *chosen};
    const subject s = {.series = &one};
    const assignment_list options = formulation_options(chosen->type);
    json_t *out = json_record(&record_declaration, &s, KEY);
    json_object_set_new(out, "options", parameters_of(&options, chosen->option));
    return out;
}

static json_t *all_cases(void)
{
    json_t *list = json_array();
    for (int i = 0; registry_cases[i] != NULL; i++)
        json_array_append_new(list, json_pack("{s:s,s:s,s:s}", "case", registry_cases[i]->name,
                                              "summary", registry_cases[i]->summary, "source",
                                              registry_cases[i]->source));
    return list;
}

static json_t *all_formulations(void)
{
    json_t *list = json_array();
    formulation one;
    for (int i = 0; formulations_at(i) != NULL; i++) {
        formulation_default(formulations_at(i), &one);
        json_array_append_new(list, declaration_of(&one));
    }
    return list;
}

static json_t *all_physics(void)
{
    json_t *list = json_array();
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        json_array_append_new(list, json_pack("{s:s,s:s}", "name", feature_name(bit), "summary",
                                              feature_summary(bit)));
    return list;
}

static json_t *begin(void)
{
    return json_pack("{s:i}", "schema_version", SCHEMA_VERSION);
}

status list_json_all(FILE *to, int cases, int formulations, fault *f)
{
    json_t *root = begin();
    if (cases)
        json_object_set_new(root, "cases", all_cases());
    if (formulations) {
        json_object_set_new(root, "formulations", all_formulations());
        json_object_set_new(root, "physics", all_physics());
    }
    return json_finish(root, to, f);
}

static json_t *scene_of(const case_type *type, const double value[], const scene *s)
{
    const assignment_list all = parameters_list(type);
    json_t *root = begin(), *list = json_array();
    json_object_set_new(root, "case", json_string(type->name));
    json_object_set_new(root, "summary", json_string(type->summary));
    json_object_set_new(root, "source", json_string(type->source));
    json_object_set_new(root, "parameters", parameters_of(&all, value));
    json_object_set_new(root, "quantities", quantities_of(s));
    for (int i = 0; formulations_at(i) != NULL; i++) {
        runs_on one;
        runs_on_scene(s, formulations_at(i), &one);
        json_array_append_new(list, runs_of("formulation", &one));
    }
    json_object_set_new(root, "formulations", list);
    return root;
}

status list_json_case(FILE *to, const case_type *type, const double value[], fault *f)
{
    scene s = {0};
    status outcome = cell_scene(type, value, NULL, &s, f);
    if (outcome == STATUS_OK)
        outcome = json_finish(scene_of(type, value, &s), to, f);
    scene_free(&s);
    return outcome;
}

static json_t *deviations_of(const formulation *chosen, const rule *rules, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        if (rules_apply_to(&rules[i], chosen->key))
            json_array_append_new(
                list, json_pack("{s:s,s:s,s:s,s:s,s:s,s:s,s:s}", "rule", rules[i].name, "cases",
                                rules[i].cases, "condition", rules[i].condition, "quantities",
                                rules[i].quantities, "verdicts", rules[i].verdicts, "cause",
                                rules[i].cause, "proof", rules[i].proof));
    return list;
}

status list_json_formulation(FILE *to, const formulation *chosen, const rule *rules, int count,
                             fault *f)
{
    runs_on all[MOST_CASES];
    json_t *root = begin(), *list = json_array();
    json_object_update_new(root, declaration_of(chosen));
    json_object_set_new(root, "findings",
                        rules != NULL ? deviations_of(chosen, rules, count) : json_null());
    const int cases = runs_on_cases(chosen->type, all, MOST_CASES);
    for (int i = 0; i < cases; i++)
        json_array_append_new(list, runs_of("case", &all[i]));
    json_object_set_new(root, "cases", list);
    return json_finish(root, to, f);
}

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

static status refuse(const char *name, fault *f)
{
    const char *near = choice_nearest(name, name_at, NULL);
    return fault_set(
        f, STATUS_REFUSED,
        "'%.60s' is neither a case nor a formulation%s%s%s'beamwork list' shows all of them", name,
        near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
        near != NULL ? "'? " : "; ");
}

status list_subject_find(const char *name, list_subject *out, fault *f)
{
    char bare[SCENE_NAME];
    memset(out, 0, sizeof *out);
    out->cases = name == NULL || strcmp(name, "cases") == 0;
    out->formulations = name == NULL || strcmp(name, "formulations") == 0;
    if (out->cases || out->formulations)
        return STATUS_OK;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0) {
            out->type = registry_cases[i];
            return STATUS_OK;
        }
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(name, ":"), name);
    return formulation_find(bare) != NULL ? formulation_parse(name, &out->chosen, f)
                                          : refuse(name, f);
}

static void look_at(const scene *s, const element_type *type, runs_on *out)
{
    const unsigned omits = missing_omits(s, type);
    *out = (runs_on){.name = type->name};
    out->runs = !missing_refused(s, type, out->words, sizeof out->words);
    if (!out->runs)
        return;
    if (omits != 0)
        missing_omit_words(omits, out->words);
    else if (!lacks_of(s, type, out->words, sizeof out->words))
        out->words[0] = '\0';
}

void runs_on_scene(const scene *s, const element_type *type, runs_on *out)
{
    omission without;
    look_at(s, type, out);
    if (!out->runs || missing_omits(s, type) == 0)
        return;
    omission_of(s, type, &without);
    out->other = without.other;
}

int runs_on_cases(const element_type *type, runs_on out[], int room)
{
    int count = 0;
    for (; registry_cases[count] != NULL && count < room; count++) {
        const case_type *here = registry_cases[count];
        double value[CASE_MAX_PARAMETERS] = {0};
        scene s;
        parameters_default(here, value);
        out[count] = (runs_on){.runs = 0};
        if (cell_scene(here, value, NULL, &s, NULL) == STATUS_OK)
            look_at(&s, type, &out[count]);
        out[count].name = here->name;
        scene_free(&s);
    }
    return count;
}
