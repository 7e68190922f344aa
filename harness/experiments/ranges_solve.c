#include "harness/experiments/ranges_solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/known.h"
#include "harness/experiments/ranges_points.h"
#include "harness/experiments/reference.h"
#include "harness/study/study.h"

/* A batch that is being made. */
typedef struct making {
    const parameter_ranges *of;
    const sweep *s;
    rows *out;
} making;

/* Index of a quantity in the scene, or -1. */
static int quantity_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return i;
    return -1;
}

/* What nobody asked for is not computed. */
static void drop_quantities(const parameter_ranges *r, scene *s)
{
    int kept = 0;
    for (int i = 0; i < s->quantities; i++) {
        int wanted = 0;
        for (int k = 0; k < r->quantities && !wanted; k++)
            wanted = s->quantity[i].reduction != SCENE_CURVE &&
                     strcmp(s->quantity[i].name, r->quantity[k].name) == 0;
        if (wanted)
            s->quantity[kept++] = s->quantity[i];
    }
    s->quantities = kept;
}

static status plan(const parameter_ranges *r, int batch, sweep *s, fault *f)
{
    long first;
    const int count = ranges_batch(r, batch, &first), axes = r->design.axes;
    double *at = malloc((size_t)count * (size_t)axes * sizeof *at), value[CASE_MAX_PARAMETERS];
    status outcome = at != NULL ? design_points(&r->design, first, count, at, f)
                                : fault_set(f, STATUS_FAULT, "out of memory for points");
    for (int i = 0; i < count && outcome == STATUS_OK; i++) {
        ranges_points_values(r, at + (size_t)i * (size_t)axes, value);
        outcome = plan_add(s, r->request.type, value, NULL, r->mesh, r->meshes, f);
        if (outcome != STATUS_OK)
            break;
        drop_quantities(r, &s->point[i].scene);
        outcome = plan_extend(s, r->formulation, r->formulations, f);
    }
    free(at);
    return outcome;
}

static int status_of(const sweep_point *p, const series *one, int mesh)
{
    if (p->status != STATUS_OK)
        return ROWS_NO_SCENE;
    return one->missing[0] != '\0' ? ROWS_NOT_OFFERED : (int)one->cell[mesh].solve.status;
}

static double value_of(const series *one, int mesh, int quantity)
{
    const solve_result *r = &one->cell[mesh].solve;
    const int is_there =
        quantity >= 0 && quantity < r->quantities && r->quantity[quantity].status == STATUS_OK;
    return is_there ? r->quantity[quantity].value : NAN;
}

/* Cells of one formulation at one point. */
static void fill_cells(const making *m, int at, int which)
{
    const series *one = &m->s->series[at * m->of->formulations + which];
    const sweep_point *p = &m->s->point[at];
    m->out->lacks[rows_lacks(m->out, at, which)] =
        one->without.other ? (int32_t)one->without.what : 0;
    for (int k = 0; k < m->of->meshes; k++) {
        const size_t cell = rows_cell(m->out, at, which, k);
        const int ran = p->status == STATUS_OK && one->missing[0] == '\0';
        m->out->status[cell] = (uint8_t)status_of(p, one, k);
        m->out->cost[cell] = ran && reach_unranked(one->formulation.type)[0] == '\0'
                                 ? price_cost(&one->formulation, &one->cell[k])
                                 : NAN;
        m->out->seconds[cell] =
            ran ? one->cell[k].solve.seconds_setup + one->cell[k].solve.seconds_solve : NAN;
        for (int q = 0; q < m->of->quantities; q++) {
            const size_t value = rows_value(m->out, at, which, k, q);
            m->out->value[value] =
                ran ? value_of(one, k, quantity_of(&p->scene, m->of->quantity[q].name)) : NAN;
            m->out->error[value] = NAN;
        }
    }
}

/* Errors of one formulation against its reference, and the least mesh. */
static void fill_errors(const making *m, int at, int which, int q, int quantity,
                        const point_reference *against)
{
    const int index = at * m->of->formulations + which;
    const series *one = &m->s->series[index];
    const scene_quantity *wants = &m->s->point[at].scene.quantity[quantity];
    const truth row = {.value = against->value};
    const verdict v = {.series = index, .quantity = quantity, .truth = &row};
    for (int k = 0; k < m->of->meshes; k++) {
        const size_t value = rows_value(m->out, at, which, k, q);
        m->out->error[value] = verdict_error(wants, m->out->value[value], against->value);
    }
    const int mesh = reach_mesh(m->s, &v, m->of->request.tolerance);
    m->out->least[rows_least(m->out, at, which, q)] = mesh >= 0 ? one->mesh[mesh] : 0;
}

static int is_known(const point_reference *r)
{
    return r->kind != ROWS_NONE && r->kind != ROWS_DISPUTED;
}

/* One quantity at one point: what stands as its reference is that of the first formulation that has
 * one. */
static void fill_quantity(const making *m, int at, int q, const known_truths *k)
{
    const sweep_point *p = &m->s->point[at];
    const int quantity =
        p->status == STATUS_OK ? quantity_of(&p->scene, m->of->quantity[q].name) : -1;
    const size_t place = rows_quantity(m->out, at, q);
    point_reference shown = {ROWS_NONE, NAN, NAN};
    for (int i = 0; i < m->of->formulations && quantity >= 0; i++) {
        const int index = at * m->of->formulations + i;
        if (m->s->series[index].missing[0] != '\0')
            continue;
        const point_reference one =
            reference_of(m->s, index, quantity, &k->stored, &k->derived, m->of->request.tolerance);
        if (is_known(&one))
            fill_errors(m, at, i, q, quantity, &one);
        if (!is_known(&shown) && (is_known(&one) || one.kind == ROWS_DISPUTED))
            shown = one;
    }
    m->out->reference[place] = shown.value;
    m->out->doubt[place] = shown.doubt;
    m->out->kind[place] = (uint8_t)shown.kind;
}

static status fill_point(const making *m, int at, fault *f)
{
    const sweep_point *p = &m->s->point[at];
    known_truths k = {.borrowed = 0};
    for (int i = 0; i < m->of->formulations; i++)
        fill_cells(m, at, i);
    if (p->status == STATUS_OK)
        TRY(known_at(m->of, p, &k, f));
    for (int q = 0; q < m->of->quantities; q++)
        fill_quantity(m, at, q, &k);
    known_free(&k);
    return STATUS_OK;
}

static status solve(const parameter_ranges *r, int batch, sweep *s, rows *out, fault *f)
{
    const sweep_request request = {.jobs = 1, .together = 1, .time_limit = r->request.time_limit};
    const making m = {r, s, out};
    const rows_shape shape = ranges_shape(r);
    TRY(plan(r, batch, s, f));
    TRY(rows_alloc(&shape, s->points, out, f));
    if (sweep_cells(s) > 0)
        TRY(run_sweep(&request, s, f));
    for (int i = 0; i < s->points; i++)
        TRY(fill_point(&m, i, f));
    return STATUS_OK;
}

status ranges_solve(const parameter_ranges *r, int batch, rows *out, fault *f)
{
    sweep s = {.values_only = 1};
    memset(out, 0, sizeof *out);
    const status outcome = solve(r, batch, &s, out, f);
    sweep_free(&s);
    return outcome;
}
