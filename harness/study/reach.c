#include "harness/study/reach.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/price.h"

const double reach_level[REACH_LEVELS] = {0.1, 0.01, 0.001, 0.0001};

int reach_mesh(const sweep *s, const verdict *v, double level)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    int first = -1;
    if (v->truth == NULL || one->missing[0] != '\0')
        return -1;
    for (int i = one->meshes - 1; i >= 0; i--) {
        const solve_result *r = &one->cell[i].solve;
        const double value = v->quantity < r->quantities ? r->quantity[v->quantity].value : NAN;
        if (!(fabs(verdict_error(q, value, v->truth->value)) <= level)) /* NAN is not within */
            break;
        first = i;
    }
    return first;
}

int reach_is_defect(verdict_kind kind)
{
    return kind != VERDICT_PASS && kind != VERDICT_NO_TRUTH && kind != VERDICT_SKIP &&
           kind != VERDICT_OTHER_MODEL;
}

const char *reach_defect_words(verdict_kind kind)
{
    switch (kind) {
    case VERDICT_LOW_ORDER:
        return "of low order";
    case VERDICT_UNDECIDED:
        return "with a limit that is not known";
    default:
        return "with a different limit";
    }
}

/* Is the quantity asked for: by itself, or as one that some formulation has a truth for? */
static int is_asked(const reach_question *q, int quantity)
{
    int known = 0;
    if (q->quantity != REACH_EVERY)
        return quantity == q->quantity;
    for (int i = 0; i < q->verdicts && !known; i++)
        known = q->verdict[i].quantity == quantity && q->verdict[i].truth != NULL &&
                q->s->series[q->verdict[i].series].point == q->point;
    return known;
}

/* The verdict of a series on a quantity, or NULL. */
static const verdict *verdict_on(const reach_question *q, int series_index, int quantity)
{
    for (int i = 0; i < q->verdicts; i++)
        if (q->verdict[i].series == series_index && q->verdict[i].quantity == quantity)
            return &q->verdict[i];
    return NULL;
}

int reach_asks(const reach_question *q, int series_index)
{
    const series *one = &q->s->series[series_index];
    if (one->point != q->point || one->missing[0] != '\0' || one->imported != NULL ||
        one->without.other)
        return -1;
    for (int i = 0; i < q->s->point[one->point].scene.quantities; i++) {
        const verdict *v = is_asked(q, i) ? verdict_on(q, series_index, i) : NULL;
        if (is_asked(q, i) && (v == NULL || v->truth == NULL))
            return 0;
    }
    return 1;
}

const char *reach_unranked(const element_type *type)
{
    if (type == NULL)
        return "";
    if (process_serves(type))
        return "in another process";
    if (type->misprint != NULL)
        return "kept with its misprint";
    return adapters_words(type)[0] != '\0' ? "by differences" : "";
}

static int has_no_rank(const formulation *chosen)
{
    return reach_unranked(chosen->type)[0] != '\0';
}

/* Of one series. 0: it is not within the level in all that is asked. */
static int reach_one(const reach_question *q, int series_index, reached *out)
{
    const series *one = &q->s->series[series_index];
    *out = (reached){.series = series_index, .mesh = -1};
    if (reach_asks(q, series_index) != 1)
        return 0;
    for (int i = 0; i < q->s->point[one->point].scene.quantities; i++) {
        if (!is_asked(q, i))
            continue;
        const verdict *v = verdict_on(q, series_index, i);
        const int mesh = reach_mesh(q->s, v, q->level);
        if (mesh < 0)
            return 0;
        out->mesh = mesh > out->mesh ? mesh : out->mesh;
        if (out->defect == NULL && reach_is_defect(v->kind))
            out->defect = v;
    }
    if (out->mesh < 0)
        return 0;
    out->cost = has_no_rank(&one->formulation)
                    ? INFINITY
                    : price_cost(&one->formulation, &one->cell[out->mesh]);
    return 1;
}

/* Does a stand before b? */
static int is_before(const sweep *s, const reached *a, const reached *b)
{
    if ((a->defect != NULL) != (b->defect != NULL))
        return a->defect == NULL;
    if (a->cost != b->cost)
        return a->cost < b->cost;
    return strcmp(s->series[a->series].formulation.key, s->series[b->series].formulation.key) < 0;
}

int reach_ranking(const reach_question *q, reached out[])
{
    int count = 0;
    for (int i = 0; i < q->s->seriess; i++) {
        reached one;
        if (!reach_one(q, i, &one))
            continue;
        int at = count++;
        for (; at > 0 && is_before(q->s, &one, &out[at - 1]); at--)
            out[at] = out[at - 1];
        out[at] = one;
    }
    return count;
}

int reach_ties(const reached list[], int count)
{
    int ties = 0;
    if (count > 0 && !isfinite(list[0].cost))
        return 0;
    while (
        ties < count && list[ties].defect == NULL &&
        (ties == 0 || (isfinite(list[ties].cost) && list[ties].cost <= price_noise * list[0].cost)))
        ties++;
    return ties;
}

static void add_verdict(const sweep *s, const truths *t, int index, int quantity, verdict *out)
{
    const sweep_point *p = &s->point[s->series[index].point];
    *out = (verdict){.series = index, .quantity = quantity};
    verdict_reach(s, t, out);
    if (out->truth == NULL && s->series[index].imported == NULL && !s->series[index].without.other)
        out->truth = verdict_reference(t, p, &s->series[index].formulation, quantity);
}

verdict *reach_verdicts(const sweep *s, const truths *t, int *count)
{
    int room = 1;
    *count = 0;
    for (int i = 0; i < s->seriess; i++)
        room += s->point[s->series[i].point].scene.quantities;
    verdict *all = calloc((size_t)room, sizeof *all);
    for (int i = 0; all != NULL && i < s->seriess; i++) {
        const scene *here = &s->point[s->series[i].point].scene;
        for (int k = 0; k < here->quantities; k++)
            if (here->quantity[k].reduction != SCENE_CURVE)
                add_verdict(s, t, i, k, &all[(*count)++]);
    }
    return all;
}
