#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

enum { SHOWN_MESHES = 7 };

static void write_axis(FILE *to, const parameter_ranges *r, int index)
{
    const sweep_axis *a = &r->axis[index];
    const char *unit = strcmp(a->of->unit, "1") == 0 ? "" : a->of->unit;
    char text[RANGES_TABLE_LINE];
    int used = 0;
    if (a->value == NULL)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, "%.6g .. %.6g%s%s%s", a->from, a->to,
                     unit[0] != '\0' ? " " : "", unit, a->kind == AXIS_LOG ? ", logarithmic" : "");
    for (int i = 0;
         a->value != NULL && i < a->count && used < RANGES_TABLE_LINE - ASSIGNMENT_VALUE - 2; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(a, a->value[i], word, sizeof word);
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", i > 0 ? ", " : "", word);
    }
    if (a->count > 0)
        snprintf(text + used, sizeof text - (size_t)used, ": %d value%s", a->count,
                 a->count == 1 ? "" : "s");
    paragraph_write(to, fprintf(to, "  %s ", a->of->name), 4, text);
}

void ranges_table_head(FILE *to, const parameter_ranges *r)
{
    const long runs = r->design.points * r->formulations * r->meshes;
    char fixed[PARAMETERS_TEXT], seed[60] = "";
    parameters_text(r->request.type, r->base, fixed, sizeof fixed);
    if (r->design.kind == DESIGN_RANDOM)
        snprintf(seed, sizeof seed, ", seed %lu", r->design.seed);
    paragraph_printf(to, fprintf(to, "%s", r->request.type->name), 2,
                     "%s%s: %ld point%s (%s%s), %d %s, %d %s: %ld run%s",
                     fixed[0] != '\0' ? ", " : "", fixed, r->design.points,
                     r->design.points == 1 ? "" : "s", design_name(r->design.kind), seed,
                     r->formulations, r->formulations == 1 ? "formulation" : "formulations",
                     r->meshes, r->meshes == 1 ? "mesh" : "meshes", runs, runs == 1 ? "" : "s");
    for (int i = 0; i < r->design.axes; i++)
        write_axis(to, r, i);
    if (r->omitted[0] != '\0')
        paragraph_printf(to, fprintf(to, "  omitted: "), 4, "%s", r->omitted);
    if (r->assumed[0] != '\0')
        paragraph_write(to, fprintf(to, "  "), 4, r->assumed);
    if (r->left_out[0] != '\0')
        paragraph_printf(to, fprintf(to, "  omitted: "), 4, "%s", r->left_out);
}

/* Writes a percentage. 99.96 % is not rounded to 100 %. */
static void write_share(FILE *to, long part, long all)
{
    if (part == all)
        fprintf(to, "%*s", RANGES_TABLE_COLUMN, "all");
    else if (part == 0)
        fprintf(to, "%*s", RANGES_TABLE_COLUMN, "none");
    else {
        const double share = 100.0 * (double)part / (double)all;
        fprintf(to, "%*.*f%%", RANGES_TABLE_COLUMN - 1, share < 9.95 || share > 99 ? 1 : 0,
                fmax(0.1, fmin(share, 99.9)));
    }
}

static int finest_shown(const parameter_ranges *r)
{
    return r->meshes < SHOWN_MESHES ? r->meshes : SHOWN_MESHES;
}

static void write_line(FILE *to, const tally *t, int which, int q)
{
    const parameter_ranges *r = t->of;
    const tally_series *s = tally_of(t, which, q);
    const int at = fprintf(to, "  %-*s", RANGES_TABLE_NAME, r->formulation[which].key);
    fprintf(to, "%*s", at < RANGES_TABLE_NAME + 2 ? 0 : 1, "");
    if (s->requested == 0) {
        fprintf(to, "%*s\n", RANGES_TABLE_COLUMN + 15,
                t->others[which] > 0 ? "another model" : "without a reference");
        return;
    }
    for (int k = r->meshes - finest_shown(r); k < r->meshes; k++)
        write_share(to, s->within[k], s->requested);
    if (s->never > 0)
        fprintf(to, "   not everywhere");
    else {
        int mesh = 0;
        while (r->mesh[mesh] != s->everywhere)
            mesh++;
        const int cell = which * r->meshes + mesh;
        const double cost = t->cost[cell] / (double)(t->ran[cell] > 0 ? t->ran[cell] : 1);
        fprintf(to, "   n = %-6d", s->everywhere);
        if (isfinite(cost))
            fprintf(to, " %.2g ms", 1e3 * cost);
    }
    fprintf(to, s->requested < t->points ? ", %ld points\n" : "\n", s->requested);
}

