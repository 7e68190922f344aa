#include "harness/experiments/extreme_expect.h"

#include <fnmatch.h>
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

static status read_rows(table_columns *r, extreme_sweep *out)
{
    static const columns_field field[] = {
        {"extreme", 1, offsetof(extreme_finding, extreme)},
        {"formulation", 1, offsetof(extreme_finding, formulation)},
        {"quantity", 1, offsetof(extreme_finding, quantity)},
        {"outcome", 1, offsetof(extreme_finding, outcome)},
        {"proof", 1, offsetof(extreme_finding, proof)},
        {"from", 0, offsetof(extreme_finding, from)},
        {"to", 0, offsetof(extreme_finding, to)}};
    r->rows = r->group >= 0 ? columns_length(r->group, "outcome") : -1;
    if (r->rows < 0)
        return columns_broken(r, "outcome");
    out->finding = calloc((size_t)r->rows + 1, sizeof *out->finding);
    if (out->finding == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for findings");
    out->findings = r->rows;
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++)
        TRY(columns_read(r, &field[i], out->finding, sizeof *out->finding));
    return STATUS_OK;
}

status extreme_expect_read(const char *path, extreme_sweep *out, fault *f)
{
    table_columns r = {.path = path, .name = "extreme_findings", .f = f};
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    r.group = file >= 0 ? H5Gopen2(file, r.name, H5P_DEFAULT) : -1;
    const status outcome = read_rows(&r, out);
    if (r.group >= 0)
        H5Gclose(r.group);
    if (file >= 0)
        H5Fclose(file);
    return outcome;
}

static int speaks_of(const extreme_finding *row, const extreme_sweep *s, const extreme_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    const double slack = 1e-9; /* 1e-4 of a table and pow(10, -4) */
    return o->x >= row->from * (1 - slack) && o->x <= row->to * (1 + slack) &&
           fnmatch(row->extreme, e->name, 0) == 0 &&
           fnmatch(row->formulation, s->formulation[o->formulation].key, 0) == 0 &&
           fnmatch(row->quantity, e->quantity[o->quantity].name, 0) == 0;
}

/* From the best of a cell to the worst. */
static int badness(outcome_kind kind)
{
    static const int rank[OUTCOME_KINDS] = {
        [OUTCOME_VALUE] = 1,         [OUTCOME_COARSE] = 2,   [OUTCOME_REFUSED] = 3,
        [OUTCOME_NOT_CONVERGED] = 3, [OUTCOME_SINGULAR] = 3, [OUTCOME_NO_VALUE] = 3,
        [OUTCOME_WRONG] = 4,         [OUTCOME_FAULT] = 5};
    return rank[kind];
}

static void count_cell(outcome_kind worst, extreme_count *c)
{
    c->tried += worst != OUTCOME_SKIP;
    c->survived += outcome_is_good(worst);
    c->coarse += worst == OUTCOME_COARSE;
    c->named += badness(worst) == 3;
    c->wrong += worst == OUTCOME_WRONG;
    c->faults += worst == OUTCOME_FAULT;
}

/* Outcomes of one cell follow each other; a cell is as bad as its worst one. */
static void count_cells(extreme_sweep *s)
{
    outcome_kind worst = OUTCOME_SKIP;
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (i == 0 || o[-1].series != o->series || badness(o->kind) > badness(worst))
            worst = o->kind;
        if (i == s->outcomes - 1 || o[1].series != o->series)
            count_cell(worst, &s->count[o->formulation]);
    }
}

static void set_expected(extreme_sweep *s, extreme_outcome *o)
{
    o->finding = NULL;
    o->as_expected = 1;
    if (o->kind == OUTCOME_SKIP)
        return;
    for (int k = 0; k < s->findings; k++)
        if (speaks_of(&s->finding[k], s, o)) {
            o->finding = &s->finding[k];
            s->finding[k].observed++;
            break;
        }
    o->as_expected = o->finding != NULL ? strcmp(o->finding->outcome, outcome_name(o->kind)) == 0
                                        : outcome_is_good(o->kind);
    const series one = {.formulation = s->formulation[o->formulation]};
    if (!o->as_expected && !sweep_gates(&s->first, &one)) {
        o->as_expected = 1;
        s->is_new++;
    }
}

void extreme_expect(extreme_sweep *s, int whole)
{
    for (int i = 0; i < s->outcomes; i++) {
        set_expected(s, &s->outcome[i]);
        s->unexpected += !s->outcome[i].as_expected;
    }
    if (whole)
        for (int k = 0; k < s->findings; k++)
            s->unobserved += s->finding[k].observed == 0;
    count_cells(s);
}
