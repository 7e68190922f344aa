#include "harness/records/records_impl.h"

#include <stdlib.h>
#include <string.h>

struct held_record {
    held_record *next;
    _Alignas(max_align_t) char record[];
};

void gather_add(subjects *list, const subject *one)
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
    return (subject){
        .sweep = g->sweep, .point = &g->sweep->point[one->point], .series = one, .record = one};
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

subject gather_coverage(const gathering *g, const coverage *c, int left_out)
{
    return (subject){
        .sweep = g->sweep, .point = &g->sweep->point[c->point], .record = c, .index = left_out};
}

/* Returns the index of the first verdict on the series or on a later series. Verdicts are in the
 * order of the series. */
static int first_verdict(const evaluation *j, int series_index)
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
    const evaluation *j = g->evaluated;
    s->truth = s->model_truth = NULL;
    if (j == NULL) {
        if (g->truths != NULL)
            s->truth = verdict_reference(g->truths, s->point, &s->series->formulation, s->index);
        if (s->series->without.other) {
            s->model_truth = s->truth;
            s->truth = NULL;
        }
        return;
    }
    for (int i = first_verdict(j, series_index);
         i < j->verdicts && j->verdict[i].series == series_index; i++)
        if (j->verdict[i].quantity == s->index) {
            s->truth = j->verdict[i].truth;
            s->model_truth = j->verdict[i].model_truth;
        }
}

static void add_array(subject s, int count, const void *array, size_t size, subjects *out)
{
    for (s.index = 0; s.index < count; s.index++) {
        s.record = (const char *)array + (size_t)s.index * size;
        gather_add(out, &s);
    }
}

static void add_curves(subject s, const solve_result *r, subjects *out)
{
    const subject *last = out->count > 0 ? &out->row[out->count - 1] : NULL;
    s.group =
        last != NULL ? last->group + ((const quantity_result *)last->record)->curve.points : 0;
    for (s.index = 0; s.index < r->quantities; s.index++) {
        s.record = &r->quantity[s.index];
        if (r->quantity[s.index].curve.points > 0)
            gather_add(out, &s);
        s.group += r->quantity[s.index].curve.points;
    }
}

static void add_quantities(const gathering *g, int series_index, subject s, const solve_result *r,
                           subjects *out)
{
    for (s.index = 0; s.index < r->quantities; s.index++) {
        s.record = &r->quantity[s.index];
        compare_with(g, series_index, &s);
        gather_add(out, &s);
    }
}

static void add_iterations(subject s, const solve_result *r, subjects *out)
{
    for (s.group = 0; s.group < r->steps; s.group++)
        add_array(s, r->step[s.group].iterations, r->iteration + r->step[s.group].first,
                  sizeof *r->iteration, out);
}

static void add_matrices(subject s, const solve_result *r, subjects *out)
{
    for (int i = 0; i < r->matrix_sets; i++)
        add_array(s, r->matrices[i].stations, &r->matrices[i], 0, out);
}

void gather_mesh(const gathering *g, const record_type *type, int series_index, int mesh,
                 subjects *out)
{
    const subject cell = gather_cell(g, series_index, mesh);
    const solve_result *r = &cell.series->cell[mesh].solve;
    if (type == &record_cell)
        gather_add(out, &cell);
    else if (type == &record_quantity)
        add_quantities(g, series_index, cell, r, out);
    else if (type == &record_curve)
        add_curves(cell, r, out);
    else if (type == &record_step)
        add_array(cell, r->steps, r->step, sizeof *r->step, out);
    else if (type == &record_iteration)
        add_iterations(cell, r, out);
    else if (type == &record_event)
        add_array(cell, r->events, r->event, sizeof *r->event, out);
    else if (type == &record_motion)
        add_array(cell, r->motions, r->motion, sizeof *r->motion, out);
    else if (type == &record_matrix)
        add_matrices(cell, r, out);
    else if (type == &record_timing && cell.series->timing != NULL)
        add_array(cell, 1, &cell.series->timing[mesh], 0, out);
}

static void add_imports(subject s, const imported *found, subjects *out)
{
    for (int i = 0; i < found->rows; i++) {
        s.record = &found->row[i];
        s.index = 0;
        while (s.index + 1 < s.point->scene.quantities &&
               strcmp(s.point->scene.quantity[s.index].name, found->row[i].quantity) != 0)
            s.index++;
        gather_add(out, &s);
    }
}

