#include "harness/study/study_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

enum { MOST_SERIES = 64 };

typedef struct families_known_limit {
    int series;
    const char *family;
    unsigned theory;
    double value, uncertainty;
} families_known_limit;

static int is_known_wrong(const truths *t, unsigned features, const char *key)
{
    for (int i = 0; i < t->rules; i++) {
        const rule *r = &t->rule[i];
        const unsigned of = rules_features(r);
        if (of != 0 && (of & features) == of && verdict_explains_defect(r) &&
            rules_apply_to(r, key))
            return 1;
    }
    return 0;
}

static int is_eligible(const sweep *s, const series *one, const truths *t)
{
    const element_type *type = one->formulation.type;
    return one->missing[0] == '\0' && !one->without.other && type->family != NULL &&
           type->misprint == NULL &&
           !is_known_wrong(t, features_needed(&s->point[one->point].scene), one->formulation.key);
}

static int known_limits(const sweep *s, int point_index, int quantity, const truths *t,
                        families_known_limit out[MOST_SERIES])
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;
    int count = 0;
    for (int i = 0; i < s->seriess && count < MOST_SERIES; i++) {
        const series *one = &s->series[i];
        if (one->point != point_index || !is_eligible(s, one, t))
            continue;
        const mesh_limit fit = verdict_limit(s, i, quantity, 0);
        const double unmodelled =
            one->without.what != 0 ? one->without.change * fabs(fit.limit) : 0;
        if (isfinite(fit.limit) && isfinite(fit.limit_uncertainty))
            out[count++] = (families_known_limit){
                i, one->formulation.type->family,
                features_needed_of(&s->point[point_index].scene, one->formulation.type) & theories,
                fit.limit, fit.limit_uncertainty + unmodelled};
    }
    return count;
}

typedef struct families_difference {
    double apart, unknown;
} families_difference;

static families_difference difference_of(const families_known_limit *a,
                                         const families_known_limit *b)
{
    return (families_difference){fabs(a->value - b->value), a->uncertainty + b->uncertainty};
}

static int agree(const scene_quantity *q, const families_known_limit *a,
                 const families_known_limit *b)
{
    const families_difference d = difference_of(a, b);
    if (a->theory != b->theory)
        return 0;
    const double size = fmax(fmax(fabs(a->value), fabs(b->value)), q->near_zero);
    return d.apart + d.unknown <= FAMILIES_APART * size;
}

/* Returns the agreement with limit `centre`: the nearest agreeing limit of each family. The
 * uncertainty covers the nearest limit of another family. It also covers the largest part of a
 * difference that exceeds the combined uncertainty. */
static families_limit around(const scene_quantity *q, const families_known_limit *all, int count,
                             int centre)
{
    families_limit out = {.value = all[centre].value, .theory = all[centre].theory};
    double nearest[FAMILIES_MOST], best = INFINITY, beyond = 0;
    for (int i = 0; i < count; i++) {
        const families_difference d = difference_of(&all[centre], &all[i]);
        const double far = d.apart + d.unknown;
        int k = 0;
        if (!agree(q, &all[centre], &all[i]))
            continue;
        while (k < out.families && strcmp(all[out.series[k]].family, all[i].family) != 0)
            k++;
        if (k == FAMILIES_MOST || (k < out.families && nearest[k] <= far))
            continue;
        nearest[k] = far;
        out.series[k] = i;
        out.families += k == out.families;
    }
    for (int k = 0; k < out.families; k++) {
        const families_difference d = difference_of(&all[centre], &all[out.series[k]]);
        if (strcmp(all[centre].family, all[out.series[k]].family) == 0)
            continue;
        best = fmin(best, d.apart + d.unknown);
        beyond = fmax(beyond, d.apart - d.unknown);
    }
    out.uncertainty = fmax(best, beyond);
    return out;
}

/* Mean of limits, weighted by 1/U^2, with the uncertainty of the mean and the weighted spread of
 * the limits. */
typedef struct mean {
    double value, uncertainty, spread;
} mean;

static mean mean_of(const families_known_limit *all, int count, const int in[])
{
    double sum = 0, weights = 0, squares = 0;
    mean out;
    for (int pass = 0; pass < 2; pass++) {
        out.value = sum / weights;
        for (int i = 0; i < count; i++) {
            const double least = 1e-15 * fabs(all[i].value) + DBL_MIN,
                         u = fmax(all[i].uncertainty, least), w = 1 / (u * u);
            if (!in[i])
                continue;
            if (pass > 0)
                squares += w * (all[i].value - out.value) * (all[i].value - out.value);
            else {
                sum += w * all[i].value;
                weights += w;
            }
        }
    }
    out.uncertainty = 1 / sqrt(weights);
    out.spread = sqrt(squares / weights);
    return out;
}

