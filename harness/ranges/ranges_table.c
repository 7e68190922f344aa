#include "harness/ranges/ranges_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/parameters.h"
#include "harness/tables/paragraph.h"

enum { NAME = 24, COLUMN = 7, LINE = 1024, SHOWN_MESHES = 7 };

static void write_axis(FILE *to, const ranges *r, int index)
{
    const axis *a = &r->axis[index];
    const char *unit = strcmp(a->of->unit, "1") == 0 ? "" : a->of->unit;
    char text[LINE];
    int used = snprintf(text, sizeof text, "  %s ", a->of->name);
    if (a->value == NULL)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, "%.6g .. %.6g%s%s%s", a->from, a->to,
                     unit[0] != '\0' ? " " : "", unit, a->kind == AXIS_LOG ? ", logarithmic" : "");
    for (int i = 0; a->value != NULL && i < a->count && used < LINE - ASSIGNMENT_VALUE - 2; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(a, a->value[i], word, sizeof word);
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", i > 0 ? ", " : "", word);
    }
    if (a->count > 0)
        snprintf(text + used, sizeof text - (size_t)used, ": %d values", a->count);
    paragraph_write(to, 0, 4, text);
}

void ranges_table_head(FILE *to, const ranges *r)
{
    char fixed[PARAMETERS_TEXT], seed[60] = "";
    parameters_text(r->request.type, r->base, fixed, sizeof fixed);
    if (r->design.kind == DESIGN_RANDOM)
        snprintf(seed, sizeof seed, ", seed %lu", r->design.seed);
    paragraph_say(to, 0, 2,
                  "%s%s%s: %ld points (%s%s), %d formulations, %d meshes: %ld cells in %d batches",
                  r->request.type->name, fixed[0] != '\0' ? ", " : "", fixed, r->design.points,
                  design_name(r->design.kind), seed, r->formulations, r->meshes,
                  r->design.points * r->formulations * r->meshes, r->batches);
    for (int i = 0; i < r->design.axes; i++)
        write_axis(to, r, i);
    if (r->left_out[0] != '\0')
        paragraph_say(to, 0, 4, "  left out: %s", r->left_out);
}

/* What a quantity is measured by, in words. */
static void write_reference(FILE *to, const tally *t, int q)
{
    const long *kind = t->kind[q];
    const long without = kind[ROWS_NONE] + kind[ROWS_DISPUTED];
    const int alone = t->of->formulations == 1;
    char text[LINE];
    size_t used = (size_t)snprintf(text, sizeof text, "  %s:", t->of->quantity[q].name);
    const struct {
        long count;
        const char *words;
    } part[] = {{kind[ROWS_STORED], "a stored truth"},
                {kind[ROWS_DERIVED], "a truth derived there"},
                {kind[ROWS_LIMIT], alone
                                       ? "the limit of its own meshes, which shows convergence only"
                                       : "the limit of the meshes of all formulations"},
                {kind[ROWS_NONE], "nothing: no limit is known to half of the tolerance"},
                {kind[ROWS_DISPUTED], "nothing: limits of formulations disagree"}};
    int parts = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++)
        if (part[i].count > 0)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s %ld points by %s",
                                     parts++ > 0 ? ";" : "", part[i].count, part[i].words);
    if (t->points - t->without_scene > without)
        snprintf(text + used, sizeof text - used, " (known to %.1g or better)",
                 fmax(t->doubt[q], 1e-16));
    paragraph_write(to, 0, 6, text);
}

static void write_references(FILE *to, const tally *t)
{
    fprintf(to, "errors are measured by\n");
    for (int q = 0; q < t->of->quantities; q++)
        write_reference(to, t, q);
    if (t->without_scene > 0)
        paragraph_say(to, 0, 6, "  %ld points have no scene, the first is point %ld",
                      t->without_scene, t->first_without);
}

static const char *name_of(const ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all together";
}

/* 99.96 % are not all. */
static void write_share(FILE *to, long part, long all)
{
    if (part == all)
        fprintf(to, "%*s", COLUMN, "all");
    else if (part == 0)
        fprintf(to, "%*s", COLUMN, "none");
    else {
        const double share = 100.0 * (double)part / (double)all;
        fprintf(to, "%*.*f%%", COLUMN - 1, share < 9.95 || share > 99 ? 1 : 0,
                fmax(0.1, fmin(share, 99.9)));
    }
}

