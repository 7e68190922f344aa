#include "harness/experiments/specimens.h"

#include <stdio.h>
#include <string.h>

/* The words of what is not usual about it. */
static void describe(const specimen_request *what, const formulation *chosen, specimen *s)
{
    static const char *const section_words[] = {"", ", unsymmetric section",
                                                ", section by its matrices"};
    const char *options = strchr(chosen->key, ':');
    const int curved = what->curvature[0] != 0 || what->curvature[2] != 0;
    snprintf(s->words, sizeof s->words, "%s%.80s%s%s", options != NULL ? ", with " : "",
             options != NULL ? options + 1 : "", section_words[what->form],
             curved ? ", initially curved" : "");
}

/* One way of making it. */
typedef struct way {
    const formulation *chosen;
    specimen_request made;
    int usual; /* 1: it must be possible */
} way;

static const char failure[] = "its functions give answers";

/* Where the formulation's own code fails, that is the one cause of all that would depart. */
static int gives_answers(const specimen *s, claims *c)
{
    node_state x[ELEMENT_MAX_NODES];
    double e[SPECIMEN_STRAINS], J[SPECIMEN_STRAINS * SPECIMEN_COORDINATES], inner[SPECIMEN_INNER],
        energy;
    if (s->type.trouble == NULL)
        return 1;
    claims_doing(c, "strain, stress%s", s->words);
    specimen_state(s, 0.04, 41, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J});
    specimen_rest(s, inner);
    specimen_settled(s, e, inner, &(stress_output){.energy = &energy});
    const char *why = s->type.trouble(s->data);
    if (why == NULL)
        return 1;
    c->count = 0;
    claims_asks(claims_open(c, failure, 0), 0, "%s%s; the rest is not checked", why, s->words);
    return 0;
}

static void one_way(const way *w, claims *c, specimens_check *check)
{
    specimen s;
    fault f = {""};
    if (c->count > 0 && strcmp(c->claim[0].name, failure) == 0)
        return;
    claims_doing(c, "prepare");
    const status outcome = specimen_make(&w->made, &s, &f);
    describe(&w->made, w->chosen, &s);
    const int refused = outcome == STATUS_REFUSED && f.text[0] != '\0';
    claims_asks(
        claims_open(c, "prepare", 0), outcome == STATUS_OK || (refused && !w->usual),
        "prepare: an element%s is refused (%s): %s; give it, or refuse it with a reason and "
        "do not offer it",
        s.words[0] != '\0' ? s.words + 1 : " of a rectangle with all that is offered",
        status_name(outcome), f.text[0] != '\0' ? f.text : "no reason is given");
    if (outcome == STATUS_OK && gives_answers(&s, c))
        check(&s, c);
    specimen_free(&s);
}

/* Of every section that it takes, straight and curved. */
static void all_forms(const formulation *chosen, claims *c, specimens_check *check)
{
    const element_type *t = chosen->type;
    way w = {
        .chosen = chosen,
        .usual = 1,
        .made = {
            .given = t, .options = chosen->option, .features = specimen_features(t, 0), .unit = 1}};
    one_way(&w, c, check);
    w.usual = 0;
    if (!(t->limits & LIMIT_DOUBLY_SYMMETRIC) && t->offers & FEATURE_ECCENTRIC) {
        w.made.form = PROFILES_UNSYMMETRIC;
        one_way(&w, c, check);
    }
    if (t->offers & FEATURE_COUPLED) {
        w.made.form = PROFILES_MATRICES;
        w.made.features =
            t->offers & ~(unsigned)(FEATURE_CURVATURE | FEATURE_WARPING | FEATURE_WAGNER_TORQUE);
        one_way(&w, c, check);
    }
    if (t->offers & FEATURE_CURVATURE) {
        w.made.form = PROFILES_RECTANGLE;
        w.made.features =
            (specimen_features(t, 0) | FEATURE_CURVATURE) & ~(unsigned)FEATURE_WAGNER_TORQUE;
        w.made.curvature[0] = 0.2;
        w.made.curvature[1] = 0.3;
        w.made.curvature[2] = 0.9;
        one_way(&w, c, check);
    }
}

/* Each choice of an option, the others as they are. */
static void other_choices(const formulation *chosen, int option, claims *c, specimens_check *check)
{
    const assignment_list list = formulation_options(chosen->type);
    const parameter_type *o = parameter_at(chosen->type->options, option);
    for (int k = 0; k < parameter_choices(o); k++) {
        formulation other = *chosen;
        char value[ASSIGNMENT_VALUE];
        if (k == (int)chosen->option[option])
            continue;
        other.option[option] = k;
        assignment_value_text(o, k, value, sizeof value);
        snprintf(other.key, sizeof other.key, "%s:", chosen->type->name);
        assignment_text(&list, other.option, other.key + strlen(other.key),
                        (int)(sizeof other.key - strlen(other.key)));
        all_forms(&other, c, check);
    }
}

void specimens_each(const formulation *chosen, claims *c, specimens_check *check)
{
    all_forms(chosen, c, check);
    for (int i = 0; i < parameter_count(chosen->type->options); i++)
        other_choices(chosen, i, c, check);
}
