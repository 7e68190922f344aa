#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

/* Writes the names of the columns: the varied parameters, then formulation, elements, quantity,
 * unit, value, reference, reference_kind, error, status, cost, seconds, not_modelled. Missing
 * values are empty. */
static void ranges_csv_head(FILE *to, const parameter_ranges *r);
static status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *,
                             fault *f);

static const double batch_cost = 0.5; /* [s] largest estimated cost of a batch */
enum { MOST_POINTS_IN_BATCH = 8192, MOST_BATCHES = 100000000 };

/* Adds a varied parameter. */
static status add_axis(parameter_ranges *r, const char *text, fault *f)
{
    if (r->design.axes == CASE_MAX_PARAMETERS)
        return fault_set(f, STATUS_REFUSED, "more than %d options --vary are given; give fewer",
                         CASE_MAX_PARAMETERS);
    sweep_axis *a = &r->axis[r->design.axes];
    TRY(axis_read(r->request.type, text, a, f));
    r->design.axes++;
    for (int i = 0; i < r->design.axes - 1; i++)
        if (r->axis[i].index == a->index)
            return fault_set(f, STATUS_REFUSED, "--vary %s is given twice; give it once",
                             a->of->name);
    return STATUS_OK;
}

static status read_axes(parameter_ranges *r, fault *f)
{
    char shown[ASSIGNMENT_SHOWN];
    parameters_shown(r->request.type, shown);
    if (r->request.varies == 0)
        return fault_set(f, STATUS_REFUSED,
                         "no parameter varies; give, for example, --vary NAME=1..2/4; 'beamwork "
                         "list %.170s' shows the parameters",
                         shown);
    for (int i = 0; i < r->request.varies; i++)
        TRY(add_axis(r, r->request.vary[i], f));
    const int axes = r->design.axes;
    const status outcome = design_make(r->request.design, axes, r->axis, r->request.points,
                                       r->request.seed, &r->design, f);
    r->design.axes = axes;
    return outcome;
}

static status cut(parameter_ranges *r, fault *f)
{
    const double fits = floor(batch_cost / fmax(r->point_cost, 1e-9));
    const long most =
        r->design.points < MOST_POINTS_IN_BATCH ? r->design.points : MOST_POINTS_IN_BATCH;
    r->points_in_batch = fits < 1 ? 1 : (long)fmin(fits, (double)most);
    const long batches = (r->design.points + r->points_in_batch - 1) / r->points_in_batch;
    if (batches > MOST_BATCHES)
        return fault_set(f, STATUS_REFUSED,
                         "%ld points of about %.2g s each are too many for a sweep; give --vary "
                         "fewer parts or values, or --points a smaller number",
                         r->design.points, r->point_cost);
    r->batches = (int)batches;
    return STATUS_OK;
}

status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->request = *request;
    memcpy(out->base, request->base,
           (size_t)parameters_count(request->type) * sizeof *request->base);
    TRY(read_axes(out, f));
    TRY(survey(out, f));
    return cut(out, f);
}

void ranges_free(parameter_ranges *r)
{
    for (int i = 0; i < r->design.axes; i++)
        axis_free(&r->axis[i]);
    design_free(&r->design);
}

rows_shape ranges_shape(const parameter_ranges *r)
{
    return (rows_shape){r->formulations, r->meshes, r->quantities};
}

static int ranges_batch(const parameter_ranges *r, int batch, long *first)
{
    *first = batch * r->points_in_batch;
    const long left = r->design.points - *first;
    return (int)(left < r->points_in_batch ? left : r->points_in_batch);
}

typedef struct making {
    const parameter_ranges *of;
    const sweep *s;
    rows *out;
} making;

static int quantity_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return i;
    return -1;
}

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
    status outcome =
        at != NULL ? design_points(&r->design, first, count, at, f) : fault_memory(f, "points");
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
                                 ? counted_cost(&one->formulation, &one->cell[k])
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

/* Computes the errors of a formulation with respect to the reference. Finds the smallest number of
 * elements for which this mesh and all finer meshes are within the tolerance. */
