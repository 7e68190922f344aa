#include "harness/experiments/extreme_judge.h"

#include <math.h>
#include <string.h>

#include "harness/study/study.h"

static int quantity_index(const extreme_outcome *o, const sweep_point *p)
{
    const char *name = extremes[o->extreme].quantity[o->quantity].name;
    int q = 0;
    while (q < p->scene.quantities && strcmp(p->scene.quantity[q].name, name) != 0)
        q++;
    return q;
}

/* The exact value, of the formulation's own theory of shear; or NULL. */
static const truth *exact_value(const extreme_sweep *s, const truths *t, const extreme_outcome *o)
{
    const sweep_point *p = &s->first.point[o->point];
    const int q = quantity_index(o, p);
    return q < p->scene.quantities ? verdict_truth(t, p, &s->formulation[o->formulation], q) : NULL;
}

/* Is there an exact value, but of another theory of shear only? */
static int has_other_theory(const extreme_sweep *s, const truths *t, const extreme_outcome *o)
{
    const sweep_point *p = &s->first.point[o->point];
    const char *name = extremes[o->extreme].quantity[o->quantity].name;
    return exact_value(s, t, o) == NULL && truth_of(t, p->type, p->parameter, name, "same") != NULL;
}

/* What the value should be, and how well that is known (relative). */
static double extreme_reference_of(const extreme_sweep *s, const truths *t,
                                   const extreme_outcome *o, int refinement, double *uncertainty)
{
    const extreme *e = &extremes[o->extreme];
    *uncertainty = 0;
    if (e->judge == EXTREME_SAME) {
        const extreme_outcome *base = extreme_sweep_base(s, o);
        const double power = e->quantity[o->quantity].power;
        return base != NULL
                   ? extreme_sweep_value(s, base, refinement) * pow(o->x / e->same_as, power)
                   : NAN;
    }
    const truth *row = exact_value(s, t, o);
    if (row != NULL && row->value != 0)
        *uncertainty = fabs(row->uncertainty / row->value);
    return row != NULL ? row->value : NAN;
}

static outcome_kind failure_of(status s)
{
    switch (s) {
    case STATUS_NOT_CONVERGED:
        return OUTCOME_NOT_CONVERGED;
    case STATUS_SINGULAR:
        return OUTCOME_SINGULAR;
    case STATUS_REFUSED:
        return OUTCOME_REFUSED;
    case STATUS_NO_VALUE:
        return OUTCOME_NO_VALUE;
    case STATUS_OK:
    case STATUS_FAULT:
    case STATUS_TIME_LIMIT:
        break;
    }
    return OUTCOME_FAULT;
}

static void set_kind(extreme_outcome *o, outcome_kind kind, const char *reason)
{
    o->kind = kind;
    o->reason = reason;
}

static void set_failure(extreme_outcome *o, status why, const char *reason)
{
    set_kind(o, failure_of(why), reason);
}

/* The number of the first mesh against its reference. */
static void judge_value(const scene_quantity *q, double value, double uncertainty,
                        extreme_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    o->result = value;
    o->error = verdict_error(q, value, o->reference);
    if (e->judge == EXTREME_SAME && !isfinite(o->reference))
        set_kind(o, OUTCOME_WRONG, "there is nothing to compare with: the base has no value");
    else
        o->kind = fabs(o->error) <= e->tolerance + uncertainty ? OUTCOME_VALUE : OUTCOME_WRONG;
}

status extreme_judge_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f)
{
    const extreme *e = &extremes[o->extreme];
    const series *one = &s->first.series[o->series];
    const sweep_point *p = &s->first.point[o->point];
    double uncertainty;
    o->result = o->error = NAN;
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++)
        o->neighbour_error[i] = NAN;
    o->reference = extreme_reference_of(s, t, o, 0, &uncertainty);
    const int other = e->judge == EXTREME_EXACT && has_other_theory(s, t, o);
    if (e->judge == EXTREME_EXACT && !isfinite(o->reference) && !other)
        return fault_set(f, STATUS_FAULT,
                         "extreme %s: no exact value of %s at %s; derive it "
                         "(reference/derive/extremes.py)",
                         e->name, e->quantity[o->quantity].name, p->text);
    const solve_result *solved = &one->cell[0].solve;
    const quantity_result *r = extreme_sweep_result(s, o, &one->cell[0]);
    if (one->missing[0] != '\0')
        set_kind(o, OUTCOME_SKIP, one->missing);
    else if (other)
        set_kind(o, OUTCOME_SKIP, "the exact value is of another theory of shear");
    else if (p->status != STATUS_OK)
        set_failure(o, p->status, p->reason);
    else if (r == NULL)
        set_failure(o, solved->status, solved->reason);
    else if (r->status != STATUS_OK)
        set_failure(o, r->status, r->reason);
    else
        judge_value(extreme_sweep_quantity(s, o), r->value, uncertainty, o);
    return STATUS_OK;
}

/* |error| on the meshes that have a value, coarse to fine. */
typedef struct mesh_refinement {
    int count;
    double elements[OUTCOME_NEIGHBOURS + 1], size[OUTCOME_NEIGHBOURS + 1];
} mesh_refinement;

static void add_mesh(mesh_refinement *r, int elements, double error)
{
    if (!isfinite(error))
        return;
    r->elements[r->count] = elements;
    r->size[r->count++] = fabs(error);
}

static int falls(const mesh_refinement *r)
{
    const int last = r->count - 1;
    if (r->count < 2 || r->size[last] > r->size[last - 1])
        return 0;
    return r->size[last] <= r->size[0] * sqrt(r->elements[0] / r->elements[last]);
}

void extreme_judge_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o)
{
    const int *mesh = s->neighbours.series[o->neighbours].mesh;
    const int own = s->first.series[o->series].mesh[0];
    mesh_refinement r = {.count = 0};
    int placed = 0;
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++) {
        double uncertainty;
        const double reference = extreme_reference_of(s, t, o, i + 1, &uncertainty);
        const double value = extreme_sweep_value(s, o, i + 1);
        o->neighbour_error[i] = verdict_error(extreme_sweep_quantity(s, o), value, reference);
        if (!placed && own < mesh[i]) {
            add_mesh(&r, own, o->error);
            placed = 1;
        }
        add_mesh(&r, mesh[i], o->neighbour_error[i]);
    }
    if (!placed)
        add_mesh(&r, own, o->error);
    if (falls(&r))
        o->kind = OUTCOME_COARSE;
    else
        set_kind(o, OUTCOME_WRONG, "the error does not fall with more elements");
}
