#include "harness/extremes/stress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/judge/verdict.h"

enum { enough_elements = 16 }; /* from here on the neighbours are coarser meshes, else finer ones */

const cell_result *stress_cell(const stress *s, const stress_outcome *o)
{
    return &s->first.series[o->series].cell[0];
}

static const scene_quantity *quantity_of(const stress *s, const stress_outcome *o)
{
    const scene *all = &s->first.point[o->point].scene;
    for (int i = 0; i < all->quantities; i++)
        if (strcmp(all->quantity[i].name, extremes[o->extreme].quantity[o->quantity].name) == 0)
            return &all->quantity[i];
    return NULL;
}

static const quantity_result *result_of(const stress *s, const stress_outcome *o, const cell_result *cell)
{
    const ptrdiff_t index = quantity_of(s, o) - s->first.point[o->point].scene.quantity;
    return index < cell->solve.quantities ? &cell->solve.quantity[index] : NULL;
}

/* Value on the first mesh (refinement 0) or on a neighbouring one; NAN: there is none. */
static double value_of(const stress *s, const stress_outcome *o, int refinement)
{
    if (refinement > 0 && o->neighbours < 0)
        return NAN;
    const cell_result *cell = refinement == 0 ? stress_cell(s, o) : &s->neighbours.series[o->neighbours].cell[refinement - 1];
    const quantity_result *r = result_of(s, o, cell);
    return r != NULL && r->status == STATUS_OK ? r->value : NAN;
}

/* The outcome of the same formulation and quantity at the x that others are compared with. */
static stress_outcome *base_of(const stress *s, const stress_outcome *o)
{
    for (int i = 0; i < s->outcomes; i++) {
        stress_outcome *b = &s->outcome[i];
        if (b->extreme == o->extreme && b->formulation == o->formulation && b->quantity == o->quantity &&
            b->x == extremes[o->extreme].same_as)
            return b;
    }
    return NULL;
}

/* What the value should be, and how well that is known (relative). */
static double reference_of(const stress *s, const truths *t, const stress_outcome *o, int refinement, double *uncertainty)
{
    const extreme *e = &extremes[o->extreme];
    const point *p = &s->first.point[o->point];
    *uncertainty = 0;
    if (e->judge == EXTREME_SAME) {
        const stress_outcome *base = base_of(s, o);
        const double power = e->quantity[o->quantity].power;
        return base != NULL ? value_of(s, base, refinement) * pow(o->x / e->same_as, power) : NAN;
    }
    const truth *row = truth_of(t, p->type, p->parameter, e->quantity[o->quantity].name, "same");
    if (row != NULL && row->value != 0)
        *uncertainty = fabs(row->uncertainty / row->value);
    return row != NULL ? row->value : NAN;
}

static stress_kind failure_of(status s)
{
    switch (s) {
    case STATUS_NOT_CONVERGED:
        return STRESS_NOT_CONVERGED;
    case STATUS_SINGULAR:
        return STRESS_SINGULAR;
    case STATUS_REFUSED:
        return STRESS_REFUSED;
    case STATUS_OK:
    case STATUS_FAULT:
    case STATUS_TIME_LIMIT:
        break;
    }
    return STRESS_FAULT;
}

/* From the first mesh alone: a value, a failure, or wrong until other meshes are seen. */
static status judge_first(const stress *s, const truths *t, stress_outcome *o, fault *f)
{
    const extreme *e = &extremes[o->extreme];
    const series *one = &s->first.series[o->series];
    const point *p = &s->first.point[o->point];
    double uncertainty;
    o->result = o->error = NAN;
    for (int i = 0; i < STRESS_NEIGHBOURS; i++)
        o->neighbour_error[i] = NAN;
    o->reference = reference_of(s, t, o, 0, &uncertainty);
    if (e->judge == EXTREME_EXACT && !isfinite(o->reference))
        return fault_set(f, STATUS_FAULT, "extreme %s: no exact value of %s at %s; derive it (reference/derive/extremes.py)",
                         e->name, e->quantity[o->quantity].name, p->text);
    if (one->missing[0] != '\0') {
        o->kind = STRESS_SKIP;
        o->reason = one->missing;
        return STATUS_OK;
    }
    const quantity_result *r = result_of(s, o, &one->cell[0]);
    if (p->status != STATUS_OK || r == NULL || r->status != STATUS_OK || !isfinite(r->value)) {
        const status why = p->status != STATUS_OK ? p->status : r != NULL ? r->status : one->cell[0].solve.status;
        o->kind = why == STATUS_OK ? STRESS_NO_VALUE : failure_of(why);
        o->reason = p->status != STATUS_OK ? p->reason : r != NULL ? r->reason : one->cell[0].solve.reason;
        return STATUS_OK;
    }
    o->result = r->value;
    o->error = relative_error(quantity_of(s, o), o->result, o->reference);
    if (e->judge == EXTREME_SAME && !isfinite(o->reference)) {
        o->kind = STRESS_WRONG;
        o->reason = "there is nothing to compare with: the base has no value";
        return STATUS_OK;
    }
    o->kind = fabs(o->error) <= e->tolerance + uncertainty ? STRESS_VALUE : STRESS_WRONG;
    return STATUS_OK;
}

