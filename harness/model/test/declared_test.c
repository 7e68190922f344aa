/* What every formulation says of itself: it does not contradict itself, and what it offers it can
 * do, alone, as the cases ask for it and in subsets. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/nodes.h"
#include "harness/catalogue/registry.h"
#include "harness/model/features.h"
#include "harness/model/missing.h"
#include "harness/model/test/contract.h"

typedef enum outcome { FINITE, REFUSED, BAD } outcome;

/* What becomes of an element that is asked for exactly these features, and why it is refused. */
static outcome evaluated(const element_type *type, unsigned features, fault *why)
{
    subject s;
    double d[MOST], inner[1024] = {0}, e[MOST_STRAINS], C[MOST_STRAINS * MOST_STRAINS];
    node_state x[ELEMENT_MAX_NODES];
    outcome found = FINITE;
    const status prepared = contract_prepare(type, features, 1, &s, why);
    if (prepared == STATUS_OK) {
        nodes_increments(s.nodes, s.length, 0.01, features + 1, d);
        nodes_place(s.nodes, s.length, d, x);
        s.type->strain(s.data, x, &(strain_output){.e = e});
        contract_rest(&s, inner);
        found =
            contract_settled(&s, e, inner, &(stress_output){.C = C}) == STATUS_OK ? FINITE : BAD;
        for (int i = 0; i < s.strains * s.strains && found == FINITE; i++)
            found = isfinite(C[i]) ? FINITE : BAD;
    } else
        found = prepared == STATUS_REFUSED && why->text[0] != '\0' ? REFUSED : BAD;
    free(s.data);
    return found;
}

static void accepted(const element_type *type, unsigned features, const char *what)
{
    fault why = {""};
    gsl_test(evaluated(type, features, &why) != FINITE, "%s: gives finite stiffness with %s %s",
             type->name, what, why.text);
}

/* A type cannot refuse: nothing, each feature that it offers with what that one presupposes,
 * everything that it offers for straight elements. */
static void single_features(const element_type *type)
{
    static const struct {
        unsigned feature, presupposes;
    } needs[] = {{FEATURE_ENGESSER, FEATURE_SHEAR},
                 {FEATURE_HARINGX, FEATURE_SHEAR},
                 {FEATURE_ROTARY_INERTIA, FEATURE_MASS}};
    accepted(type, 0, "no feature");
    accepted(type, type->offers & ~(unsigned)FEATURE_CURVATURE, "all features");
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1) {
        unsigned features = bit;
        for (size_t k = 0; k < sizeof needs / sizeof needs[0]; k++)
            features |= needs[k].feature == bit ? needs[k].presupposes : 0;
        if ((features & ~type->offers) == 0)
            accepted(type, features, feature_name(bit));
    }
}

/* Nor what the cases that it runs on ask for. */
static void features_of_cases(const element_type *type)
{
    int runs = 0;
    for (int i = 0; registry_cases[i] != NULL; i++) {
        double value[CASE_MAX_PARAMETERS];
        char words[FAULT_TEXT];
        fault f = {""};
        scene s;
        parameters_default(registry_cases[i], value);
        scene_init(&s, registry_cases[i]->name);
        gsl_test(registry_cases[i]->build(value, &s, &f) != STATUS_OK, "%s: built (%s)", s.name,
                 f.text);
        if (!missing_words(&s, type, words, sizeof words)) {
            accepted(type, features_needed_of(&s, type), registry_cases[i]->name);
            runs++;
        }
        scene_free(&s);
    }
    gsl_test(runs == 0, "%s: runs on %d cases", type->name, runs);
}

/* Other subsets may be refused by name, where one feature presupposes another: at most half. */
static void feature_subsets(const element_type *type)
{
    enum { OPTIONAL = 7 };
    static const unsigned optional[OPTIONAL] = {
        FEATURE_WARPING,       FEATURE_SHEAR,   FEATURE_TRAPEZE, FEATURE_WAGNER_MOMENTS,
        FEATURE_WAGNER_TORQUE, FEATURE_HARINGX, FEATURE_MASS};
    int count[BAD + 1] = {0};
    fault why = {""};
    for (unsigned subset = 0; subset < 1u << OPTIONAL; subset++) {
        unsigned features = type->offers & ~(unsigned)FEATURE_CURVATURE;
        for (int i = 0; i < OPTIONAL; i++)
            features &= subset >> i & 1u ? ~0u : ~optional[i];
        count[evaluated(type, features, &why)]++;
    }
    gsl_test(count[BAD] > 0, "%s: every subset of its features gives finite stiffness (%d do)",
             type->name, count[FINITE]);
    gsl_test(count[REFUSED] > count[FINITE], "%s: %d of its subsets are refused (%s)", type->name,
             count[REFUSED], why.text);
}

/* What a type says about itself does not contradict itself. */
static void declarations(const element_type *type)
{
    const int flexible = (type->offers & FEATURE_SHEAR) != 0,
              own = (type->shear_theories & SHEAR_OWN) != 0;
    gsl_test(flexible != (type->shear_theories != 0),
             "%s: flexible in shear, it has a theory of it", type->name);
    gsl_test(((type->offers & FEATURE_ENGESSER) != 0) !=
                     ((type->shear_theories & SHEAR_ENGESSER) != 0) ||
                 ((type->offers & FEATURE_HARINGX) != 0) !=
                     ((type->shear_theories & SHEAR_HARINGX) != 0),
             "%s: offers the theories of shear that it has", type->name);
    gsl_test(own && type->shear_theories != SHEAR_OWN, "%s: a theory of its own is its only one",
             type->name);
    gsl_test(own != (type->own_theory != NULL), "%s: a theory of its own has a name", type->name);
    gsl_test(type->family == NULL || type->family[0] == '\0' || strchr(type->family, ' ') != NULL,
             "%s: its family is a word", type->name);
    gsl_test((type->lacks != 0) != (type->lacks_by != NULL),
             "%s: what is lacking has its equations", type->name);
    gsl_test((type->lacks & LACKS_SHEAR_Y) && !flexible, "%s: what is lacking in part is offered",
             type->name);
    double options[ELEMENT_MAX_OPTIONS] = {0};
    parameter_defaults(type->options, options);
    for (int a = 0; a < ELEMENT_ANALYSES; a++) {
        const element_order order = element_order_in(type, (element_analysis)a, options);
        gsl_test(order.least < 1 || order.highest < order.least, "%s: orders %d to %d", type->name,
                 order.least, order.highest);
    }
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        gsl_test(type->abi != ELEMENT_ABI, "%s: version of the interface", type->name);
        declarations(type);
        single_features(type);
        features_of_cases(type);
        feature_subsets(type);
    }
    return gsl_test_summary();
}