static void write_shares(FILE *to, const tally *t, int q)
{
    const parameter_ranges *r = t->of;
    const int at = fprintf(to, "%s", ranges_table_name(r, q));
    fprintf(to, "%*s", at < RANGES_TABLE_NAME + 2 ? RANGES_TABLE_NAME + 2 - at : 1, "");
    for (int k = r->meshes - finest_shown(r); k < r->meshes; k++) {
        char mesh[24];
        snprintf(mesh, sizeof mesh, "n=%d", r->mesh[k]);
        fprintf(to, "%*s", RANGES_TABLE_COLUMN, mesh);
    }
    fprintf(to, "   everywhere with, mean cost\n");
    for (int i = 0; i < r->formulations; i++)
        write_line(to, t, i, q);
}

static void write_least(FILE *to, const tally *t, int which, int q, int width)
{
    const tally_series *s = tally_of(t, which, q);
    if (t->others[which] == t->points)
        fprintf(to, "%*s", width, "o");
    else if (s->requested == 0)
        fprintf(to, "%*s", width, "?");
    else if (s->never > 0)
        fprintf(to, "%*s", width, "-");
    else if (s->open > 0)
        fprintf(to, "%*d?", width - 1, s->everywhere);
    else
        fprintf(to, "%*d", width, s->everywhere);
}

static void write_leasts(FILE *to, const tally *t)
{
    enum { BESIDE = 3, WIDTH = 24 };
    const parameter_ranges *r = t->of;
    for (int first = 0; first < r->formulations; first += BESIDE) {
        const int end = first + BESIDE < r->formulations ? first + BESIDE : r->formulations;
        fprintf(to, "%-*s", RANGES_TABLE_NAME + 2, "sufficient n for");
        for (int i = first; i < end; i++)
            fprintf(to, " %*.*s", WIDTH - 1, WIDTH - 1, r->formulation[i].key);
        fputc('\n', to);
        for (int q = 0; q < r->quantities; q++) {
            fprintf(to, "  %-*.*s", RANGES_TABLE_NAME, RANGES_TABLE_NAME, r->quantity[q].name);
            for (int i = first; i < end; i++)
                write_least(to, t, i, q, WIDTH);
            fputc('\n', to);
        }
    }
}

static void write_open(FILE *to, const tally *t)
{
    int open = 0;
    for (int i = 0; i < t->of->formulations; i++)
        open |= tally_of(t, i, t->of->quantities)->open > 0;
    if (open)
        paragraph_printf(to, 0, 2,
                         "all quantities: a point at which a quantity has no reference value "
                         "counts only if another quantity is outside the error; n?: over the "
                         "points at which all quantities have a reference value");
}

static void write_all_shares(FILE *to, const tally *t, int every)
{
    const int several = t->of->quantities > 1;
    fprintf(to, "\nshare of the points with errors within %g %%\n", 100 * t->of->request.tolerance);
    for (int q = 0; q < t->of->quantities && (every || !several); q++)
        write_shares(to, t, q);
    if (several) {
        write_shares(to, t, t->of->quantities);
        write_leasts(to, t);
        write_open(to, t);
    }
}

static void write_others(FILE *to, const tally *t)
{
    for (int i = 0; i < t->of->formulations; i++) {
        char words[OMIT_WORDS];
        missing_omit_words(t->lacks[i], words);
        if (t->others[i] > 0)
            paragraph_printf(
                to, 0, 2,
                "%s: another model at %ld of %ld points, which are not counted: %s not modelled",
                t->of->formulation[i].key, t->others[i], t->points, words);
    }
}

