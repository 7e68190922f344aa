#include "harness/records/records.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *meshes_of(const gathering *g, int series_index, int quantity)
{
    json_t *all = json_array();
    for (int k = 0; k < g->sweep->series[series_index].meshes; k++) {
        subjects list = {0};
        const subject cell = gather_cell(g, series_index, k);
        json_t *one = json_record(&record_cell, &cell, KEY);
        gather_mesh(g, &record_quantity, series_index, k, &list);
        for (int i = 0; i < list.count; i++) {
            json_t *found = list.row[i].index == quantity
                                ? json_record(&record_quantity, &list.row[i], 0)
                                : NULL;
            json_object_update(one, found);
            json_decref(found);
        }
        json_array_append_new(all, one);
        gather_free(&list);
    }
    return all;
}

static json_t *quantity_of(const gathering *g, int series_index, int quantity)
{
    verdict v = {.series = series_index, .quantity = quantity};
    verdict_reach(g->sweep, g->truths, &v);
    v.matches = v.kind == v.expected;
    const subject s = gather_verdict(g, &v);
    json_t *out = json_record(&record_verdict, &s, 0);
    json_object_set_new(out, "meshes", meshes_of(g, series_index, quantity));
    return out;
}

static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static json_t *curve_of(const sweep *s, const series *one, int quantity, const series *other)
{
    const scene *what = &s->point[one->point].scene;
    const scene_quantity *q = &what->quantity[quantity];
    const int finest = curve_error_finest(one, quantity),
              best = curve_error_finest(other, quantity);
    json_t *meshes = json_array();
    for (int k = 0; k < one->meshes; k++) {
        const double error = finest < 0 ? NAN
                                        : curve_error_between(what, quantity, &one->cell[k].solve,
                                                              &one->cell[finest].solve, NULL);
        json_array_append_new(
            meshes, json_pack("{s:i,s:o}", "elements", one->mesh[k], "error", number(error)));
    }
    const double apart = finest < 0 || best < 0
                             ? NAN
                             : curve_error_between(what, quantity, &one->cell[finest].solve,
                                                   &other->cell[best].solve, NULL);
    return json_pack("{s:s,s:s,s:s,s:s,s:o,s:s,s:o}", "quantity", q->name, "unit", q->unit,
                     "x_name", q->x.name, "x_unit", q->x.unit, "meshes", meshes, "reference",
                     other->formulation.key, "reference_error", number(apart));
}

static json_t *curves_of(const sweep *s, const series *one)
{
    json_t *all = json_array();
    const scene *what = &s->point[one->point].scene;
    for (int q = 0; q < what->quantities && one->missing[0] == '\0'; q++) {
        const int reference =
            what->quantity[q].reduction == SCENE_CURVE ? curve_error_reference(s, q) : -1;
        if (reference >= 0)
            json_array_append_new(all, curve_of(s, one, q, &s->series[reference]));
    }
    return all;
}

/* Returns the output of `write`, without its line end; NULL: out of memory. */
static char *said(void (*write)(FILE *, const sweep *, const truths *, double), const sweep *s,
                  const truths *t, double level)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    write(to, s, t, level);
    if (fclose(to) == 0 && text != NULL) {
        text[strcspn(text, "\n")] = '\0';
        return text;
    }
    free(text);
    return NULL;
}

static json_t *sentence_of(const sweep *s, const truths *t, double level)
{
    char *line = said(reach_line_write, s, t, level),
         *beyond = said(reach_model_write, s, t, level);
    json_t *out = NULL;
    if (line != NULL && beyond != NULL)
        out = json_sprintf("%s%s%s", line, beyond[0] != '\0' ? ". " : "", beyond);
    free(line);
    free(beyond);
    return out;
}

/* Lists the formulations within the level, in the same order as in the text output. rank 0: the
 * verdict on the formulation is not a pass, or the formulation is not ranked by cost. */