static int is_near(const families_known_limit *one, const mean *m)
{
    return fabs(one->value - m->value) <= one->uncertainty + m->uncertainty;
}

/* Repeatedly removes one limit from in[count] until all limits agree with their mean: the one with
 * the largest distance from the mean relative to the uncertainties. Returns the mean of the
 * remaining limits. */
static mean weighted_mean(const families_known_limit *all, int count, int in[])
{
    for (;;) {
        const mean m = mean_of(all, count, in);
        double most = 0;
        int worst = -1;
        for (int i = 0; i < count; i++) {
            const double off = fabs(all[i].value - m.value) / (all[i].uncertainty + m.uncertainty);
            if (in[i] && !is_near(&all[i], &m) && off > most) {
                most = off;
                worst = i;
            }
        }
        if (worst < 0)
            return m;
        in[worst] = 0;
    }
}

/* Replaces *out by the mean of the limits that agree with the centre and with this mean, if these
 * limits belong to at least two families. */
static void refine(const scene_quantity *q, const families_known_limit *all, int count, int centre,
                   families_limit *out)
{
    int in[MOST_SERIES], near[MOST_SERIES];
    families_limit better = {.theory = out->theory, .disputed = out->disputed};
    for (int i = 0; i < count; i++)
        in[i] = near[i] = agree(q, &all[centre], &all[i]);
    const mean m = weighted_mean(all, count, in);
    for (int i = 0; i < count; i++) {
        int k = 0;
        while (k < better.families && strcmp(all[better.series[k]].family, all[i].family) != 0)
            k++;
        if (near[i] && !in[i] && better.others < FAMILIES_MOST)
            better.other[better.others++] = i;
        if (!in[i] || k == FAMILIES_MOST)
            continue;
        if (k == better.families || all[i].uncertainty < all[better.series[k]].uncertainty)
            better.series[k] = i;
        better.families += k == better.families;
    }
    if (better.families < 2)
        return;
    better.value = m.value;
    better.uncertainty = fmax(m.uncertainty, m.spread);
    *out = better;
}

static int is_better(const families_limit *a, const families_limit *b)
{
    return a->families > b->families ||
           (a->families == b->families && a->uncertainty < b->uncertainty);
}

families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *t)
{
    const scene_quantity *q = &s->point[point_index].scene.quantity[quantity];
    families_known_limit all[MOST_SERIES];
    families_limit best = {.families = 0};
    int centre = -1;
    const int count = known_limits(s, point_index, quantity, t, all);
    for (int i = 0; i < count; i++) {
        const families_limit one = around(q, all, count, i);
        if (centre < 0 || is_better(&one, &best)) {
            best = one;
            centre = i;
        }
    }
    for (int i = 0; i < count; i++)
        best.disputed |=
            !agree(q, &all[centre], &all[i]) && around(q, all, count, i).families >= best.families;
    if (best.families >= 2)
        refine(q, all, count, centre, &best);
    for (int k = 0; k < best.families; k++)
        best.series[k] = all[best.series[k]].series;
    for (int k = 0; k < best.others; k++)
        best.other[k] = all[best.other[k]].series;
    return best;
}

static const char *kept_out(const sweep *s, int index, int quantity, const truths *t)
{
    const series *one = &s->series[index];
    const element_type *type = one->formulation.type;
    if (one->without.other)
        return "another model here";
    if (type->family == NULL || type->misprint != NULL)
        return type->family == NULL ? "of no family" : "implemented with a misprint";
    if (!is_eligible(s, one, t))
        return "with a known deviation here";
    const mesh_limit fit = verdict_limit(s, index, quantity, 0);
    return isfinite(fit.limit) && isfinite(fit.limit_uncertainty)
               ? NULL
               : "without a limit on these meshes";
}

static const char *of_another_family(const sweep *s, int point_index, const char *family,
                                     const truths *t)
{
    const scene *here = &s->point[point_index].scene;
    const element_type *type;
    char words[OMIT_WORDS];
    for (int i = 0; (type = formulations_at(i)) != NULL; i++) {
        int ran = 0;
        for (int k = 0; k < s->seriess; k++)
            ran |= s->series[k].formulation.type == type;
        if (!ran && type->family != NULL && type->misprint == NULL && !formulations_is_new(type) &&
            (family == NULL || strcmp(type->family, family) != 0) &&
            !is_known_wrong(t, features_needed(here), type->name) &&
            !missing_words(here, type, words, sizeof words))
            return type->name;
    }
    return NULL;
}

/* Writes "A, B" after the text `before`, for the series of a point that are excluded for this
 * reason (NULL: that are included). Returns their number. */
