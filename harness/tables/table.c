#include "harness/tables/table.h"

#include <math.h>

#include "cases/scene/omission.h"
#include "harness/judge/rounding.h"
#include "harness/model/features.h"
#include "harness/tables/paragraph.h"

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

void table_point(FILE *to, const point *p)
{
    fprintf(to, "%s%s%s", p->type->name, p->text[0] != '\0' ? ": " : "", p->text);
}

void table_omitted(FILE *to, const scene *s)
{
    char words[SCENE_OMISSION_WORDS];
    scene_omission_words(features_omitted(s), words);
    if (words[0] != '\0')
        paragraph_write(to, fprintf(to, "omitted: "), INDENT, words);
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
    const point *p = &s->point[one->point];
    char words[OMISSION_TEXT];
    fprintf(to, "%s%s%s%s, %s\n", p->type->name, p->text[0] != '\0' ? " (" : "", p->text,
            p->text[0] != '\0' ? ")" : "", one->formulation.key);
    omission_words(&one->without, words);
    if (words[0] != '\0')
        paragraph_write(to, 0, 2, words);
}
