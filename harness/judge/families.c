#include "harness/judge/families.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/truth/truth.h"

enum { MOST_SERIES = 64 };

/* A limit that is known. */
typedef struct known_limit {
    int series;
    const char *family;
    double value, uncertainty;
} known_limit;

static int known_limits(const sweep *s, int point_index, int quantity, known_limit out[MOST_SERIES])
{
    int count = 0;
    for (int i = 0; i < s->seriess && count < MOST_SERIES; i++) {
        const series *one = &s->series[i];
        if (one->point != point_index || one->missing[0] != '\0' || one->without.other ||
            one->formulation.type->family == NULL)
            continue;
        const mesh_limit fit = verdict_limit(s, i, quantity, 0);
        const double unmodelled =
            one->without.what != 0 ? one->without.change * fabs(fit.limit) : 0;
        if (isfinite(fit.limit) && isfinite(fit.limit_uncertainty))
            out[count++] = (known_limit){i, one->formulation.type->family, fit.limit,
                                         fit.limit_uncertainty + unmodelled};
    }
    return count;
}

/* How far two limits are apart, and what both are uncertain by. */
typedef struct difference {
    double apart, unknown;
} difference;

static difference difference_of(const known_limit *a, const known_limit *b)
{
    return (difference){fabs(a->value - b->value), a->uncertainty + b->uncertainty};
}

static int agree(const scene_quantity *q, const known_limit *a, const known_limit *b)
{
    const difference d = difference_of(a, b);
    const double size = fmax(fmax(fabs(a->value), fabs(b->value)), q->near_zero);
    return d.apart + d.unknown <= FAMILIES_APART * size;
}

/* What agrees with one limit: of each family the nearest.  A family that is known badly does not
 * make worse what two others know: it counts by what it is off beyond its own uncertainty. */
static families_limit around(const scene_quantity *q, const known_limit *all, int count, int centre)
{
    families_limit out = {.value = all[centre].value};
    double nearest[FAMILIES_MOST], best = INFINITY, beyond = 0;
    for (int i = 0; i < count; i++) {
        const difference d = difference_of(&all[centre], &all[i]);
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
        const difference d = difference_of(&all[centre], &all[out.series[k]]);
        if (strcmp(all[centre].family, all[out.series[k]].family) == 0)
            continue;
        best = fmin(best, d.apart + d.unknown);
        beyond = fmax(beyond, d.apart - d.unknown);
    }
    out.uncertainty = fmax(best, beyond);
    return out;
}

static int is_better(const families_limit *a, const families_limit *b)
{
    return a->families > b->families ||
           (a->families == b->families && a->uncertainty < b->uncertainty);
}

families_limit families_limit_of(const sweep *s, int point_index, int quantity)
{
    const scene_quantity *q = &s->point[point_index].scene.quantity[quantity];
    known_limit all[MOST_SERIES];
    families_limit best = {.families = 0};
    int centre = -1;
    const int count = known_limits(s, point_index, quantity, all);
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
    for (int k = 0; k < best.families; k++)
        best.series[k] = all[best.series[k]].series;
    return best;
}

/* "beamw_consistent (beamw) and collocation (reissner) agree": the source of the truth. */
static char *source_of(const sweep *s, const families_limit *l)
{
    char text[64 * FAMILIES_MOST] = "";
    size_t used = 0;
    for (int k = 0; k < l->families && used < sizeof text; k++) {
        const formulation *one = &s->series[l->series[k]].formulation;
        const char *before = k < l->families - 1 ? ", " : " and ";
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%.40s (%.12s)",
                                 k > 0 ? before : "", one->key, one->type->family);
    }
    if (used < sizeof text)
        snprintf(text + used, sizeof text - used, " agree");
    return strdup(text);
}

static status add_truth(const sweep *s, int point_index, int quantity, const families_limit *l,
                        truths *t, fault *f)
{
    const point *p = &s->point[point_index];
    truth *row = truths_add(t, f);
    if (row == NULL)
        return STATUS_FAULT;
    *row = (truth){.type = p->type,
                   .value = l->value,
                   .uncertainty = l->uncertainty,
                   .at = NAN,
                   .met = 1,
                   .judged = 1,
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
            return fault_set(f, STATUS_FAULT, "out of memory for truths");
        }
    return STATUS_OK;
}

/* May agreements of it become truths? */
static int is_open(const point *p, int files_only)
{
    return p->status == STATUS_OK && (!files_only || p->type->build_from != NULL);
}

status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f)
{
    const point *p = &s->point[point_index];
    for (int q = 0; is_open(p, files_only) && q < p->scene.quantities; q++) {
        const char *name = p->scene.quantity[q].name;
        if (p->scene.quantity[q].reduction == SCENE_CURVE ||
            truth_of(t, p->type, p->parameter, name, "same") != NULL ||
            truth_agreed(t, p->type, p->parameter, name) != NULL)
            continue;
        const families_limit l = families_limit_of(s, point_index, q);
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
