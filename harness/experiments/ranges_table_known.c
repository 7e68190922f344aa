#include <math.h>
#include <string.h>

#include "harness/experiments/ranges_points.h"
#include "harness/experiments/ranges_table_impl.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { LAST_KNOWN = 2 /* kind of reference */ };

/* Formulations that this reference is not for, at how many points. */
static void say_unmeasured(const tally *t, int q, char *text, size_t size)
{
    enum { NAMED = 3 };
    const long none = t->kind[q][ROWS_NONE] + t->kind[q][ROWS_DISPUTED];
    int count = 0;
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < t->of->formulations; i++) {
        const long open = tally_of(t, i, q)->open - none;
        if (open <= 0 || count++ >= NAMED)
            continue;
        used += (size_t)snprintf(text + used, size - used, "%s%s at %ld points",
                                 count > 1 ? ", " : "; not for ", t->of->formulation[i].key, open);
        used = used < size ? used : size - 1;
    }
    if (count > NAMED)
        snprintf(text + used, size - used, " and %d more", count - NAMED);
}

/* What a quantity is measured by, in words. */
static void say_reference(const tally *t, int q, char text[RANGES_TABLE_LINE])
{
    const long *kind = t->kind[q];
    const int alone = t->of->formulations == 1;
    const struct {
        long count;
        const char *words;
    } part[] = {
        {kind[ROWS_STORED], "a stored truth"},
        {kind[ROWS_DERIVED], "a truth derived there"},
        {kind[ROWS_LIMIT], alone ? "the limit from the same meshes, which shows convergence only"
                                 : "the limit of the meshes of all formulations of one theory"},
        {kind[ROWS_NONE],
         "nothing: no limit is known to half of the error (finer -n, or --derive)"},
        {kind[ROWS_DISPUTED], "nothing: limits of formulations disagree"}};
    size_t used = 0;
    int parts = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        if (part[i].count > 0)
            used += (size_t)snprintf(text + used, RANGES_TABLE_LINE - used, "%s%ld points by %s",
                                     parts++ > 0 ? "; " : "", part[i].count, part[i].words);
        if (i == LAST_KNOWN && parts > 0)
            used +=
                (size_t)snprintf(text + used, RANGES_TABLE_LINE - used,
                                 ", known to %.1g %% or better", 100 * fmax(t->doubt[q], 1e-16));
    }
    used = used < RANGES_TABLE_LINE ? used : RANGES_TABLE_LINE - 1;
    say_unmeasured(t, q, text + used, RANGES_TABLE_LINE - used);
}

/* Quantities that are measured by the same stand together. */
static void write_reference(FILE *to, const tally *t, int q, char told[])
{
    char text[RANGES_TABLE_LINE], other[RANGES_TABLE_LINE];
    paragraph words;
    const int begun = fprintf(to, "  %s", t->of->quantity[q].name);
    FILE *out = paragraph_begin(&words, to);
    say_reference(t, q, text);
    for (int i = q + 1; i < t->of->quantities; i++) {
        say_reference(t, i, other);
        if (told[i] || strcmp(text, other) != 0)
            continue;
        told[i] = 1;
        fprintf(out, ", %s", t->of->quantity[i].name);
    }
    fprintf(out, ": %s", text);
    paragraph_end(&words, begun, 6);
}

/* Why the first one has none. */
static void write_without_scene(FILE *to, const tally *t)
{
    const parameter_ranges *r = t->of;
    double at[CASE_MAX_PARAMETERS], value[CASE_MAX_PARAMETERS];
    char where[PARAMETERS_TEXT];
    scene s;
    fault why = {""};
    if (design_points(&r->design, t->first_without, 1, at, NULL) != STATUS_OK)
        return;
    ranges_points_values(r, at, value);
    ranges_points_text(r, at, where, sizeof where);
    cell_scene(r->request.type, value, NULL, &s, &why);
    scene_free(&s);
    paragraph_say(to, fprintf(to, "  %ld points have no scene", t->without_scene), 6,
                  ", the first at %s: %s", where, why.text);
}

void ranges_table_known(FILE *to, const tally *t)
{
    char told[RANGES_QUANTITIES] = {0};
    fprintf(to, "errors are measured by\n");
    for (int q = 0; q < t->of->quantities; q++)
        if (!told[q])
            write_reference(to, t, q, told);
    if (t->without_scene > 0)
        write_without_scene(to, t);
}
