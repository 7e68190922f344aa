/* What a type offers it can do: alone, in subsets, and as the cases ask for it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/effects.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

typedef enum feature_outcome { FINITE, REFUSED, BAD, FEATURE_OUTCOMES } feature_outcome;

/* C of a moved element is all numbers. */
static int finite_stiffness(const specimen *s, unsigned seed)
{
    double inner[SPECIMEN_INNER], e[SPECIMEN_STRAINS], C[SPECIMEN_STRAINS * SPECIMEN_STRAINS];
    node_state x[ELEMENT_MAX_NODES];
    specimen_state(s, 0.01, seed, x);
    s->type.strain(s->data, x, &(strain_output){.e = e});
    specimen_rest(s, inner);
    if (specimen_settled(s, e, inner, &(stress_output){.C = C}) != STATUS_OK)
        return 0;
    for (int i = 0; i < s->strains * s->strains; i++)
        if (!isfinite(C[i]))
            return 0;
    return 1;
}

/* What becomes of an element that is asked for exactly these, and why it is refused. */
static feature_outcome evaluated(const formulation *chosen, unsigned features, fault *why)
{
    const specimen_request what = {
        .given = chosen->type, .options = chosen->option, .features = features, .unit = 1};
    specimen s;
    feature_outcome out = BAD;
    const status made = specimen_make(&what, &s, why);
    if (made == STATUS_OK)
        out = finite_stiffness(&s, features + 1) ? FINITE : BAD;
    else if (made == STATUS_REFUSED && why->text[0] != '\0')
        out = REFUSED;
    else if (why->text[0] == '\0')
        fault_set(why, made, "no reason is given (status '%s')", status_name(made));
    specimen_free(&s);
    return out;
}

static void accepted(const formulation *chosen, unsigned features, const char *what, claims *c)
{
    fault why = {""};
    claims_doing(c, "prepare, strain and stress with %s", what);
    const feature_outcome found = evaluated(chosen, features, &why);
    claims_asks(claims_open(c, "all it offers is given", 0), found == FINITE,
                "offers: asked for %s, %s%s; give it, or do not offer it", what,
                why.text[0] != '\0' ? "it is refused: " : "the stiffness is not finite", why.text);
}

/* A type cannot refuse: nothing, each feature that it offers with what that one presupposes,
 * everything that it offers for straight elements. */
static void single_features(const formulation *chosen, claims *c)
{
    static const struct {
        unsigned feature, presupposes;
    } needs[] = {{FEATURE_ENGESSER, FEATURE_SHEAR},
                 {FEATURE_HARINGX, FEATURE_SHEAR},
                 {FEATURE_ROTARY_INERTIA, FEATURE_MASS}};
    const unsigned offers = chosen->type->offers;
    accepted(chosen, 0, "no feature", c);
    accepted(chosen, offers & ~(unsigned)FEATURE_CURVATURE, "all features", c);
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1) {
        unsigned features = bit;
        for (size_t k = 0; k < sizeof needs / sizeof needs[0]; k++)
            features |= needs[k].feature == bit ? needs[k].presupposes : 0;
        if ((features & ~offers) == 0)
            accepted(chosen, features, feature_name(bit), c);
    }
}

/* Nor what the cases that it runs on ask for. */
static void features_of_cases(const formulation *chosen, claims *c)
{
    int runs = 0;
    for (int i = 0; registry_cases[i] != NULL; i++) {
        double value[CASE_MAX_PARAMETERS];
        char words[FAULT_TEXT];
        scene s;
        parameters_default(registry_cases[i], value);
        scene_init(&s, registry_cases[i]->name);
        if (case_build(registry_cases[i], value, &s, NULL) == STATUS_OK &&
            !missing_words(&s, chosen->type, words, sizeof words)) {
            accepted(chosen, features_needed_of(&s, chosen->type), registry_cases[i]->name, c);
            runs++;
        }
        scene_free(&s);
    }
    if (registry_cases[0] != NULL)
        claims_asks(claims_open(c, "cases", 0), runs > 0,
                    "offers, limits: none of the built-in cases can be run with what it offers");
}

/* Other subsets may be refused by name, where one feature presupposes another: at most half. */
static void feature_subsets(const formulation *chosen, claims *c)
{
    enum { OPTIONAL = 7 };
    static const unsigned optional[OPTIONAL] = {
        FEATURE_WARPING,       FEATURE_SHEAR,   FEATURE_TRAPEZE, FEATURE_WAGNER_MOMENTS,
        FEATURE_WAGNER_TORQUE, FEATURE_HARINGX, FEATURE_MASS};
    claim *finite = claims_open(c, "subsets", 0), *few = claims_open(c, "few refused", 0.5);
    int count[FEATURE_OUTCOMES] = {0};
    for (unsigned subset = 0; subset < 1u << OPTIONAL; subset++) {
        unsigned features = chosen->type->offers & ~(unsigned)FEATURE_CURVATURE;
        char words[200];
        fault why = {""};
        for (int i = 0; i < OPTIONAL; i++)
            features &= subset >> i & 1u ? ~0u : ~optional[i];
        feature_words(features, words, sizeof words);
        claims_doing(c, "prepare, strain and stress with %s", words);
        const feature_outcome found = evaluated(chosen, features, &why);
        count[found]++;
        claims_asks(finite, found != BAD,
                    "prepare: asked for %s alone, %s; give it, or refuse it with a reason", words,
                    why.text[0] != '\0' ? why.text : "the stiffness is not finite");
    }
    claims_departs(few, (double)count[REFUSED] / (1 << OPTIONAL),
                   "prepare: %d of %d subsets of what it offers are refused; at most half may be, "
                   "where one feature presupposes another",
                   count[REFUSED], 1 << OPTIONAL);
}

void checks_features(const formulation *chosen, claims *out)
{
    single_features(chosen, out);
    features_of_cases(chosen, out);
    feature_subsets(chosen, out);
    effects_check(chosen, out);
}