static int finest_shown(const ranges *r)
{
    return r->meshes < SHOWN_MESHES ? r->meshes : SHOWN_MESHES;
}

static void write_line(FILE *to, const tally *t, int which, int q)
{
    const ranges *r = t->of;
    const tally_series *s = tally_of(t, which, q);
    const int at = fprintf(to, "  %-*s", NAME, r->formulation[which].key);
    fprintf(to, "%*s", at < NAME + 2 ? 0 : 1, "");
    if (s->asked == 0) {
        fprintf(to, "%*s\n", COLUMN + 15, "without a reference");
        return;
    }
    for (int k = r->meshes - finest_shown(r); k < r->meshes; k++)
        write_share(to, s->within[k], s->asked);
    if (s->never > 0)
        fprintf(to, "   not everywhere");
    else {
        int mesh = 0;
        while (r->mesh[mesh] != s->everywhere)
            mesh++;
        const int cell = which * r->meshes + mesh;
        fprintf(to, "   n = %-6d %.2g ms", s->everywhere,
                1e3 * t->cost[cell] / (double)(t->ran[cell] > 0 ? t->ran[cell] : 1));
    }
    fprintf(to, s->asked < t->points ? ", %ld points\n" : "\n", s->asked);
}

/* One quantity: a line for each formulation. */
static void write_shares(FILE *to, const tally *t, int q)
{
    const ranges *r = t->of;
    const int at = fprintf(to, "%s", name_of(r, q));
    fprintf(to, "%*s", at < NAME + 2 ? NAME + 2 - at : 1, "");
    for (int k = r->meshes - finest_shown(r); k < r->meshes; k++) {
        char mesh[24];
        snprintf(mesh, sizeof mesh, "n=%d", r->mesh[k]);
        fprintf(to, "%*s", COLUMN, mesh);
    }
    fprintf(to, "   everywhere with, mean cost\n");
    for (int i = 0; i < r->formulations; i++)
        write_line(to, t, i, q);
}

static void write_all_shares(FILE *to, const tally *t)
{
    fprintf(to, "\nshare of the points within %g %%\n", 100 * t->of->request.tolerance);
    for (int q = 0; q < t->of->quantities; q++)
        write_shares(to, t, q);
    if (t->of->quantities > 1)
        write_shares(to, t, t->of->quantities);
}

static void write_failures(FILE *to, const tally *t)
{
    const ranges *r = t->of;
    for (int i = 0; i < r->formulations; i++) {
        long failed = 0, ran = 0;
        for (int k = 0; k < r->meshes; k++) {
            failed += t->failed[i * r->meshes + k];
            ran += t->ran[i * r->meshes + k];
        }
        if (failed > 0)
            paragraph_say(to, 0, 4, "%s: %ld of %ld cells have no solution", r->formulation[i].key,
                          failed, ran);
    }
}

static void write_place(FILE *to, const tally_place *p)
{
    char text[24];
    if (p->points == 0)
        snprintf(text, sizeof text, ".");
    else if (p->asked == 0)
        snprintf(text, sizeof text, "?");
    else if (p->never > 0)
        snprintf(text, sizeof text, "-");
    else
        snprintf(text, sizeof text, "%d", p->least);
    fprintf(to, "%*s", COLUMN, text);
}

/* Value of an axis, short. */
static void edge_text(const tally *t, int index, int place, char *text, int size)
{
    const axis *a = &t->of->axis[index];
    if (a->of->choices != NULL)
        axis_text(a, tally_edge(t, index, place), text, size);
    else
        snprintf(text, (size_t)size, "%.3g", tally_edge(t, index, place));
}

