#include "harness/study/agreements.h"

#include <math.h>
#include <string.h>

#include "harness/numerics/numerics.h"
#include "harness/study/truth.h"

/* relative, of a value against its own stored discrete value */
static const double agreement_least = 1e-6;

static status add_agreement(const agreement *one, judgement *out, fault *f)
{
    TRY(memory_append(&out->agreement, &out->agreements, one, sizeof *one, "agreements", f));
    out->disagreements += !one->good;
    return STATUS_OK;
}

/* The values of one mesh against a row of the truths. */
static status compare_mesh(const sweep *s, const truth *row, int index, int mesh, judgement *out,
                           fault *f)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const solve_result *result = &one->cell[mesh].solve;
    for (int q = 0; q < p->scene.quantities; q++) {
        if (strcmp(p->scene.quantity[q].name, row->quantity) != 0 ||
            !sweep_selects(s, p, &one->formulation, row->quantity))
            continue;
        const double value = q < result->quantities ? result->quantity[q].value : NAN;
        const int good =
            fabs(value - row->value) <= fmax(row->uncertainty, agreement_least * fabs(row->value));
        TRY(add_agreement(&(agreement){index, mesh, q, row, value, good}, out, f));
    }
    return STATUS_OK;
}

status agreements_add(const sweep *s, const truths *t, int index, judgement *out, fault *f)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    if (one->missing[0] != '\0' || one->without.other)
        return STATUS_OK;
    for (int r = 0; r < t->rows; r++) {
        const truth *row = &t->row[r];
        if (row->elements == 0 || !truth_holds(row, p->type, p->parameter) || !truth_gates(row) ||
            strcmp(row->formulation, one->formulation.key) != 0)
            continue;
        for (int i = 0; i < one->meshes; i++)
            if (one->mesh[i] == row->elements)
                TRY(compare_mesh(s, row, index, i, out, f));
    }
    return STATUS_OK;
}
