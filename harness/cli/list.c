#include <float.h>
#include <stdio.h>
#include <string.h>

#include "elements/feature.h"
#include "harness/catalogue/registry.h"
#include "harness/cli/cli.h"
#include "harness/model/lacks.h"
#include "harness/model/missing.h"
#include "harness/scene_writer/meaning.h"
#include "harness/study/cell.h"

static void list_option(const parameter_type *o)
{
    char text[ASSIGNMENT_VALUE];
    assignment_value_text(o, o->value, text, sizeof text);
    printf("  %-24s option %s=", "", o->name);
    if (o->choices != NULL)
        printf("%s", o->choices);
    else
        printf("%g..%g", o->min, o->max);
    printf(" (default %s): %s\n", text, o->summary);
}

static const char *other_theory(const element_type *t)
{
    if (t->own_theory != NULL)
        return t->own_theory;
    return t->shear_theories == 0 ? "none, rigid" : "";
}

/* What it is judged by. */
static void list_declarations(const element_type *t)
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    double options[ELEMENT_MAX_OPTIONS] = {0};
    parameter_defaults(t->options, options);
    printf("  %-24s order:", "");
    for (int a = 0; a < ELEMENT_ANALYSES; a++) {
        const element_order order = element_order_in(t, (element_analysis)a, options);
        printf(" %d to %d in %s%s", order.least, order.highest, analysis[a],
               a + 1 < ELEMENT_ANALYSES ? "," : "\n");
    }
    printf("  %-24s shear in stability: %s%s%s%s\n", "",
           t->shear_theories & SHEAR_ENGESSER ? "engesser" : "",
           t->shear_theories == (SHEAR_ENGESSER | SHEAR_HARINGX) ? " or " : "",
           t->shear_theories & SHEAR_HARINGX ? "haringx" : "", other_theory(t));
    if (t->lacks & LACKS_SHEAR_Y)
        printf("  %-24s lacks: shear flexibility along y (%s)\n", "", t->lacks_by);
}

static void list_formulations(void)
{
    printf("formulations (-f NAME[:KEY=VALUE,...])\n");
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *t = registry_formulations[i];
        char words[200];
        feature_words(t->offers & ~(unsigned)(FEATURE_ENGESSER | FEATURE_HARINGX), words,
                      sizeof words);
        printf("  %-24s %s\n  %-24s source: %s\n  %-24s offers: %s\n", t->name, t->summary, "",
               t->source, "", words);
        list_declarations(t);
        for (int k = 0; k < parameter_count(t->options); k++)
            list_option(parameter_at(t->options, k));
    }
    printf("  %-24s\n", "all of them");
    for (const parameter_type *o = formulation_common; o->name != NULL; o++)
        list_option(o);
}

static void list_features(void)
{
    printf("physics that a case can need and a formulation can offer\n");
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        printf("  %-24s %s\n", feature_name(bit), feature_summary(bit));
}

static void list_cases(void)
{
    printf("cases ('beamwork list CASE' shows parameters and quantities)\n");
    for (int i = 0; registry_cases[i] != NULL; i++)
        printf("  %-24s %s\n", registry_cases[i]->name, registry_cases[i]->summary);
}

static void list_offer(const scene *s, const element_type *type)
{
    char words[200];
    if (missing_words(s, type, words, sizeof words))
        printf("  %-28s does not offer %s\n", type->name, words);
    else if (lacks_of(s, type, words, sizeof words))
        printf("  %-28s runs without %s\n", type->name, words);
    else
        printf("  %-28s runs\n", type->name);
}

static void list_parameters(const case_type *type)
{
    printf("%s: %s\nsource: %s\nparameters (--set NAME=VALUE)\n", type->name, type->summary,
           type->source);
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(type->parameters, i)) != NULL; i++) {
        char text[ASSIGNMENT_VALUE];
        assignment_value_text(p, p->value, text, sizeof text);
        printf("  %-20s %-14s %-8s %s (", p->name, text, p->unit, p->summary);
        if (p->choices != NULL)
            printf("%s)\n", p->choices);
        else if (p->min == -DBL_MAX && p->max == DBL_MAX)
            printf("any)\n");
        else
            printf("%g .. %g)\n", p->min, p->max);
    }
}

/* What a case asks for at its default parameters, and who answers. */
static void list_scene(const scene *s)
{
    printf("quantities (along a path: a curve)\n");
    for (int i = 0; i < s->quantities; i++) {
        char meaning[MEANING_ROOM];
        meaning_of_quantity(s, i, meaning, sizeof meaning);
        printf("  %-28s %-8s %s\n", s->quantity[i].name, s->quantity[i].unit, meaning);
    }
    printf("formulations\n");
    for (int i = 0; registry_formulations[i] != NULL; i++)
        list_offer(s, registry_formulations[i]);
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

int cli_list(int count, char **arguments)
{
    command_request r;
    command_parse(
        "list", "[cases|formulations|CASE]",
        "Shows what there is: cases with their parameters and quantities, formulations with "
        "their options."
        "\vbeamwork list\n"
        "beamwork list c_column",
        "Y", count, arguments, &r);
    if (r.scene_count > 0) {
        const case_type *own = case_input_scene(&r);
        const int code = own != NULL ? list_case(own) : r.refusal;
        case_input_close(&r);
        return code;
    }
    if (r.case_name == NULL || strcmp(r.case_name, "cases") == 0)
        list_cases();
    if (r.case_name == NULL || strcmp(r.case_name, "formulations") == 0)
        list_formulations();
    if (r.case_name == NULL || strcmp(r.case_name, "formulations") == 0)
        list_features();
    if (r.case_name == NULL || strcmp(r.case_name, "cases") == 0 ||
        strcmp(r.case_name, "formulations") == 0)
        return EXIT_AS_EXPECTED;
    const case_type *type = case_input_find(&r);
    return type != NULL ? list_case(type) : EXIT_REFUSED;
}
