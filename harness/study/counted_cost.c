#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double count_of(const cell_result *c, counted_work which)
{
    switch (which) {
    case COUNTED_elements_total:
        return c->size.elements;
    case COUNTED_element_kinds:
        return c->size.kinds;
    case COUNTED_strain_evaluations:
        return (double)c->counters.strain_evaluations;
    case COUNTED_stress_evaluations:
        return (double)c->counters.stress_evaluations;
    case COUNTED_inertia_evaluations:
        return (double)c->counters.inertia_evaluations;
    case COUNTED_geometric_evaluations:
        return (double)c->counters.geometric_evaluations;
    case COUNTED_load_steps:
        return (double)c->counters.steps;
    case COUNTED_solutions:
        return (double)c->counters.numerics.solutions;
    case COUNTED_solved_entries:
        return c->counters.numerics.solved_entries;
    case COUNTED_factor_flops:
        return c->counters.numerics.factor_flops;
    case COUNTED_dense_operations:
        return c->counters.numerics.dense_operations;
    default:
        return 1;
    }
}

/* Returns 1 if "key=value" of the given length is one of the options in "name:key=value,...". */
static int has_option(const char *key, const char *option, size_t length)
{
    const char *at = strchr(key, ':');
    while (at != NULL && at[0] != '\0') {
        at++;
        if (strncmp(at, option, length) == 0 && strchr(",", at[length]) != NULL)
            return 1;
        at = strchr(at, ',');
    }
    return 0;
}

/* Returns one plus the number of options of the row, all of which the formulation must have; 0: the
 * row does not apply. */
static int match(const char *row, const char *key)
{
    const size_t name = strcspn(row, ":");
    int options = 1;
    if (name != strcspn(key, ":") || strncmp(row, key, name) != 0)
        return 0;
    for (const char *at = row + name; *at != '\0'; options++) {
        const size_t length = strcspn(at + 1, ",");
        if (!has_option(key, at + 1, length))
            return 0;
        at += 1 + length;
    }
    return options;
}

/* Returns the name in the matching rows with the most options; "*": no row matches. */
static const char *row_name(const cost_coefficient *rows, const char *key)
{
    const char *best = "*";
    for (int most = 0; rows->formulation != NULL; rows++) {
        const int here = match(rows->formulation, key);
        if (here <= most)
            continue;
        most = here;
        best = rows->formulation;
    }
    return best;
}

double counted_cost_of(const cost_coefficient *rows, const formulation *chosen,
                       const cell_result *cell)
{
    const char *own = row_name(rows, chosen->key);
    double sum = 0;
    for (; rows->formulation != NULL; rows++)
        if (rows->formulation[0] == '\0' || strcmp(rows->formulation, own) == 0)
            sum += rows->seconds * count_of(cell, rows->count);
    return sum;
}

double counted_cost(const formulation *chosen, const cell_result *cell)
{
    return counted_cost_of(cost_coefficients, chosen, cell);
}

int has_cost_coefficients(const cost_coefficient *rows, const formulation *chosen)
{
    return strcmp(row_name(rows, chosen->key), "*") != 0;
}

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
        if (!(fabs(verdict_error(q, value, v->truth->value)) <= level)) /* false even for NAN */
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
        return "with an unknown limit";
    default:
        return "with a different limit";
    }
}

static int is_requested(const reach_question *q, int quantity)
{
    int known = 0;
    if (q->quantity != REACH_EVERY)
        return quantity == q->quantity;
    for (int i = 0; i < q->verdicts && !known; i++)
        known = q->verdict[i].quantity == quantity && q->verdict[i].truth != NULL &&
                q->s->series[q->verdict[i].series].point == q->point;
    return known;
}

static const verdict *verdict_on(const reach_question *q, int series_index, int quantity)
{
    for (int i = 0; i < q->verdicts; i++)
        if (q->verdict[i].series == series_index && q->verdict[i].quantity == quantity)
            return &q->verdict[i];
    return NULL;
}

