#include "harness/terminal/table.h"

#include <math.h>
#include <string.h>

#include "cases/scene/omission.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"

enum { INDENT = 2 };

void table_percent(FILE *to, double error)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    fprintf(to, " %11s", text);
}

void table_known(FILE *to, int width, double value, double uncertainty)
{
    char text[ROUNDING_TEXT];
    rounding_known(value, uncertainty, text);
    fprintf(to, "%*s", width, text);
}

void table_digits(FILE *to, int width, double value, int digits)
{
    char text[ROUNDING_TEXT];
    rounding_digits(value, digits, text);
    fprintf(to, "%*s", width, text);
}

void table_value(FILE *to, int width, int digits, char conversion, double value)
{
    if (!isfinite(value))
        fprintf(to, "%*s", width, "-");
    else if (conversion == 'g')
        fprintf(to, "%*.*g", width, digits, value);
    else if (conversion == 'e')
        fprintf(to, "%*.*e", width, digits, value);
    else
        fprintf(to, "%*.*f", width, digits, value);
}

void table_point(FILE *to, const sweep_point *p)
{
    fprintf(to, "%s%s%s", p->type->name, p->text[0] != '\0' ? ": " : "", p->text);
}

/* What the source of a case leaves out, where the case was asked for whole. */
static unsigned omitted_by_source(const sweep_point *p)
{
    double value[CASE_MAX_PARAMETERS];
    scene s = {0};
    unsigned omitted = 0;
    memcpy(value, p->parameter, sizeof value);
    value[parameters_count(p->type) - 1] = 0;
    if (cell_scene(p->type, value, NULL, &s, NULL) == STATUS_OK)
        omitted = features_omitted(&s);
    scene_free(&s);
    return omitted;
}

static void assumed(FILE *to, const sweep_point *p)
{
    assumption a;
    for (int i = 0; assumptions_at(p, i, &a); i++)
        paragraph_write(to, fprintf(to, "%s: ", assumptions_kind(a.kind)), INDENT, a.text);
}

/* Members that have more elements than the mesh says. */
static void divided(FILE *to, const sweep_point *p)
{
    char words[FAULT_TEXT];
    division_words(&p->scene, 0, words, sizeof words);
    if (words[0] != '\0')
        paragraph_write(to, fprintf(to, "divided: "), INDENT, words);
}

void table_omitted(FILE *to, const sweep_point *p)
{
    assumed(to, p);
    divided(to, p);
    const int whole = case_omits_nothing(p->type, p->parameter);
    char words[SCENE_OMISSION_WORDS];
    scene_omission_words(whole ? omitted_by_source(p) : features_omitted(&p->scene), words);
    if (words[0] != '\0' && !whole)
        paragraph_write(to, fprintf(to, "omitted: "), INDENT, words);
    if (whole && words[0] == '\0')
        paragraph_say(to, fprintf(to, "omitted: "), INDENT,
                      "nothing, as without omit=none, which shows the values that are stored");
    else if (whole)
        paragraph_say(to, fprintf(to, "omitted: "), INDENT,
                      "nothing, where the source of the case leaves out %s: values that are stored "
                      "of it are of another model, and not shown",
                      words);
}

void table_theory(FILE *to, const scene *s, const element_type *type)
{
    const char *words = features_theory_words(type, features_theory(s, type));
    if (words[0] != '\0')
        paragraph_write(to, fprintf(to, "shear in stability: "), INDENT, words);
}

void table_series(FILE *to, const sweep *s, int index)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    char words[OMISSION_TEXT];
    fprintf(to, "%s%s%s%s, %s\n", p->type->name, p->text[0] != '\0' ? " (" : "", p->text,
            p->text[0] != '\0' ? ")" : "", one->formulation.key);
    omission_words(&one->without, words);
    if (words[0] != '\0')
        paragraph_write(to, 0, 2, words);
}