static int put_series(FILE *to, const sweep *s, int point_index, int quantity, const truths *t,
                      const char *reason, const char *before)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++) {
        const char *own = s->series[i].missing[0] != '\0' ? "" : kept_out(s, i, quantity, t);
        if (s->series[i].point == point_index && own == reason)
            fprintf(to, "%s%s", count++ > 0 ? ", " : before, s->series[i].formulation.key);
    }
    return count;
}

void families_why(FILE *to, const sweep *s, int point_index, int quantity, const truths *t)
{
    const char *family = NULL, *before = "";
    int families = 0;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const int counts = one->point == point_index && one->missing[0] == '\0';
        const char *why = counts ? kept_out(s, i, quantity, t) : NULL;
        int reported = 0;
        for (int k = 0; k < i && why != NULL; k++)
            reported |= s->series[k].point == point_index && s->series[k].missing[0] == '\0' &&
                        kept_out(s, k, quantity, t) == why;
        if (counts && why == NULL) {
            families += family == NULL || strcmp(family, one->formulation.type->family) != 0;
            family = one->formulation.type->family;
        } else if (counts && !reported) {
            put_series(to, s, point_index, quantity, t, why, before);
            fprintf(to, ": %s", why);
            before = "; ";
        }
    }
    if (put_series(to, s, point_index, quantity, t, NULL, before) > 0)
        fprintf(to, families > 1 ? ": limits that differ" : ": one family (%s)", family);
    const char *more = families < 2 ? of_another_family(s, point_index, family, t) : NULL;
    if (more != NULL)
        fprintf(to, "; add -f %s", more);
}

/* Returns the source of the reference value, such as "beamw_consistent (beamw) and collocation
 * (reissner) agree", which the caller frees. NULL: out of memory. */
static char *source_of(const sweep *s, const families_limit *l)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    for (int k = 0; k < l->families; k++) {
        const formulation *one = &s->series[l->series[k]].formulation;
        fprintf(to, "%s%s (%s)",
                k == 0                ? ""
                : k < l->families - 1 ? ", "
                                      : " and ",
                one->key, one->type->family);
    }
    fputs(" agree", to);
    for (int k = 0; k < l->others; k++)
        fprintf(to, "%s%s",
                k == 0              ? ", not "
                : k < l->others - 1 ? ", "
                                    : " and ",
                s->series[l->other[k]].formulation.key);
    if (l->theory != 0)
        fprintf(to, "; shear in stability: %s",
                l->theory & FEATURE_HARINGX ? "Haringx" : "Engesser");
    if (fclose(to) == 0)
        return text;
    free(text);
    return NULL;
}

static status add_truth(const sweep *s, int point_index, int quantity, const families_limit *l,
                        truths *t, fault *f)
{
    const sweep_point *p = &s->point[point_index];
    truth *row = truths_add(t, f);
    if (row == NULL)
        return STATUS_FAULT;
    *row = (truth){.type = p->type,
                   .value = l->value,
                   .uncertainty = l->uncertainty,
                   .at = NAN,
                   .met = 1,
                   .evaluated = 1,
                   .formulation = strdup(""),
                   .theory = strdup(""),
                   .quantity = strdup(p->scene.quantity[quantity].name),
                   .unit = strdup(p->scene.quantity[quantity].unit),
                   .kind = strdup("agreement"),
                   .model = strdup("same"),
                   .convention = strdup(""),
                   .source = source_of(s, l)};
    memcpy(row->parameter, p->parameter, sizeof row->parameter);
    char *const all[] = {row->formulation, row->theory, row->quantity,   row->unit,
                         row->kind,        row->model,  row->convention, row->source};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i] == NULL) {
            t->rows--;
            for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
                free(all[k]);
            return fault_memory(f, "reference values");
        }
    return STATUS_OK;
}

static int is_open(const sweep_point *p, int files_only)
{
    return p->status == STATUS_OK && (!files_only || p->type->file != NULL);
}

status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f)
{
    const sweep_point *p = &s->point[point_index];
    for (int q = 0; is_open(p, files_only) && q < p->scene.quantities; q++) {
        const char *name = p->scene.quantity[q].name;
        if (p->scene.quantity[q].reduction == SCENE_CURVE ||
            truth_of(t, p->type, p->parameter, name, "same") != NULL ||
            truth_agreed(t, p->type, p->parameter, name) != NULL)
            continue;
        const families_limit l = families_limit_of(s, point_index, q, t);
        if (l.families >= 2 && !l.disputed)
            TRY(add_truth(s, point_index, q, &l, t, f));
    }
    return STATUS_OK;
}

status families_add_truths(const sweep *s, int files_only, truths *t, fault *f)
{
    for (int i = 0; i < s->points; i++)
        TRY(families_add_point(s, i, files_only, t, f));
    return STATUS_OK;
}