static void fill_errors(const making *m, int at, int which, int q, int quantity,
                        const point_reference *against)
{
    const int index = at * m->of->formulations + which;
    const series *one = &m->s->series[index];
    const scene_quantity *scene_value = &m->s->point[at].scene.quantity[quantity];
    const truth row = {.value = against->value};
    const verdict v = {.series = index, .quantity = quantity, .truth = &row};
    for (int k = 0; k < m->of->meshes; k++) {
        const size_t value = rows_value(m->out, at, which, k, q);
        m->out->error[value] = verdict_error(scene_value, m->out->value[value], against->value);
    }
    const int mesh = reach_mesh(m->s, &v, m->of->request.tolerance);
    m->out->least[rows_least(m->out, at, which, q)] = mesh >= 0 ? one->mesh[mesh] : 0;
}

static int is_known(const point_reference *r)
{
    return r->kind != ROWS_NONE && r->kind != ROWS_DISPUTED;
}

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
    m->out->uncertainty[place] = shown.uncertainty;
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

static status ranges_solve(const parameter_ranges *r, int batch, rows *out, fault *f)
{
    sweep s = {.values_only = 1};
    memset(out, 0, sizeof *out);
    const status outcome = solve(r, batch, &s, out, f);
    sweep_free(&s);
    return outcome;
}

static void add_numbers(digest *to, const double value[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        digest_add_number(to, value[i]);
}

static void add_content(digest *to, const rows *w)
{
    const size_t points = (size_t)w->points, known = points * (size_t)w->shape.quantities,
                 cells = points * (size_t)w->shape.formulations * (size_t)w->shape.meshes,
                 values = cells * (size_t)w->shape.quantities,
                 leasts = known * (size_t)w->shape.formulations;
    add_numbers(to, w->reference, known);
    add_numbers(to, w->uncertainty, known);
    add_numbers(to, w->value, values);
    add_numbers(to, w->error, values);
    add_numbers(to, w->cost, cells);
    digest_add(to, w->least, leasts * sizeof *w->least);
    digest_add(to, w->kind, known);
    digest_add(to, w->status, cells);
}

static status run(void *context, int batch, FILE *to, digest *content, fault *f)
{
    const ranges_work *own = context;
    rows w;
    status outcome = ranges_solve(own->of, batch, &w, f);
    if (outcome == STATUS_OK && rows_write(to, &w) != 0)
        outcome = fault_memory(f, "the results of batch %d", batch + 1);
    if (outcome == STATUS_OK)
        add_content(content, &w);
    rows_free(&w);
    return outcome;
}

static status keep(ranges_work *own, int batch, FILE *from, rows *w, fault *f)
{
    long first;
    const rows_shape shape = ranges_shape(own->of);
    const int points = ranges_batch(own->of, batch, &first);
    TRY(rows_alloc(&shape, points, w, f));
    if (rows_read(from, w) != 0)
        return fault_set(f, STATUS_FAULT,
                         "the results of batch %d cannot be read; start the sweep again, which "
                         "computes missing batches",
                         batch + 1);
    add_content(&own->content, w);
    if (own->tally != NULL)
        TRY(tally_add(own->tally, first, w, f));
    if (own->csv != NULL && !own->csv_begun)
        ranges_csv_head(own->csv, own->of);
    own->csv_begun = 1;
    if (own->csv != NULL)
        TRY(ranges_csv_add(own->csv, own->of, first, w, f));
    return own->file != NULL ? ranges_file_add(own->file, first, w, f) : STATUS_OK;
}

static status take(void *context, int batch, FILE *from, fault *f)
{
    rows w = {.first = NULL};
    const status outcome = keep(context, batch, from, &w, f);
    rows_free(&w);
    return outcome;
}

status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f)
{
    *out = (ranges_work){.of = r, .content = digest_begin()};
    out->cost = calloc((size_t)r->batches + 1, sizeof *out->cost);
    if (out->cost == NULL)
        return fault_memory(f, "batches");
    for (int i = 0; i < r->batches; i++) {
        long first;
        out->cost[i] = ranges_batch(r, i, &first) * r->point_cost;
    }
    return STATUS_OK;
}

void ranges_work_free(ranges_work *w)
{
    free(w->cost);
    w->cost = NULL;
}

shard_work ranges_work_of(ranges_work *w)
{
    return (shard_work){.verb = "sweep",
                        .batches = w->of->batches,
                        .cost = w->cost,
                        .context = w,
                        .run = run,
                        .take = take};
}