int reach_has_references(const reach_question *q, int series_index)
{
    const series *one = &q->s->series[series_index];
    if (one->point != q->point || one->missing[0] != '\0' || one->imported != NULL ||
        one->without.other)
        return -1;
    for (int i = 0; i < q->s->point[one->point].scene.quantities; i++) {
        const verdict *v = is_requested(q, i) ? verdict_on(q, series_index, i) : NULL;
        if (is_requested(q, i) && (v == NULL || v->truth == NULL))
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
        return "implemented with its misprint";
    return adapters_words(type)[0] != '\0' ? "by differences" : "";
}

static int has_no_rank(const formulation *chosen)
{
    return reach_unranked(chosen->type)[0] != '\0';
}

static int reach_one(const reach_question *q, int series_index, reached *out)
{
    const series *one = &q->s->series[series_index];
    *out = (reached){.series = series_index, .mesh = -1};
    if (reach_has_references(q, series_index) != 1)
        return 0;
    for (int i = 0; i < q->s->point[one->point].scene.quantities; i++) {
        if (!is_requested(q, i))
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
                    : counted_cost(&one->formulation, &one->cell[out->mesh]);
    return 1;
}

/* Returns 1 if a ranks before b. Formulations without a defect rank before the others. Within both
 * groups, the order is that of cost, then of name. */
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
    while (ties < count && list[ties].defect == NULL &&
           (ties == 0 ||
            (isfinite(list[ties].cost) && list[ties].cost <= counted_cost_noise * list[0].cost)))
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

/* Returns the reference value of a quantity of a series; NULL: none, or a curve. */
static const truth *reference_of(const sweep *s, const truths *t, int index, int quantity)
{
    const sweep_point *p = &s->point[0];
    return p->scene.quantity[quantity].reduction == SCENE_CURVE
               ? NULL
               : verdict_reference(t, p, &s->series[index].formulation, quantity);
}

int equal_error_includes(const sweep *s, const truths *t, int quantity)
{
    return reference_of(s, t, 0, quantity) != NULL && reference_of(s, t, 1, quantity) != NULL;
}

int equal_error_quantities(const sweep *s, const truths *t)
{
    int requested = 0;
    for (int q = 0; q < s->point[0].scene.quantities; q++)
        requested += equal_error_includes(s, t, q);
    return requested;
}

static int mesh_within(const sweep *s, const truths *t, int index, double level)
{
    int mesh = 0;
    for (int q = 0; q < s->point[0].scene.quantities && mesh >= 0; q++) {
        if (!equal_error_includes(s, t, q))
            continue;
        const verdict v = {.series = index, .quantity = q, .truth = reference_of(s, t, index, q)};
        const int here = reach_mesh(s, &v, level);
        mesh = here < 0 || here > mesh ? here : mesh;
    }
    return mesh;
}

static double largest_error(const sweep *s, const truths *t, int index, int mesh)
{
    const scene *wanted = &s->point[0].scene;
    const solve_result *r = &s->series[index].cell[mesh].solve;
    double largest = 0;
    for (int q = 0; q < wanted->quantities; q++)
        if (equal_error_includes(s, t, q))
            largest = fmax(largest, fabs(verdict_error(&wanted->quantity[q], r->quantity[q].value,
                                                       reference_of(s, t, index, q)->value)));
    return largest;
}

equal_error equal_error_at(const sweep *s, const truths *t, double level)
{
    equal_error m;
    for (int i = 0; i < 2; i++) {
        m.mesh[i] = mesh_within(s, t, i, level);
        m.error[i] = m.mesh[i] >= 0 ? largest_error(s, t, i, m.mesh[i]) : (double)NAN;
    }
    return m;
}

int equal_error_met(const equal_error *m)
{
    return m->mesh[0] >= 0 && m->mesh[1] >= 0;
}