/* Does the error fall as a discretisation error does: to the finest mesh, by order 0.5 at least? */
static void judge_neighbours(const stress *s, const truths *t, stress_outcome *o)
{
    const int *mesh = s->neighbours.series[o->neighbours].mesh, own = s->first.series[o->series].mesh[0];
    double size[STRESS_NEIGHBOURS + 1], elements[STRESS_NEIGHBOURS + 1];
    int count = 0, placed = 0;
    for (int i = 0; i <= STRESS_NEIGHBOURS; i++) { /* meshes that have a value, coarse to fine */
        if (!placed && (i == STRESS_NEIGHBOURS || own < mesh[i])) {
            elements[count] = own;
            size[count++] = fabs(o->error);
            placed = 1;
        }
        if (i == STRESS_NEIGHBOURS)
            break;
        double uncertainty;
        const double reference = reference_of(s, t, o, i + 1, &uncertainty), value = value_of(s, o, i + 1);
        o->neighbour_error[i] = relative_error(quantity_of(s, o), value, reference);
        if (isfinite(o->neighbour_error[i])) {
            elements[count] = mesh[i];
            size[count++] = fabs(o->neighbour_error[i]);
        }
    }
    const int last = count - 1;
    if (count > 1 && size[last] <= size[last - 1] && size[last] <= size[0] * sqrt(elements[0] / elements[last])) {
        o->kind = STRESS_COARSE;
    } else {
        o->kind = STRESS_WRONG;
        o->reason = "the error does not fall with more elements";
    }
}

/* A series of neighbouring meshes for the cell of an outcome, once. */
static status refine(stress *s, stress_outcome *o, fault *f)
{
    const series *one = &s->first.series[o->series];
    const point *p = &s->first.point[o->point];
    if (o->neighbours >= 0)
        return STATUS_OK;
    const int n = one->mesh[0], coarser = n >= enough_elements;
    const int mesh[STRESS_NEIGHBOURS] = {coarser ? n / 4 : 2 * n, coarser ? n / 2 : 4 * n};
    status outcome = sweep_add(&s->neighbours, p->type, p->parameter, mesh, STRESS_NEIGHBOURS, f);
    if (outcome == STATUS_OK) {
        point *near = &s->neighbours.point[s->neighbours.points - 1];
        near->edit = p->edit;
        near->steps = p->steps;
        outcome = sweep_extend(&s->neighbours, &one->formulation, 1, f);
    }
    for (int i = 0; i < s->outcomes && outcome == STATUS_OK; i++)
        if (s->outcome[i].series == o->series)
            s->outcome[i].neighbours = s->neighbours.seriess - 1;
    return outcome;
}

static status look_closer(const stress_request *request, stress *s, const truths *t, fault *f)
{
    const sweep_request run = {.jobs = request->jobs, .progress = request->progress};
    status outcome = STATUS_OK;
    for (int i = 0; i < s->outcomes && outcome == STATUS_OK; i++) {
        stress_outcome *o = &s->outcome[i];
        if (o->kind != STRESS_WRONG || !isfinite(o->error))
            continue;
        outcome = refine(s, o, f);
        stress_outcome *base = extremes[o->extreme].judge == EXTREME_SAME ? base_of(s, o) : NULL;
        if (outcome == STATUS_OK && base != NULL)
            outcome = refine(s, base, f);
    }
    if (outcome == STATUS_OK && s->neighbours.seriess > 0)
        outcome = sweep_run(&run, &s->neighbours, f);
    for (int i = 0; i < s->outcomes && outcome == STATUS_OK; i++)
        if (s->outcome[i].kind == STRESS_WRONG && isfinite(s->outcome[i].error))
            judge_neighbours(s, t, &s->outcome[i]);
    return outcome;
}

status stress_run(const stress_request *request, const char *path, stress *out, fault *f)
{
    truths t = {0};
    memset(out, 0, sizeof *out);
    status outcome = truths_read(path, &t, f);
    if (outcome == STATUS_OK)
        outcome = truths_read_extremes(path, &t, f);
    if (outcome == STATUS_OK)
        outcome = stress_findings_read(path, out, f);
    if (outcome == STATUS_OK)
        outcome = stress_plan(request, out, f);
    const sweep_request run = {.jobs = request->jobs, .progress = request->progress};
    if (outcome == STATUS_OK && out->outcomes > 0)
        outcome = sweep_run(&run, &out->first, f);
    for (int i = 0; i < out->outcomes && outcome == STATUS_OK; i++)
        outcome = judge_first(out, &t, &out->outcome[i], f);
    if (outcome == STATUS_OK)
        outcome = look_closer(request, out, &t, f);
    if (outcome == STATUS_OK)
        stress_expect(out, request->select == NULL && request->formulations == 0);
    truths_free(&t);
    if (outcome != STATUS_OK)
        stress_free(out);
    return outcome;
}