static void write_map(FILE *to, const tally *t, int which, int q)
{
    const ranges *r = t->of;
    char edge[ASSIGNMENT_VALUE];
    fprintf(to, "%s, %s\n  %-*.*s", r->formulation[which].key, name_of(r, q), NAME - 2, NAME - 3,
            r->axis[0].of->name);
    for (int i = 0; i < t->columns; i++) {
        edge_text(t, 0, i, edge, sizeof edge);
        fprintf(to, "%*.*s", COLUMN, COLUMN - 1, edge);
    }
    fputc('\n', to);
    for (int k = 0; k < t->lines; k++) {
        edge[0] = '\0';
        if (r->design.axes > 1)
            edge_text(t, 1, k, edge, sizeof edge);
        char label[NAME + 1];
        snprintf(label, sizeof label, "%.*s %s", NAME - 12,
                 r->design.axes > 1 ? r->axis[1].of->name : "least n", edge);
        fprintf(to, "  %-*s", NAME - 2, label);
        for (int i = 0; i < t->columns; i++)
            write_place(to, tally_at(t, which, q, k, i));
        fputc('\n', to);
    }
}

static void write_maps(FILE *to, const tally *t, int every)
{
    const ranges *r = t->of;
    if (t->columns == 0) {
        fprintf(to, "\nno map: there are %d axes; the page of the sweep draws slices\n",
                r->design.axes);
        return;
    }
    fprintf(to, "\n");
    paragraph_say(to, 0, 2,
                  "least n from which on every mesh is within %g %% (-: not even with n = %d; ?: "
                  "without a reference; values of the axes are where a field begins)",
                  100 * r->request.tolerance, r->mesh[r->meshes - 1]);
    for (int i = 0; i < r->formulations; i++) {
        for (int q = 0; q < r->quantities && every && r->quantities > 1; q++)
            write_map(to, t, i, q);
        write_map(to, t, i, r->quantities > 1 ? r->quantities : 0);
    }
}

static void write_worst(FILE *to, const ranges *r, int which, const tally_worst *w, fault *f)
{
    double at[CASE_MAX_PARAMETERS];
    char where[PARAMETERS_TEXT], what[SCENE_NAME + 60];
    if (design_points(&r->design, w->point, 1, at, f) != STATUS_OK)
        return;
    ranges_point_text(r, at, where, sizeof where);
    if (w->quantity >= 0)
        snprintf(what, sizeof what, "%s %.3g %%", r->quantity[w->quantity].name, 100 * w->error);
    else
        snprintf(what, sizeof what, "%s", rows_status_name(w->status));
    paragraph_say(to, 0, 6, "  %-*s %-28s %s%s%s", NAME - 1, r->formulation[which].key, what, where,
                  w->scene[0] != '\0' ? "  " : "", w->scene);
}

/* How to see one of them: that of the first formulation. */
static void write_command(FILE *to, const ranges *r, int which, const tally_worst *w,
                          const char *folder, fault *f)
{
    double at[CASE_MAX_PARAMETERS];
    paragraph words;
    if (design_points(&r->design, w->point, 1, at, f) != STATUS_OK)
        return;
    fprintf(to, "to look at one\n");
    FILE *out = paragraph_begin(&words, to);
    fprintf(out, "  beamwork converge ");
    if (w->scene[0] != '\0')
        fprintf(out, "--scene %s/%s", folder, w->scene);
    else
        fprintf(out, "%s%s", r->request.file != NULL ? "--scene " : "",
                r->request.file != NULL ? scene_file_path(r->request.type) : r->request.type->name);
    for (int i = 0; i < r->design.axes && w->scene[0] == '\0'; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(&r->axis[i], at[i], word, sizeof word);
        fprintf(out, " --set %s=%s", r->axis[i].of->name, word);
    }
    fprintf(out, " -f %s", r->formulation[which].key);
    paragraph_end_command(&words, 0, 4);
}

void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f)
{
    const ranges *r = t->of;
    int shown = -1;
    write_references(to, t);
    write_all_shares(to, t);
    write_failures(to, t);
    write_maps(to, t, every);
    fprintf(to, "\nworst points with n = %d\n", r->mesh[r->meshes - 1]);
    for (int i = 0; i < r->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++) {
            write_worst(to, r, i, &t->worst[i][k], f);
            shown = shown < 0 ? i : shown;
        }
    if (shown >= 0)
        write_command(to, r, shown, &t->worst[shown][0], folder, f);
    else
        fprintf(to, "  none: nothing has an error\n");
}