static void write_failures(FILE *to, const tally *t)
{
    const parameter_ranges *r = t->of;
    for (int i = 0; i < r->formulations; i++) {
        long failed = 0, ran = 0;
        for (int k = 0; k < r->meshes; k++) {
            failed += t->failed[i * r->meshes + k];
            ran += t->ran[i * r->meshes + k];
        }
        if (failed > 0)
            fprintf(to, "%s: runs without a solution: %ld of %ld\n", r->formulation[i].key, failed,
                    ran);
    }
}

static void short_point(const parameter_ranges *r, const double at[], char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (int i = 0; i < r->design.axes && used < size; i++) {
        char word[ASSIGNMENT_VALUE];
        if (r->axis[i].of->choices != NULL)
            axis_text(&r->axis[i], at[i], word, sizeof word);
        else
            snprintf(word, sizeof word, "%.6g", at[i]);
        used += snprintf(text + used, (size_t)(size - used), "%s%s=%s", i > 0 ? ", " : "",
                         r->axis[i].of->name, word);
    }
}

static void write_worst(FILE *to, const parameter_ranges *r, int which, const tally_worst *w,
                        fault *f)
{
    double at[CASE_MAX_PARAMETERS];
    char where[PARAMETERS_TEXT], what[SCENE_NAME + 60];
    if (design_points(&r->design, w->point, 1, at, f) != STATUS_OK)
        return;
    short_point(r, at, where, sizeof where);
    if (w->quantity >= 0)
        snprintf(what, sizeof what, "%s %.3g %%", r->quantity[w->quantity].name, 100 * w->error);
    else
        snprintf(what, sizeof what, "%s", rows_status_name(w->status));
    fprintf(to, "  %-*s %-26s %s%s%s\n", RANGES_TABLE_NAME - 1, r->formulation[which].key, what,
            where, w->scene[0] != '\0' ? "  " : "", w->scene);
}

static void write_command(FILE *to, const parameter_ranges *r, int which, const tally_worst *w,
                          const char *folder, fault *f)
{
    double at[CASE_MAX_PARAMETERS];
    paragraph words;
    if (design_points(&r->design, w->point, 1, at, f) != STATUS_OK)
        return;
    const int begun = fprintf(to, "to examine the first point: ");
    FILE *out = paragraph_begin(&words, to);
    fprintf(out, "beamwork converge ");
    char path[PATH_MAX];
    const char *file = r->request.file != NULL ? scene_file_path(r->request.type) : NULL;
    const char *element = formulations_element(r->formulation[which].type);
    if (w->scene[0] != '\0' &&
        snprintf(path, sizeof path, "%s/%s", folder, w->scene) < (int)sizeof path)
        file = path;
    fputs(file != NULL ? "--scene " : "", out);
    words_quote(out, file != NULL ? file : r->request.type->name);
    if (element != NULL) {
        fputs(" --element ", out);
        words_quote(out, element);
    }
    for (int i = 0; i < r->design.axes && w->scene[0] == '\0'; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(&r->axis[i], at[i], word, sizeof word);
        fprintf(out, " --set %s=%s", r->axis[i].of->name, word);
    }
    fprintf(out, " -f %s", r->formulation[which].key);
    paragraph_end_command(&words, begun, 4);
}

void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f)
{
    const parameter_ranges *r = t->of;
    int shown = -1;
    if (t->points < r->design.points)
        fprintf(to, "%ld of %ld points are complete\n", t->points, r->design.points);
    ranges_table_known(to, t);
    write_all_shares(to, t, every);
    write_others(to, t);
    write_failures(to, t);
    ranges_table_map(to, t, every);
    fprintf(to, "\nworst points with n = %d\n", r->mesh[r->meshes - 1]);
    for (int i = 0; i < r->formulations; i++)
        for (int k = 0; k < t->worsts[i] && (k == 0 || every || r->formulations <= 3); k++) {
            write_worst(to, r, i, &t->worst[i][k], f);
            shown = shown < 0 ? i : shown;
        }
    if (shown >= 0)
        write_command(to, r, shown, &t->worst[shown][0], folder, f);
    else
        fprintf(to, "  none, because no error is known at any point\n");
}