static json_t *answers_of(const sweep *s, const truths *t, double level)
{
    json_t *out = json_array();
    reach_question q = {.s = s, .point = 0, .quantity = REACH_EVERY, .level = level};
    verdict *all = reach_verdicts(s, t, &q.verdicts);
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    q.verdict = all;
    const int count = all != NULL && list != NULL ? reach_ranking(&q, list) : 0;
    const int ties = list != NULL ? reach_ties(list, count) : 0;
    for (int i = 0; i < count; i++) {
        const series *one = &s->series[list[i].series];
        const verdict *bad = list[i].defect;
        json_array_append_new(
            out,
            json_pack("{s:s,s:i,s:o,s:i,s:b,s:s}", "formulation", one->formulation.key, "elements",
                      one->mesh[list[i].mesh], "cost",
                      isfinite(list[i].cost) ? json_real(list[i].cost) : json_null(), "rank",
                      bad == NULL && isfinite(list[i].cost) ? i + 1 : 0, "tie",
                      ties > 1 && i < ties, "defect", bad == NULL ? "" : verdict_name(bad->kind)));
    }
    free(all);
    free(list);
    return out;
}

status json_convergence_write(FILE *to, const sweep *s, const truths *t, double level, fault *f)
{
    const gathering g = {s, NULL, t};
    json_t *all = json_array();
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const sweep_point *p = &s->point[one->point];
        json_t *quantities = json_array();
        if (one->missing[0] == '\0')
            for (int q = 0; q < p->scene.quantities; q++)
                if (p->scene.quantity[q].reduction != SCENE_CURVE)
                    json_array_append_new(quantities, quantity_of(&g, i, q));
        const subject here = {.sweep = s, .point = p, .series = one, .record = one};
        json_t *out = json_record(&record_series, &here, KEY_AROUND);
        json_object_set_new(out, record_quantity.table, quantities);
        json_object_set_new(out, record_curve.table, curves_of(s, one));
        json_array_append_new(all, out);
    }
    json_t *root = json_pack("{s:i,s:o,s:f,s:o,s:o}", "schema_version", SCHEMA_VERSION,
                             record_series.table, all, "level", level, "answers",
                             answers_of(s, t, level), "sentence", sentence_of(s, t, level));
    if (root != NULL)
        json_add_physics(root, &s->point[0]);
    return json_finish(root, to, f);
}

static void write_reached(FILE *to, const sweep *s, const reached *r)
{
    const series *one = &s->series[r->series];
    fprintf(to, "%s n = %d", one->formulation.key, one->mesh[r->mesh]);
    if (isfinite(r->cost))
        fprintf(to, " (%.2g ms)", 1e3 * r->cost);
    else
        fprintf(to, " (%s: no rank)", reach_unranked(one->formulation.type));
}

static void write_defective(FILE *to, const reach_question *q, const reached list[], int count)
{
    for (int i = 0; i < count; i++) {
        const char *words = reach_defect_words(list[i].defect->kind), *before = "";
        int reported = 0;
        for (int k = 0; k < i; k++)
            reported |= strcmp(words, reach_defect_words(list[k].defect->kind)) == 0;
        if (reported)
            continue;
        fprintf(to, "; also within %g %%, %s: ", 100 * q->level, words);
        for (int k = i; k < count; k++)
            if (strcmp(words, reach_defect_words(list[k].defect->kind)) == 0) {
                fputs(before, to);
                write_reached(to, q->s, &list[k]);
                before = ", ";
            }
    }
}

static void write_ranking(FILE *to, const reach_question *q, const reached list[], int count)
{
    const int ties = reach_ties(list, count);
    int without_defect = 0;
    while (without_defect < count && list[without_defect].defect == NULL)
        without_defect++;
    for (int i = 0; i < without_defect; i++) {
        fputs(i == 0 ? "" : i < ties ? ", " : "; ", to);
        write_reached(to, q->s, &list[i]);
        if (ties > 1 && i == ties - 1)
            fputs(": costs tie", to);
    }
    if (without_defect == 0)
        fputs("no formulation passes everywhere", to);
    write_defective(to, q, list + without_defect, count - without_defect);
}

