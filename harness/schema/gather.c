#include "harness/schema/gather.h"

#include <stdlib.h>
#include <string.h>

#include "harness/timing/timing.h"

static void add(subjects *list, const subject *one)
{
    if (list->count == list->room) {
        const int room = 2 * list->room + 16;
        subject *more = realloc(list->row, (size_t)room * sizeof *more);
        list->bad |= more == NULL;
        if (more == NULL)
            return;
        list->row = more;
        list->room = room;
    }
    list->row[list->count++] = *one;
}

static subject series_subject(const gathering *g, int index)
{
    const series *one = &g->sweep->series[index];
    return (subject){.sweep = g->sweep, .point = &g->sweep->point[one->point], .series = one, .record = one};
}

subject gather_cell(const gathering *g, int series_index, int mesh)
{
    subject out = series_subject(g, series_index);
    out.mesh = mesh;
    out.record = &out.series->cell[mesh];
    return out;
}

subject gather_verdict(const gathering *g, const verdict *v)
{
    subject out = series_subject(g, v->series);
    out.record = out.verdict = v;
    out.index = v->quantity;
    out.truth = v->truth;
    out.model_truth = v->model_truth;
    return out;
}

subject gather_agreement(const gathering *g, const agreement *a)
{
    subject out = gather_cell(g, a->series, a->mesh);
    out.record = a;
    out.index = a->quantity;
    out.truth = a->truth;
    return out;
}

/* Verdicts come in the order of the series: index of the first one of it or of a later one. */
static int first_verdict(const judgement *j, int series_index)
{
    int low = 0, high = j->verdicts;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (j->verdict[middle].series < series_index)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void compare_with(const gathering *g, int series_index, subject *s)
{
    const judgement *j = g->judged;
    s->truth = s->model_truth = NULL;
    for (int i = j != NULL ? first_verdict(j, series_index) : 0;
         j != NULL && i < j->verdicts && j->verdict[i].series == series_index; i++)
        if (j->verdict[i].quantity == s->index) {
            s->truth = j->verdict[i].truth;
            s->model_truth = j->verdict[i].model_truth;
        }
    if (j == NULL && g->truths != NULL)
        s->truth = truth_of(g->truths, s->point->type, s->point->parameter, s->point->scene.quantity[s->index].name, "same");
}

/* Of one mesh; `s` is the subject of the cell. */
static void add_cell(const solve_result *r, subject s, subjects *out)
{
    (void)r;
    add(out, &s);
}

static void add_curves(const solve_result *r, subject s, subjects *out)
{
    const subject *last = out->count > 0 ? &out->row[out->count - 1] : NULL;
    s.group = last != NULL ? last->group + ((const quantity_result *)last->record)->curve.points : 0;
    for (s.index = 0; s.index < r->quantities; s.index++) {
        s.record = &r->quantity[s.index];
        if (r->quantity[s.index].curve.points > 0)
            add(out, &s);
        s.group += r->quantity[s.index].curve.points;
    }
}

static void add_steps(const solve_result *r, subject s, subjects *out)
{
    for (s.index = 0; s.index < r->steps; s.index++) {
        s.record = &r->step[s.index];
        add(out, &s);
    }
}

static void add_iterations(const solve_result *r, subject s, subjects *out)
{
    for (s.group = 0; s.group < r->steps; s.group++)
        for (s.index = 0; s.index < r->step[s.group].iterations; s.index++) {
            s.record = &r->iteration[r->step[s.group].first + s.index];
            add(out, &s);
        }
}

static void add_events(const solve_result *r, subject s, subjects *out)
{
    for (s.index = 0; s.index < r->events; s.index++) {
        s.record = &r->event[s.index];
        add(out, &s);
    }
}

static void add_matrices(const solve_result *r, subject s, subjects *out)
{
    for (int i = 0; i < r->matrix_sets; i++)
        for (s.index = 0; s.index < r->matrices[i].stations; s.index++) {
            s.record = &r->matrices[i];
            add(out, &s);
        }
}

static void add_timing(const solve_result *r, subject s, subjects *out)
{
    (void)r;
    s.record = s.series->timing != NULL ? &s.series->timing[s.mesh] : NULL;
    if (s.record != NULL)
        add(out, &s);
}

static void add_quantities(const gathering *g, int series_index, const solve_result *r, subject s, subjects *out)
{
    for (s.index = 0; s.index < r->quantities; s.index++) {
        s.record = &r->quantity[s.index];
        compare_with(g, series_index, &s);
        add(out, &s);
    }
}

static const struct {
    const record_type *type;
    void (*add)(const solve_result *r, subject cell, subjects *out);
} of_mesh[] = {
    {&record_cell, add_cell},    {&record_curve, add_curves},    {&record_step, add_steps},   {&record_iteration, add_iterations},
    {&record_event, add_events}, {&record_matrix, add_matrices}, {&record_timing, add_timing}};

void gather_mesh(const gathering *g, const record_type *type, int series_index, int mesh, subjects *out)
{
    const subject cell = gather_cell(g, series_index, mesh);
    const solve_result *r = &cell.series->cell[mesh].solve;
    if (type == &record_quantity)
        add_quantities(g, series_index, r, cell, out);
    for (size_t i = 0; i < sizeof of_mesh / sizeof of_mesh[0]; i++)
        if (of_mesh[i].type == type)
            of_mesh[i].add(r, cell, out);
}

static void gather_series(const gathering *g, const record_type *type, int index, subjects *out)
{
    const subject s = series_subject(g, index);
    if (type == &record_series)
        add(out, &s);
    for (int i = 0; i < s.series->meshes && s.series->missing[0] == '\0'; i++)
        gather_mesh(g, type, index, i, out);
    if (type != &record_verdict || g->judged == NULL)
        return;
    for (int i = first_verdict(g->judged, index); i < g->judged->verdicts && g->judged->verdict[i].series == index; i++) {
        const subject one = gather_verdict(g, &g->judged->verdict[i]);
        add(out, &one);
    }
}

/* Points that have a series. */
static void gather_points(const gathering *g, const case_type *of, subjects *out)
{
    const sweep *all = g->sweep;
    for (int i = 0; i < all->seriess; i++) {
        const point *p = &all->point[all->series[i].point];
        const subject s = {.sweep = all, .point = p, .record = p};
        int known = p->type != of;
        for (int k = 0; k < out->count && !known; k++)
            known = out->row[k].point == p;
        if (!known)
            add(out, &s);
    }
}

static void gather_agreements(const gathering *g, const case_type *of, subjects *out)
{
    for (int i = 0; g->judged != NULL && i < g->judged->agreements; i++) {
        const subject s = gather_agreement(g, &g->judged->agreement[i]);
        if (s.point->type == of)
            add(out, &s);
    }
}

void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out)
{
    if (type == &record_point)
        gather_points(g, of, out);
    if (type == &record_agreement)
        gather_agreements(g, of, out);
    for (int i = 0; i < g->sweep->seriess; i++)
        if (g->sweep->point[g->sweep->series[i].point].type == of)
            gather_series(g, type, i, out);
}

void subjects_free(subjects *list)
{
    free(list->row);
    memset(list, 0, sizeof *list);
}
