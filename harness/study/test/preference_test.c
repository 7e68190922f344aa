/* The choice of a formulation and of a mesh, where nobody chose. */
#include "harness/study/study.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

typedef struct preference_chosen {
    status outcome;
    formulation one;
    char why[FAULT_TEXT];
} preference_chosen;

static preference_chosen choose(const scene *s, const case_type *type, const double value[],
                                const rule *rules, int count)
{
    preference_chosen out;
    fault f = {""};
    const rule_subject where = {.type = type, .parameter = value, .features = features_needed(s)};
    out.outcome = preference_formulation(s, &where, rules, count, &out.one, out.why, &f);
    return out;
}

/* A ledger of one rule. */
static rule made_up(char *formulations, char *cases, char *verdicts)
{
    static char any[] = "*", none[] = "";
    return (rule){.name = any,
                  .formulations = formulations,
                  .cases = cases,
                  .condition = none,
                  .quantities = any,
                  .verdicts = verdicts,
                  .predicted = none,
                  .cause = any,
                  .proof = any,
                  .largest_error = 1};
}

/* What is chosen offers all, and gives way to the ledger. */
static void of_case(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    char words[200], own[64], case_name[64], wrong[] = "wrong limit", doubt[] = "undecided",
                                             elsewhere[] = "another_case", any[] = "*";
    fault f = {""};
    scene s;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s: %s", type->name, f.text);
    const preference_chosen first = choose(&s, type, value, NULL, 0);
    const element_type *t = first.one.type;
    gsl_test(first.outcome != STATUS_OK || missing_words(&s, t, words, sizeof words) ||
                 lacks_of(&s, t, words, sizeof words),
             "%s: what is chosen offers all", type->name);
    snprintf(own, sizeof own, "%s", t->name);
    snprintf(case_name, sizeof case_name, "%s", type->name);
    const rule here = made_up(own, case_name, wrong), there = made_up(own, elsewhere, wrong),
               open = made_up(own, case_name, doubt), all = made_up(any, case_name, wrong);
    gsl_test(choose(&s, type, value, &here, 1).one.type == t, "%s: not with a defect here",
             type->name);
    gsl_test(choose(&s, type, value, &open, 1).one.type != t, "%s: a doubt is no defect",
             type->name);
    gsl_test(strstr(choose(&s, type, value, &all, 1).why, "but has a known defect here") == NULL,
             "%s: where all have one, it is said", type->name);
    const preference_chosen other = choose(&s, type, value, &there, 1);
    gsl_test(other.one.type == t && strstr(other.why, "no known defect here") == NULL,
             "%s: a defect elsewhere is none here", type->name);
    scene_free(&s);
}

/* The mesh is one of the scene's, or the finest of them doubled, and settled where nothing else is
 * said. */
static void of_meshes(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    preference found;
    fault f = {""};
    scene s;
    int here = -1;
    parameters_default(type, value);
    cell_scene(type, value, NULL, &s, &f);
    const preference_chosen first = choose(&s, type, value, NULL, 0);
    cell_request one = {.scene = &s};
    cell_formulation(&one, &first.one);
    gsl_test(preference_elements(&one, &first.one, PREFERENCE_ERROR, &found, &f) != STATUS_OK,
             "%s: %s", type->name, f.text);
    const int n = found.elements, finest = s.mesh[s.meshes - 1];
    for (int i = 0; i < s.meshes; i++)
        here = s.mesh[i] == n ? i : here;
    gsl_test(here < 0 && (n < finest || n % finest != 0), "%s: n = %d of its meshes", type->name,
             n);
    cell_result a, b;
    one.elements = n;
    gsl_test(cell_run(&one, &a, &f) != STATUS_OK, "%s: it solves %s", type->name, f.text);
    one.elements = here < 0 ? n / 2 : here > 0 ? s.mesh[here - 1] : n;
    const status before = cell_run(&one, &b, &f);
    for (int q = 0; q < s.quantities && !found.short_of; q++)
        if (s.quantity[q].reduction != SCENE_CURVE && isfinite(a.solve.quantity[q].value))
            gsl_test(before != STATUS_OK || here == 0 ||
                         !(fabs(verdict_error(&s.quantity[q], a.solve.quantity[q].value,
                                              b.solve.quantity[q].value)) <= PREFERENCE_ERROR),
                     "%s: %s has settled", type->name, s.quantity[q].name);
    cell_result_free(&a);
    cell_result_free(&b);
    preference_free(&found);
    scene_free(&s);
}

static void nothing_offers_all(void)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    scene s;
    const case_type *type = registry_cases[0];
    parameters_default(type, value);
    cell_scene(type, value, NULL, &s, &f);
    scene_demand(&s, FEATURE_END); /* which nobody has, and nobody can leave out */
    gsl_test(choose(&s, type, value, NULL, 0).outcome != STATUS_REFUSED, "refused");
    scene_free(&s);
}

/* Only one is accepted: it is chosen, or nothing is. */
static void no_new_one(void)
{
    const element_type *accepted = registry_formulations[0];
    int choices = 0;
    formulations_accept(accepted->name);
    for (int i = 0; registry_cases[i] != NULL; i++) {
        double value[CASE_MAX_PARAMETERS] = {0};
        fault f = {""};
        scene s;
        parameters_default(registry_cases[i], value);
        gsl_test(cell_scene(registry_cases[i], value, NULL, &s, &f) != STATUS_OK, "%s", f.text);
        const preference_chosen one = choose(&s, registry_cases[i], value, NULL, 0);
        choices += one.outcome == STATUS_OK;
        gsl_test(one.outcome == STATUS_OK && one.one.type != accepted, "%s: %s is chosen and new",
                 s.name, one.one.key);
        scene_free(&s);
    }
    gsl_test(choices == 0, "the accepted one is chosen");
}

int main(void)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        of_case(registry_cases[i]);
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (i % 4 == 0) /* a sample */
            of_meshes(registry_cases[i]);
    nothing_offers_all();
    no_new_one();
    return gsl_test_summary();
}
