/* What a type says of itself. */
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"

static void theories(const element_type *t, claim *one)
{
    const int flexible = (t->offers & FEATURE_SHEAR) != 0,
              own = (t->shear_theories & SHEAR_OWN) != 0;
    claims_asks(one, flexible == (t->shear_theories != 0),
                flexible ? "shear_theories: it offers shear and names no theory of it; set "
                           "SHEAR_ENGESSER, SHEAR_HARINGX or SHEAR_OWN"
                         : "shear_theories: it has a theory of shear and does not offer "
                           "FEATURE_SHEAR; set one or leave out the other");
    claims_asks(
        one,
        ((t->offers & FEATURE_ENGESSER) != 0) == ((t->shear_theories & SHEAR_ENGESSER) != 0) &&
            ((t->offers & FEATURE_HARINGX) != 0) == ((t->shear_theories & SHEAR_HARINGX) != 0),
        "shear_theories: FEATURE_ENGESSER or FEATURE_HARINGX is offered without its theory, "
        "or the other way round");
    claims_asks(one, !own || t->shear_theories == SHEAR_OWN,
                "shear_theories: SHEAR_OWN stands beside another one; a theory of its own is the "
                "only one");
    claims_asks(one, own == (t->own_theory != NULL),
                own ? "own_theory: say in a line what SHEAR_OWN is and where it is derived"
                    : "own_theory: it is given, and shear_theories has no SHEAR_OWN");
}

static void words(const element_type *t, claim *one)
{
    claims_asks(one, t->family != NULL && t->family[0] != '\0' && strchr(t->family, ' ') == NULL,
                "family: give one word");
    claims_asks(one,
                t->summary != NULL && t->summary[0] != '\0' && strchr(t->summary, '\n') == NULL,
                "summary: give one line");
    claims_asks(one, t->source != NULL && t->source[0] != '\0',
                "source: name the paper and its equations");
    claims_asks(one, (t->lacks != 0) == (t->lacks_by != NULL),
                t->lacks != 0 ? "lacks_by: name the equations that omit it"
                              : "lacks_by: it is given, and nothing is in lacks");
    claims_asks(one, !(t->lacks & LACKS_SHEAR_Y) || t->offers & FEATURE_SHEAR,
                "lacks: LACKS_SHEAR_Y is for types that support shear; remove it");
    claims_asks(one, !(t->offers & FEATURE_ROTARY_INERTIA) || t->offers & FEATURE_MASS,
                "offers: FEATURE_ROTARY_INERTIA goes with FEATURE_MASS");
    claims_asks(one, ((t->limits & LIMIT_TENSION) != 0) == (t->tension != NULL),
                "tension: it goes with LIMIT_TENSION; give both or leave both out");
    claims_asks(one, !t->spreads || (t->inertia != NULL && t->offers & FEATURE_MASS),
                "spreads: it goes with 'inertia' and FEATURE_MASS; give them or remove it");
}

static void orders(const formulation *chosen, claim *one)
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    for (int a = 0; a < ELEMENT_ANALYSES; a++) {
        const element_order order =
            element_order_in(chosen->type, (element_analysis)a, chosen->option);
        claims_asks(one, order.least >= 1 && order.highest >= order.least,
                    "order: %d to %d in %s; give least >= 1 and highest >= least", order.least,
                    order.highest, analysis[a]);
    }
}

static void sizes(const formulation *chosen, claim *one)
{
    const element_type *t = chosen->type;
    const int inner = element_inner(t, chosen->option), memory = element_memory(t, chosen->option);
    claims_asks(one, inner == 0 || t->update != NULL,
                "update: it has %d unknowns of its own, which nothing corrects", inner);
    claims_asks(one, inner == 0 || memory > 0,
                "memory: it has %d unknowns of its own, and nothing is kept for update", inner);
    claims_asks(one, inner >= 0 && memory >= 0, "inner, memory: %d and %d are negative", inner,
                memory);
}

static void options(const element_type *t, claim *one)
{
    const int count = parameter_count(t->options);
    claims_asks(one, count <= ELEMENT_MAX_OPTIONS, "options: %d of them; at most %d have room",
                count, ELEMENT_MAX_OPTIONS);
    for (int i = 0; i < count; i++) {
        const parameter_type *o = parameter_at(t->options, i);
        const int choices = parameter_choices(o);
        claims_asks(one,
                    choices > 0 ? o->value >= 0 && o->value < choices
                                : o->value >= o->min && o->value <= o->max,
                    "options: the default of '%s' is outside its range", o->name);
        claims_asks(one, o->summary != NULL && o->summary[0] != '\0',
                    "options: say in a line what '%s' does", o->name);
    }
}

void checks_declared(const formulation *chosen, claims *out)
{
    claims_doing(out, "what it says of itself");
    theories(chosen->type, claims_open(out, "theories of shear", 0));
    words(chosen->type, claims_open(out, "words and limits", 0));
    orders(chosen, claims_open(out, "orders", 0));
    sizes(chosen, claims_open(out, "sizes", 0));
    options(chosen->type, claims_open(out, "options", 0));
}