static void gather_series(const gathering *g, const record_type *type, int index, subjects *out)
{
    const subject s = series_subject(g, index);
    if (type == &record_series)
        gather_add(out, &s);
    if (s.series->missing[0] == '\0')
        for (int i = 0; i < s.series->meshes; i++)
            gather_mesh(g, type, index, i, out);
    if (type == &record_import && s.series->imported != NULL)
        add_imports(s, s.series->imported, out);
    if (type != &record_verdict || g->evaluated == NULL)
        return;
    for (int i = first_verdict(g->evaluated, index);
         i < g->evaluated->verdicts && g->evaluated->verdict[i].series == index; i++) {
        const subject one = gather_verdict(g, &g->evaluated->verdict[i]);
        gather_add(out, &one);
    }
}

static void gather_points(const gathering *g, const case_type *of, subjects *out)
{
    const sweep *all = g->sweep;
    for (int i = 0; i < all->seriess; i++) {
        const sweep_point *p = &all->point[all->series[i].point];
        const subject s = {.sweep = all, .point = p, .record = p};
        int known = p->type != of;
        for (int k = 0; k < out->count && !known; k++)
            known = out->row[k].point == p;
        if (!known)
            gather_add(out, &s);
    }
}

static void gather_parameters(subject s, subjects *out)
{
    while (parameter_at(s.point->type->parameters, s.index) != NULL) {
        gather_add(out, &s);
        s.index++;
    }
}

static void gather_meanings(subject s, subjects *out)
{
    for (; s.index < s.point->scene.quantities; s.index++)
        gather_add(out, &s);
}

void gather_assumptions(const sweep_point *p, subjects *out)
{
    assumption a;
    for (subject s = {.point = p, .record = p}; assumptions_at(p, s.index, &a); s.index++)
        gather_add(out, &s);
}

static void gather_of_points(const gathering *g, const record_type *type, const case_type *of,
                             subjects *out)
{
    subjects points = {0};
    gather_points(g, of, &points);
    out->bad |= points.bad;
    if (type == &record_parameter && points.count > 0)
        gather_parameters(points.row[0], out);
    for (int i = 0; i < points.count && type == &record_meaning; i++)
        gather_meanings(points.row[i], out);
    for (int i = 0; i < points.count && type == &record_assumption; i++)
        gather_assumptions(points.row[i].point, out);
    gather_free(&points);
}

static void gather_agreements(const gathering *g, const case_type *of, subjects *out)
{
    if (g->evaluated != NULL)
        for (int i = 0; i < g->evaluated->agreements; i++) {
            const subject s = gather_agreement(g, &g->evaluated->agreement[i]);
            if (s.point->type == of)
                gather_add(out, &s);
        }
}

static void gather_coverages(const gathering *g, const case_type *of, subjects *out)
{
    if (g->evaluated != NULL)
        for (int i = 0; i < g->evaluated->coverages; i++)
            if (g->evaluated->coverage[i].of == of)
                for (int k = 0; k < COVERAGE_MESHES; k++) {
                    const subject s = gather_coverage(g, &g->evaluated->coverage[i], k);
                    gather_add(out, &s);
                }
}

static int has_formulation(const subjects *list, const char *key)
{
    int i = 0;
    while (i < list->count && strcmp(list->row[i].series->formulation.key, key) != 0)
        i++;
    return i < list->count;
}

void gather_declarations(const gathering *g, subjects *out)
{
    for (int i = 0; i < g->sweep->seriess; i++) {
        const series *one = &g->sweep->series[i];
        if (one->imported != NULL || has_formulation(out, one->formulation.key))
            continue;
        const subject s = {.sweep = g->sweep, .series = one};
        gather_add(out, &s);
    }
}

void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out)
{
    if (type == &record_point || type == &record_scene)
        gather_points(g, of, out);
    if (type == &record_parameter || type == &record_meaning || type == &record_assumption)
        gather_of_points(g, type, of, out);
    if (type == &record_agreement)
        gather_agreements(g, of, out);
    if (type == &record_coverage)
        gather_coverages(g, of, out);
    for (int i = 0; i < g->sweep->seriess; i++)
        if (g->sweep->point[g->sweep->series[i].point].type == of)
            gather_series(g, type, i, out);
}

const void *gather_keep(subjects *list, const void *record, size_t size)
{
    held_record *one = malloc(sizeof *one + size);
    list->bad |= one == NULL;
    if (one == NULL)
        return NULL;
    one->next = list->held;
    list->held = one;
    return memcpy(one->record, record, size);
}

void gather_free(subjects *list)
{
    while (list->held != NULL) {
        held_record *next = list->held->next;
        free(list->held);
        list->held = next;
    }
    free(list->row);
    memset(list, 0, sizeof *list);
}