static void write_without_cost(FILE *to, const sweep *s, const reached list[], int count)
{
    const char *before = "; no own cost coefficients: ";
    for (int i = 0; i < count; i++) {
        const formulation *one = &s->series[list[i].series].formulation;
        if (has_cost_coefficients(cost_coefficients, one))
            continue;
        fprintf(to, "%s%s", before, one->key);
        before = ", ";
    }
}

static int is_reached(const reached list[], int count, int series_index)
{
    int found = 0;
    for (int i = 0; i < count; i++)
        found |= list[i].series == series_index;
    return found;
}

/* Writes the requested quantity in which the series is not within the level: a quantity without a
 * value on the finest mesh, or the quantity with the largest error on this mesh. */
static void write_worst(FILE *to, const reach_question *q, int series_index)
{
    const series *one = &q->s->series[series_index];
    const scene *here = &q->s->point[one->point].scene;
    double most = 0;
    int worst = -1;
    for (int i = 0; i < q->verdicts; i++) {
        const verdict *v = &q->verdict[i];
        if (v->series != series_index || v->truth == NULL || reach_mesh(q->s, v, q->level) >= 0)
            continue;
        const solve_result *r = &one->cell[one->meshes - 1].solve;
        const double value = v->quantity < r->quantities ? r->quantity[v->quantity].value : NAN;
        double error = fabs(verdict_error(&here->quantity[v->quantity], value, v->truth->value));
        error = isfinite(error) ? error : INFINITY;
        if (worst < 0 || error > most) {
            most = error;
            worst = v->quantity;
        }
    }
    if (worst < 0)
        return;
    char digits[ROUNDING_TEXT];
    rounding_digits(100 * most, 2, digits);
    fprintf(to, " (%s: %s%s)", here->quantity[worst].name, isfinite(most) ? digits : "no value",
            isfinite(most) ? " %" : "");
}

/* Writes the series that are not in the list and for which reach_has_references returns `kind`. */
static void write_others(FILE *to, const reach_question *q, const reached list[], int count,
                         int kind, const char *words)
{
    for (int i = 0; i < q->s->seriess; i++) {
        if (reach_has_references(q, i) != kind || is_reached(list, count, i))
            continue;
        fprintf(to, "%s%s", words, q->s->series[i].formulation.key);
        if (kind == 1)
            write_worst(to, q, i);
        words = ", ";
    }
}

static void write_other_models(FILE *to, const reach_question *q)
{
    const char *before = "; a different model, not ranked: ";
    for (int i = 0; i < q->s->seriess; i++) {
        const series *one = &q->s->series[i];
        if (one->point != q->point || !one->without.other)
            continue;
        fprintf(to, "%s%s (without %s)", before, one->formulation.key, one->without.words);
        before = ", ";
    }
}

static int has_reference(const reach_question *q, int quantity)
{
    int known = 0;
    for (int i = 0; i < q->verdicts; i++)
        known |= q->verdict[i].quantity == quantity && q->verdict[i].truth != NULL &&
                 q->s->series[q->verdict[i].series].point == q->point;
    return known;
}

/* Writes the quantities to which the answer applies: "every quantity", or the number of those with
 * a reference value and the names of the others. Returns the number of quantities with a reference
 * value. *all: the number of quantities except curves. */
static int write_requested(FILE *to, const reach_question *q, int *all)
{
    const char *before = " (without a reference: ";
    const scene *here = &q->s->point[q->point].scene;
    int known = 0;
    *all = 0;
    for (int i = 0; i < here->quantities; i++)
        if (here->quantity[i].reduction != SCENE_CURVE) {
            ++*all;
            known += has_reference(q, i);
        }
    fprintf(to, "for %g %% in ", 100 * q->level);
    if (known == *all)
        fputs(*all > 0 ? "every quantity" : "no quantity", to);
    else if (known > 0)
        fprintf(to, "%d of %d quantities", known, *all);
    else
        fputs("no quantity", to);
    for (int i = 0; i < here->quantities; i++)
        if (here->quantity[i].reduction != SCENE_CURVE && !has_reference(q, i)) {
            fprintf(to, "%s%s", before, here->quantity[i].name);
            before = ", ";
        }
    int open = before[0] == ',';
    before = open ? "; curves are not included: " : " (curves are not included: ";
    for (int i = 0; i < here->quantities; i++)
        if (here->quantity[i].reduction == SCENE_CURVE) {
            fprintf(to, "%s%s", before, here->quantity[i].name);
            before = ", ";
            open = 1;
        }
    if (open)
        fputc(')', to);
    fputs(": ", to);
    return known;
}

