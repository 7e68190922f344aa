#include "harness/records/reach_line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

static void write_reached(FILE *to, const sweep *s, const reached *r)
{
    const series *one = &s->series[r->series];
    fprintf(to, "%s n = %d", one->formulation.key, one->mesh[r->mesh]);
    if (isfinite(r->cost))
        fprintf(to, " (%.2g ms)", 1e3 * r->cost);
    else
        fprintf(to, " (%s: no rank)", reach_unranked(one->formulation.type));
}

/* Those with a defect, the ones of the same words together. */
static void write_defective(FILE *to, const reach_question *q, const reached list[], int count)
{
    for (int i = 0; i < count; i++) {
        const char *words = reach_defect_words(list[i].defect->kind), *before = "";
        int told = 0;
        for (int k = 0; k < i; k++)
            told |= strcmp(words, reach_defect_words(list[k].defect->kind)) == 0;
        if (told)
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

/* The cheapest ones, those behind them, those with a defect. */
static void write_ranking(FILE *to, const reach_question *q, const reached list[], int count)
{
    const int ties = reach_ties(list, count);
    int sound = 0;
    while (sound < count && list[sound].defect == NULL)
        sound++;
    for (int i = 0; i < sound; i++) {
        fputs(i == 0 ? "" : i < ties ? ", " : "; ", to);
        write_reached(to, q->s, &list[i]);
        if (ties > 1 && i == ties - 1)
            fputs(": within noise of each other", to);
    }
    if (sound == 0)
        fputs("no formulation that passes in all of it", to);
    write_defective(to, q, list + sound, count - sound);
}

/* Those whose cost is that of any formulation with as many strains. */
static void write_unpriced(FILE *to, const sweep *s, const reached list[], int count)
{
    const char *before = "; without cost coefficients of its own: ";
    for (int i = 0; i < count; i++) {
        const formulation *one = &s->series[list[i].series].formulation;
        if (price_own(price_rows, one))
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

/* Of those asked that the series has not within the level: the one whose error on the finest mesh
 * is largest, or that has no value there. */
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

/* Those of one kind (reach_asks) that are not in the list. */
static void write_others(FILE *to, const reach_question *q, const reached list[], int count,
                         int kind, const char *words)
{
    for (int i = 0; i < q->s->seriess; i++) {
        if (reach_asks(q, i) != kind || is_reached(list, count, i))
            continue;
        fprintf(to, "%s%s", words, q->s->series[i].formulation.key);
        if (kind == 1)
            write_worst(to, q, i);
        words = ", ";
    }
}

/* Those that another model was solved with, each kind once. */
static void write_other_models(FILE *to, const reach_question *q)
{
    const char *before = "; another model, which is not ranked: ";
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

/* What is asked: all quantities but curves, or those with a reference; the others are named.
 * Returns how many have one. */
static int write_asked(FILE *to, const reach_question *q)
{
    const char *before = " (without a reference: ";
    const scene *here = &q->s->point[q->point].scene;
    int known = 0, all = 0;
    for (int i = 0; i < here->quantities; i++)
        if (here->quantity[i].reduction != SCENE_CURVE) {
            all++;
            known += has_reference(q, i);
        }
    fprintf(to, "for %g %% in ", 100 * q->level);
    if (known == all) {
        fputs("every quantity: ", to);
        return known;
    }
    if (known > 0)
        fprintf(to, "%d of %d quantities", known, all);
    else
        fputs("no quantity", to);
    for (int i = 0; i < here->quantities; i++)
        if (here->quantity[i].reduction != SCENE_CURVE && !has_reference(q, i)) {
            fprintf(to, "%s%s", before, here->quantity[i].name);
            before = ", ";
        }
    fputs("): ", to);
    return known;
}

/* Is it the difference from a solid, a plate or a shell, that somebody computed? */
static int is_of_another_model(const verdict *v)
{
    const truth *other = v->model_truth;
    return other != NULL && isfinite(v->model_error) && strcmp(other->model, "other") == 0 &&
           strcmp(other->kind, "agreement") != 0 && strcmp(other->kind, "experiment") != 0;
}

/* How far those that pass (where none does: the cheapest one) are from another model at most. */
static void write_model_error(FILE *to, const reach_question *q, const reached list[], int count)
{
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
    char percent[ROUNDING_TEXT];
    rounding_digits(100 * fabs(most->model_error), 2, percent);
    fprintf(to, "; of another model (solid, plate): up to %s %% off (%s)", percent,
            q->s->point[q->point].scene.quantity[most->quantity].name);
}

/* Where no formulation runs there is no number: why. Returns 0 where one runs. */
static int write_nothing_runs(FILE *to, const sweep *s)
{
    const char *before = "nothing was run: ";
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            return 0;
    for (int i = 0; i < s->seriess; i++, before = "; ")
        fprintf(to, "%s%s does not offer %s", before, s->series[i].formulation.key,
                s->series[i].missing);
    return s->seriess > 0;
}

static void write_answer(FILE *to, const reach_question *q, reached list[])
{
    const int count = reach_ranking(q, list), known = write_asked(to, q);
    if (count == 0)
        fputs(known > 0 ? "no formulation on these meshes" : "nothing to measure by", to);
    else
        write_ranking(to, q, list, count);
    write_unpriced(to, q->s, list, count);
    if (known > 0) {
        write_others(to, q, list, count, 1, "; not reached by ");
        write_others(to, q, list, count, 0, "; without a truth of its theory in all of it: ");
    }
    write_other_models(to, q);
    write_model_error(to, q, list, count);
}

void reach_line_write(FILE *to, const sweep *s, const truths *t, double level)
{
    reach_question q = {.s = s,
                        .point = s->seriess > 0 ? s->series[0].point : 0,
                        .quantity = REACH_EVERY,
                        .level = level};
    verdict *all = reach_verdicts(s, t, &q.verdicts);
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    q.verdict = all;
    if (all != NULL && list != NULL && s->points > 0 && !write_nothing_runs(to, s))
        write_answer(to, &q, list);
    fputc('\n', to);
    free(all);
    free(list);
}
