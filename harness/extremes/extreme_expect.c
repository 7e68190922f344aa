/* What a sweep of extremes is expected to show, what it counts to, and its exit code. */
#include <fnmatch.h>
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>

#include "harness/extremes/extreme_sweep.h"
#include "harness/truth/columns.h"

status extreme_expect_read(const char *path, extreme_sweep *out, fault *f)
{
    static const columns_field field[] = {{"extreme", 1, offsetof(extreme_finding, extreme)},
                                          {"formulation", 1, offsetof(extreme_finding, formulation)},
                                          {"quantity", 1, offsetof(extreme_finding, quantity)},
                                          {"outcome", 1, offsetof(extreme_finding, outcome)},
                                          {"proof", 1, offsetof(extreme_finding, proof)},
                                          {"from", 0, offsetof(extreme_finding, from)},
                                          {"to", 0, offsetof(extreme_finding, to)}};
    columns r = {.path = path, .name = "extreme_findings", .f = f};
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    r.group = file >= 0 ? H5Gopen2(file, r.name, H5P_DEFAULT) : -1;
    r.rows = r.group >= 0 ? columns_length(r.group, "outcome") : -1;
    status outcome = r.rows >= 0 ? STATUS_OK : columns_broken(&r, "outcome");
    if (outcome == STATUS_OK) {
        out->finding = calloc((size_t)r.rows + 1, sizeof *out->finding);
        out->findings = out->finding != NULL ? r.rows : 0;
        outcome = out->finding != NULL ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory for findings");
    }
    for (size_t i = 0; i < sizeof field / sizeof field[0] && outcome == STATUS_OK; i++)
        outcome = columns_read(&r, &field[i], out->finding, sizeof *out->finding);
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
    return o->x >= row->from * (1 - slack) && o->x <= row->to * (1 + slack) && fnmatch(row->extreme, e->name, 0) == 0 &&
           fnmatch(row->formulation, s->formulation[o->formulation].key, 0) == 0 &&
           fnmatch(row->quantity, e->quantity[o->quantity].name, 0) == 0;
}

static int is_good(outcome_kind kind)
{
    return kind == OUTCOME_VALUE || kind == OUTCOME_COARSE;
}

/* From the best of a cell to the worst. */
static int badness(outcome_kind kind)
{
    static const int rank[OUTCOME_KINDS] = {
        [OUTCOME_VALUE] = 1,    [OUTCOME_COARSE] = 2,   [OUTCOME_REFUSED] = 3, [OUTCOME_NOT_CONVERGED] = 3,
        [OUTCOME_SINGULAR] = 3, [OUTCOME_NO_VALUE] = 3, [OUTCOME_WRONG] = 4,   [OUTCOME_FAULT] = 5};
    return rank[kind];
}

/* Outcomes of one cell follow each other. */
static void count_cells(extreme_sweep *s)
{
    for (int i = 0; i < s->outcomes;) {
        extreme_count *c = &s->count[s->outcome[i].formulation];
        outcome_kind worst = s->outcome[i].kind;
        const int cell = s->outcome[i].series;
        for (; i < s->outcomes && s->outcome[i].series == cell; i++)
            worst = badness(s->outcome[i].kind) > badness(worst) ? s->outcome[i].kind : worst;
        c->tried += worst != OUTCOME_SKIP;
        c->survived += is_good(worst);
        c->coarse += worst == OUTCOME_COARSE;
        c->named += badness(worst) == 3;
        c->wrong += worst == OUTCOME_WRONG;
        c->faults += worst == OUTCOME_FAULT;
    }
}

void extreme_expect(extreme_sweep *s, int whole)
{
    for (int i = 0; i < s->outcomes; i++) {
        extreme_outcome *o = &s->outcome[i];
        o->finding = NULL;
        for (int k = 0; k < s->findings && o->finding == NULL && o->kind != OUTCOME_SKIP; k++)
            if (speaks_of(&s->finding[k], s, o)) {
                o->finding = &s->finding[k];
                s->finding[k].observed++;
            }
        o->as_expected = o->kind == OUTCOME_SKIP ||
                         (o->finding != NULL ? strcmp(o->finding->outcome, outcome_name(o->kind)) == 0 : is_good(o->kind));
        s->unexpected += !o->as_expected;
    }
    for (int k = 0; k < s->findings && whole; k++)
        s->unobserved += s->finding[k].observed == 0;
    count_cells(s);
}

int extreme_sweep_exit(const extreme_sweep *s)
{
    int tried = 0;
    for (int i = 0; i < s->formulations; i++)
        tried += s->count[i].tried;
    return tried == 0 ? 3 : s->unexpected > 0 || s->unobserved > 0 ? 1 : 0;
}

void extreme_sweep_free(extreme_sweep *s)
{
    for (int i = 0; i < s->findings; i++) {
        extreme_finding *r = &s->finding[i];
        char *const all[] = {r->extreme, r->formulation, r->quantity, r->outcome, r->proof};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    sweep_free(&s->first);
    sweep_free(&s->neighbours);
    free(s->finding);
    free(s->formulation);
    free(s->outcome);
    free(s->count);
    memset(s, 0, sizeof *s);
}