static int is_of_another_model(const verdict *v)
{
    const truth *other = v->model_truth;
    return other != NULL && isfinite(v->model_error) && strcmp(other->model, "other") == 0 &&
           strcmp(other->kind, "agreement") != 0 && strcmp(other->kind, "experiment") != 0;
}

/* Writes the largest difference of the passing formulations from another model. If no formulation
 * passes, writes the difference of the formulation with the lowest cost. */
static void write_model_error(FILE *to, const reach_question *q, reached list[])
{
    const int count = reach_ranking(q, list);
    const verdict *most = NULL;
    for (int i = 0; i < count && (i == 0 || list[i].defect == NULL); i++)
        for (int k = 0; k < q->verdicts; k++) {
            const verdict *v = &q->verdict[k];
            if (v->series == list[i].series && is_of_another_model(v) &&
                (most == NULL || fabs(v->model_error) > fabs(most->model_error)))
                most = v;
        }
    if (most == NULL)
        return;
    char percent[ROUNDING_TEXT], value[ROUNDING_TEXT];
    const truth *solid = most->model_truth;
    rounding_digits(100 * most->model_error, 2, percent);
    rounding_known(solid->value, solid->uncertainty, value);
    fprintf(to,
            "The beam model differs from the structure: %s of another model is %s %s (%s); the "
            "limit of %s differs from it by %s%s %%. The target error of %g %% applies only to the "
            "beam model.\n",
            q->s->point[q->point].scene.quantity[most->quantity].name, value, solid->unit,
            solid->source, q->s->series[most->series].formulation.key,
            most->model_error > 0 ? "+" : "", percent, 100 * q->level);
}

/* Writes the reason why no formulation runs. Returns 0 if at least one formulation runs. */
static int write_nothing_runs(FILE *to, const sweep *s)
{
    const char *before = "nothing was run: ";
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            return 0;
    for (int i = 0; i < s->seriess; i++, before = "; ")
        fprintf(to, "%s%s does not support %s", before, s->series[i].formulation.key,
                s->series[i].missing);
    return s->seriess > 0;
}

static void write_answer(FILE *to, const reach_question *q, reached list[])
{
    if (write_nothing_runs(to, q->s)) {
        fputc('\n', to);
        return;
    }
    int all;
    const int count = reach_ranking(q, list), known = write_requested(to, q, &all);
    if (count == 0)
        fputs(
            known > 0 ? "no formulation on these meshes"
            : all == 0
                ? "no ranking; 'at: VALUE' instead of 'take: curve' selects a point"
                : "no ranking; give 'truths' in the scene, or formulations of other families (-f)",
            to);
    else
        write_ranking(to, q, list, count);
    write_without_cost(to, q->s, list, count);
    if (known > 0) {
        write_others(to, q, list, count, 1, "; not reached by ");
        write_others(to, q, list, count, 0,
                     "; without a reference value of the same theory for every quantity: ");
    }
    write_other_models(to, q);
    fputc('\n', to);
}

static void reach_write(FILE *to, const sweep *s, const truths *t, double level,
                        void (*write)(FILE *, const reach_question *, reached[]))
{
    reach_question q = {.s = s,
                        .point = s->seriess > 0 ? s->series[0].point : 0,
                        .quantity = REACH_EVERY,
                        .level = level};
    verdict *all = reach_verdicts(s, t, &q.verdicts);
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    q.verdict = all;
    if (all != NULL && list != NULL && s->points > 0)
        write(to, &q, list);
    free(all);
    free(list);
}

void reach_line_write(FILE *to, const sweep *s, const truths *t, double level)
{
    reach_write(to, s, t, level, write_answer);
}

void reach_model_write(FILE *to, const sweep *s, const truths *t, double level)
{
    reach_write(to, s, t, level, write_model_error);
}