status families_reserve(const sweep *s, int files_only, truths *t, fault *f)
{
    int most = 0;
    for (int i = 0; i < s->points; i++)
        most += is_open(&s->point[i], files_only) ? s->point[i].scene.quantities : 0;
    return truths_reserve(t, most, f);
}

typedef struct kept {
    int point;
    char *quantity, *series;
} kept;

static void mark(const sweep *s, const char *select, select_words *words, kept *out)
{
    const sweep_point *p = &s->point[out->point];
    char text[SWEEP_TEXT];
    for (int i = 0; i < s->seriess; i++)
        for (int q = 0; s->series[i].point == out->point && q < p->scene.quantities; q++) {
            sweep_text(p, &s->series[i].formulation, p->scene.quantity[q].name, text);
            select_meet(select, text, words);
            if (select_matches(select, text) == 1)
                out->quantity[q] = out->series[i] = 1;
        }
}

static void drop(sweep *s, const kept *k)
{
    scene *wanted = &s->point[k->point].scene;
    int quantities = 0, seriess = 0;
    for (int q = 0; q < wanted->quantities; q++)
        if (k->quantity[q] && scene_abscissa_of(wanted, &wanted->quantity[q]) != SCENE_NONE)
            k->quantity[scene_abscissa_of(wanted, &wanted->quantity[q])] = 1;
    for (int q = 0; q < wanted->quantities; q++)
        if (k->quantity[q])
            wanted->quantity[quantities++] = wanted->quantity[q];
    for (int i = 0; i < s->seriess; i++)
        if (k->series[i] || s->series[i].point != k->point)
            s->series[seriess++] = s->series[i];
        else
            sweep_series_free(&s->series[i]);
    wanted->quantities = quantities;
    s->seriess = seriess;
}

static const char *quantity_at(const void *context, int i)
{
    const scene *s = context;
    return i < s->quantities ? s->quantity[i].name : NULL;
}

status narrow_check_words(const sweep_point *p, const char *select, const select_words *words,
                          fault *f)
{
    char word[SELECT_WORD];
    if (!select_unmet(select, words, word))
        return STATUS_OK;
    const char *near = choice_nearest(word, quantity_at, &p->scene);
    if (near == NULL)
        return select_all_met(select, words, f);
    char shown[ASSIGNMENT_SHOWN];
    parameters_shown(p->type, shown);
    return fault_set(f, STATUS_REFUSED,
                     "selection '%.60s': the name '%.60s' is unknown; did you mean '%s'? 'beamwork "
                     "list %.170s' shows the names",
                     select, word, near, shown);
}

status sweep_unsupported(const char *key, const char *missing, const char *name, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "%.60s does not support %.160s, which %.60s requires; choose another "
                     "formulation, such as -f collocation",
                     key, missing, name);
}

status narrow_to_nothing(const char *select, const case_type *type, fault *f)
{
    char shown[ASSIGNMENT_SHOWN];
    parameters_shown(type, shown);
    return fault_set(f, STATUS_REFUSED,
                     "-k '%.100s' selects no quantity of %.60s; 'beamwork list %.170s' shows the "
                     "quantities",
                     select, type->name, shown);
}

static status narrow(sweep *s, const char *select, kept *k, fault *f)
{
    select_words words;
    TRY(select_begin(select, &words, f));
    mark(s, select, &words, k);
    TRY(narrow_check_words(&s->point[k->point], select, &words, f));
    drop(s, k);
    const sweep_point *p = &s->point[k->point];
    return p->scene.quantities > 0 ? STATUS_OK : narrow_to_nothing(select, p->type, f);
}

status narrow_to(sweep *s, const char *select, fault *f)
{
    if (select == NULL)
        return STATUS_OK;
    const int last = s->points - 1;
    kept k = {.point = last,
              .quantity = calloc((size_t)s->point[last].scene.quantities + 1, 1),
              .series = calloc((size_t)s->seriess + 1, 1)};
    const status outcome = k.quantity != NULL && k.series != NULL ? narrow(s, select, &k, f)
                                                                  : fault_memory(f, "a selection");
    free(k.quantity);
    free(k.series);
    return outcome;
}

status narrow_scene(scene *s, const case_type *type, const double parameter[],
                    const formulation *chosen, const char *select, fault *f)
{
    fault unmet = {""};
    sweep_point p = {.type = type, .scene = *s};
    series one = {.formulation = *chosen};
    sweep whole = {.points = 1, .seriess = 1, .point = &p, .series = &one};
    parameters_text(type, parameter, p.text, sizeof p.text);
    const status outcome = narrow_to(&whole, select, chosen->type != NULL ? f : &unmet);
    if (outcome == STATUS_OK)
        s->quantities = p.scene.quantities;
    return outcome == STATUS_REFUSED && chosen->type == NULL ? STATUS_OK : outcome;
}