static void ranges_csv_head(FILE *to, const parameter_ranges *r)
{
    for (int i = 0; i < r->design.axes; i++)
        fprintf(to, "%s,", r->axis[i].of->name);
    fprintf(to, "formulation,elements,quantity,unit,value,reference,reference_kind,error,status,"
                "cost,seconds,not_modelled\n");
}

static void put(FILE *to, double value)
{
    if (isfinite(value))
        fprintf(to, "%.17g", value);
    fputc(',', to);
}

static void put_cell(FILE *to, const parameter_ranges *r, const rows *w, const char *where, int at,
                     int which, int mesh)
{
    const size_t cell = rows_cell(w, at, which, mesh);
    char lacks[OMIT_WORDS];
    missing_omit_words((unsigned)w->lacks[rows_lacks(w, at, which)], lacks);
    for (int q = 0; q < r->quantities; q++) {
        const size_t value = rows_value(w, at, which, mesh, q), known = rows_quantity(w, at, q);
        fprintf(to, "%s\"%s\",%d,%s,%s,", where, r->formulation[which].key, r->mesh[mesh],
                r->quantity[q].name, r->quantity[q].unit);
        put(to, w->value[value]);
        put(to, w->reference[known]);
        fprintf(to, "%s,", rows_reference_name(w->kind[known]));
        put(to, w->error[value]);
        fprintf(to, "%s,", rows_status_name(w->status[cell]));
        put(to, w->cost[cell]);
        put(to, w->seconds[cell]);
        fprintf(to, lacks[0] != '\0' ? "\"%s\"\n" : "%s\n", lacks);
    }
}

static void put_point(FILE *to, const parameter_ranges *r, const rows *w, const double value[],
                      int at)
{
    char where[CASE_MAX_PARAMETERS * (ASSIGNMENT_VALUE + 1) + 1];
    int used = 0;
    where[0] = '\0';
    for (int i = 0; i < r->design.axes; i++) {
        axis_text(&r->axis[i], value[i], where + used, ASSIGNMENT_VALUE);
        while (where[used] != '\0')
            used++;
        where[used++] = ',';
        where[used] = '\0';
    }
    for (int i = 0; i < r->formulations; i++)
        for (int k = 0; k < r->meshes; k++)
            put_cell(to, r, w, where, at, i, k);
}

static status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *w,
                             fault *f)
{
    const int axes = r->design.axes;
    double *at = malloc((size_t)w->points * (size_t)axes * sizeof *at);
    const status outcome =
        at != NULL ? design_points(&r->design, first, w->points, at, f) : fault_memory(f, "points");
    for (int i = 0; i < w->points && outcome == STATUS_OK; i++)
        put_point(to, r, w, at + (size_t)i * (size_t)axes, i);
    free(at);
    return outcome;
}

static void add_count(digest *plan, long count)
{
    digest_add_number(plan, (double)count);
}

static void identity_add_axis(digest *plan, const sweep_axis *a)
{
    digest_add_text(plan, a->of->name);
    add_count(plan, a->kind);
    add_count(plan, a->count);
    digest_add_number(plan, a->from);
    digest_add_number(plan, a->to);
    for (int i = 0; a->value != NULL && i < a->count; i++)
        digest_add_number(plan, a->value[i]);
}

void ranges_identity_add(const parameter_ranges *r, digest *plan)
{
    digest_add_text(plan, r->request.type->name);
    for (int i = 0; i < parameters_count(r->request.type); i++)
        digest_add_number(plan, r->base[i]);
    add_count(plan, r->design.axes);
    for (int i = 0; i < r->design.axes; i++)
        identity_add_axis(plan, &r->axis[i]);
    digest_add_text(plan, design_name(r->design.kind));
    add_count(plan, r->design.points);
    add_count(plan, (long)r->design.seed);
    add_count(plan, r->formulations);
    for (int i = 0; i < r->formulations; i++)
        digest_add_text(plan, r->formulation[i].key);
    add_count(plan, r->meshes);
    for (int i = 0; i < r->meshes; i++)
        add_count(plan, r->mesh[i]);
    for (int i = 0; i < r->quantities; i++)
        digest_add_text(plan, r->quantity[i].name);
    digest_add_number(plan, r->request.tolerance);
    add_count(plan, r->request.time_limit);
    add_count(plan, r->request.derive != NULL);
    add_count(plan, r->points_in_batch);
}
