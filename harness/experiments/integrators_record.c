#include "harness/experiments/experiments_impl.h"

#include <string.h>

static const char *word_of_class(int motion_class)
{
    return integrators_class_name((integrators_class)motion_class);
}

static const char *word_of_order(int kind)
{
    return integrators_order_name((integrators_order_kind)kind);
}

static const integrators *integrators_of(const subject *s)
{
    return s->owner;
}

static void get_wanted(const subject *s, field_value *out)
{
    out->whole =
        integrators_of(s)->group[((const integrators_run *)s->record)->group].reference >= 0;
}

static const schema_field fields_of_run[] = {
    {"integrator", "", FIELD_TEXT, "integrator, with its parameter if it has one",
     AT(integrators_run, method.name), .key = KEY},
    {"step", "s", FIELD_DOUBLE, "time step; initial time step if a tolerance is given",
     AT(integrators_run, step), .key = KEY},
    {"tolerance", "1", FIELD_DOUBLE, "tolerance for the error of a step; 0: equal steps",
     AT(integrators_run, tolerance), .key = KEY},
    {"status", "", FIELD_ENUM, "status of the motion", AT(integrators_run, status),
     .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "reason for an early end", TEXT_OF(RECORD, integrators_run, reason)},
    {"stopped", "s", FIELD_DOUBLE, "end time of a motion that ended early",
     AT(integrators_run, stopped)},
    {"error", "1", FIELD_DOUBLE,
     "largest time-integration error at any station: positions relative to the size of the "
     "structure, rotations in rad",
     AT(integrators_run, error)},
    {"order", "1", FIELD_DOUBLE,
     "observed order, from the errors of this run and of the previous one with a longer step",
     AT(integrators_run, order)},
    {"cost", "s", FIELD_DOUBLE, "cost of the counted work, with beamwork's cost coefficients",
     AT(integrators_run, cost)},
    {"seconds", "s", FIELD_DOUBLE, "processor time", AT(integrators_run, seconds)},
    {"steps", "1", FIELD_LONG, "accepted steps", AT(integrators_run, steps)},
    {"rejected", "1", FIELD_LONG, "rejected steps", AT(integrators_run, rejected)},
    {"iterations_per_step", "1", FIELD_DOUBLE, "Newton iterations per step",
     AT(integrators_run, iterations)},
    {"energy_drift", "1", FIELD_DOUBLE,
     "largest relative change of the energy after the last load has ended; if coordinates are "
     "fixed or prescribed, of energy minus work",
     AT(integrators_run, energy)},
    {"momentum_drift", "1", FIELD_DOUBLE,
     "largest relative change of momentum and angular momentum after the last load has ended",
     AT(integrators_run, momentum)},
    {"largest_energy", "1", FIELD_DOUBLE,
     "largest energy, relative to the energy after the last load has ended",
     AT(integrators_run, largest)},
    {"last_energy", "1", FIELD_DOUBLE,
     "final energy, relative to the energy after the last load has ended",
     AT(integrators_run, last)},
    {"outcome", "", FIELD_ENUM,
     "outcome: grows, stops, bounded or exact; empty if loads act until the end",
     AT(integrators_run, motion_class), .word = word_of_class, .words = INTEGRATORS_CLASSES},
    {"has_reference", "", FIELD_FLAG, "0 if only energy and momenta are compared",
     .get = get_wanted},
    {0}};
#define KEYS keys_of_point, keys_of_series, key_of_mesh
const record_type record_integrators_run = {
    "run",
    "runs",
    "a motion computed by one integrator with one step or tolerance",
    {KEYS, fields_of_run}};

/* Returns the error of a quantity of a run. The index of the subject is the index of the
 * quantity. */
static void get_quantity_error(const subject *s, field_value *out)
{
    out->numbers = &((const integrators_run *)s->record)->values[s->index];
}

static const schema_field fields_of_error[] = {
    {"integrator", "", FIELD_TEXT, "integrator of the run", AT(integrators_run, method.name),
     .key = KEY},
    {"step", "s", FIELD_DOUBLE, "step of the run", AT(integrators_run, step), .key = KEY},
    {"tolerance", "1", FIELD_DOUBLE, "tolerance of the run", AT(integrators_run, tolerance),
     .key = KEY},
    {"quantity", "", FIELD_TEXT, "name of the quantity", OF(QUANTITY, scene_quantity, name)},
    {"error", "1", FIELD_DOUBLE, "relative time error", .get = get_quantity_error},
    {0}};
static const record_type record_integrators_error = {
    "error", "errors", "the error of a quantity of a run", {KEYS, fields_of_error}};

static const integrators_group *group_of(const subject *s)
{
    return s->record;
}

static const cell_result *cell_of_reference(const subject *s)
{
    return integrators_cell_of(integrators_of(s), group_of(s)->reference);
}

static void get_reference_steps(const subject *s, field_value *out)
{
    out->whole = cell_of_reference(s)->solve.steps;
}

static void get_reference_status(const subject *s, field_value *out)
{
    out->whole = cell_of_reference(s)->solve.status;
}

static void get_reference_tolerance(const subject *s, field_value *out)
{
    (void)s;
    schema_set_number(out, integrators_reference[0]);
}

static void get_reference_integrator(const subject *s, field_value *out)
{
    (void)s;
    schema_set_text(out, "radau");
}

static const schema_field fields_of_reference[] = {
    {"integrator", "", FIELD_TEXT, "integrator of the reference solution",
     .get = get_reference_integrator},
    {"tolerance", "1", FIELD_DOUBLE, "tolerance for the error of a step",
     .get = get_reference_tolerance},
    {"steps", "1", FIELD_INT, "accepted steps", .get = get_reference_steps},
    {"status", "", FIELD_ENUM, "status of the motion", .get = get_reference_status,
     .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "reason for a missing reference", AT(integrators_group, reason)},
    {"uncertainty", "1", FIELD_DOUBLE, "bound of the uncertainty of the reference solution",
     AT(integrators_group, uncertainty)},
    {"order", "1", FIELD_DOUBLE,
     "observed order of the reference solution, from the steps and errors of its checks",
     AT(integrators_group, order)},
    {"end", "s", FIELD_DOUBLE, "end time of the motion", AT(integrators_group, end)},
    {"alone_from", "s", FIELD_DOUBLE,
     "time after which no load acts; infinite if loads act until the end",
     AT(integrators_group, from)},
    {0}};
static const record_type record_integrators_reference = {
    "reference", "references", "reference solutions for time errors", {KEYS, fields_of_reference}};

static void get_integrator(const subject *s, field_value *out)
{
    schema_set_text(out, ((const integrators_ladder *)s->record)->method->name);
}

static void get_nominal(const subject *s, field_value *out)
{
    schema_set_number(out, ((const integrators_ladder *)s->record)->method->order);
}

static void get_standing(const subject *s, field_value *out)
{
    size_t used = 0;
    out->room[0] = '\0';
    for (int q = 0; q < s->point->scene.quantities; q++)
        if (integrators_order_stagnates(integrators_of(s), s->record, q) && used < sizeof out->room)
            used += (size_t)snprintf(out->room + used, sizeof out->room - used, "%s%s",
                                     used > 0 ? " " : "", s->point->scene.quantity[q].name);
    out->text = out->room;
}

static const schema_field fields_of_ladder[] = {
    {"integrator", "", FIELD_TEXT, "integrator, with its parameter if it has one",
     .get = get_integrator, .key = KEY},
    {"nominal", "1", FIELD_DOUBLE, "nominal order of the integrator", .get = get_nominal},
    {"order", "1", FIELD_DOUBLE, "order from the last two errors above the error floor",
     AT(integrators_ladder, order)},
    {"order_before", "1", FIELD_DOUBLE, "order from the preceding two errors",
     AT(integrators_ladder, before)},
    {"floor", "1", FIELD_DOUBLE, "error floor due to the reference solution and rounding",
     AT(integrators_ladder, floor)},
    {"verdict", "", FIELD_ENUM, "verdict on the order", AT(integrators_ladder, kind),
     .word = word_of_order, .words = INTEGRATORS_ORDER_KINDS},
    {"not_converging", "", FIELD_TEXT, "quantities whose errors do not fall with the step",
     .get = get_standing},
    {0}};
static const record_type record_integrators_ladder = {
    "order", "orders", "an integrator with successively halved steps", {KEYS, fields_of_ladder}};

typedef struct record_reached {
    double error;
    const char *integrator;
    integrators_reach way;
} record_reached;

static void get_reached_step(const subject *s, field_value *out)
{
    out->numbers = &((const record_reached *)s->record)->way.run->step;
}

static void get_reached_tolerance(const subject *s, field_value *out)
{
    out->numbers = &((const record_reached *)s->record)->way.run->tolerance;
}

static const schema_field fields_of_reached[] = {
    {"error", "1", FIELD_DOUBLE, "time error", AT(record_reached, error)},
    {"integrator", "", FIELD_TEXT, "integrator that achieves the error",
     TEXT_OF(RECORD, record_reached, integrator)},
    {"cost", "s", FIELD_DOUBLE, "cost of the counted work at this error",
     AT(record_reached, way.cost)},
    {"step", "s", FIELD_DOUBLE, "step of the run that achieves the error", .get = get_reached_step},
    {"tolerance", "1", FIELD_DOUBLE, "tolerance of that run", .get = get_reached_tolerance},
    {0}};
static const record_type record_integrators_reached = {
    "reached", "reached", "lowest cost for an error", {KEYS, fields_of_reached}};

static const schema_field fields_of_verdict[] = {
    {"judged", "", FIELD_TEXT,
     "property with a verdict: order, energy, momentum, tolerance or fate",
     TEXT_OF(RECORD, integrators_verdict, criterion)},
    {"case", "", FIELD_TEXT, "name of the case", TEXT_OF(RECORD, integrators_verdict, case_name)},
    {"parameters", "", FIELD_TEXT, "parameters that differ from the defaults",
     TEXT_OF(RECORD, integrators_verdict, parameters)},
    {"formulation", "", FIELD_TEXT,
     "name of the formulation, with options that differ from their defaults",
     TEXT_OF(RECORD, integrators_verdict, formulation)},
    {"elements", "1", FIELD_INT, "elements of each member", AT(integrators_verdict, elements)},
    {"integrator", "", FIELD_TEXT, "integrator, with its parameter if it has one",
     TEXT_OF(RECORD, integrators_verdict, integrator)},
    {"steps", "", FIELD_TEXT, "steps or tolerances, as in the table of expected verdicts",
     TEXT_OF(RECORD, integrators_verdict, steps)},
    {"verdict", "", FIELD_TEXT, "observed verdict", AT(integrators_verdict, found)},
    {"expected", "", FIELD_TEXT, "verdict that the table expects",
     TEXT_OF(RECORD, integrators_verdict, expected)},
    {"as_expected", "", FIELD_FLAG, "true if the observed and the expected verdict agree",
     AT(integrators_verdict, as_expected)},
    {"why", "", FIELD_TEXT, "reason for the expectation",
     TEXT_OF(RECORD, integrators_verdict, why)},
    {0}};
static const record_type record_integrators_verdict = {
    "verdict",
    "verdicts",
    "an integrator's verdict, compared with the table of expected verdicts",
    {fields_of_verdict}};

static void get_growth(const subject *s, field_value *out)
{
    (void)s;
    schema_set_number(out, integrators_growth);
}

static void get_energy(const subject *s, field_value *out)
{
    (void)s;
    schema_set_number(out, integrators_energy);
}

static void get_momentum(const subject *s, field_value *out)
{
    (void)s;
    schema_set_number(out, integrators_momentum);
}

static const schema_field fields_of_all[] = {
    {"growth", "1", FIELD_DOUBLE,
     "relative increase of the energy above which the outcome is 'grows'", .get = get_growth},
    {"exact_energy", "1", FIELD_DOUBLE, "relative change up to which the energy counts as exact",
     .get = get_energy},
    {"exact_momentum", "1", FIELD_DOUBLE,
     "relative change up to which the momentum counts as exact", .get = get_momentum},
    {"unexpected", "1", FIELD_INT, "verdicts that the table does not expect",
     AT(motions, verdicts.unexpected)},
    {0}};
const record_type record_integrators_all = {"motion", "", "of the run", {fields_of_all}};

static subject subject_of(const integrators *p, int run, const void *record)
{
    const integrators_run *r = &p->run[run];
    return (subject){.sweep = &p->sweep,
                     .point = integrators_point_of(p, r),
                     .series = &p->sweep.series[r->series],
                     .record = record,
                     .owner = p};
}

static void gather_run(const integrators *p, int run, subjects *out)
{
    const subject one = subject_of(p, run, &p->run[run]);
    gather_add(out, &one);
}

static void gather_errors(const integrators *p, int run, subjects *out)
{
    subject one = subject_of(p, run, &p->run[run]);
    if (p->group[p->run[run].group].reference < 0 || p->run[run].values == NULL)
        return;
    for (; one.index < one.point->scene.quantities; one.index++)
        gather_add(out, &one);
}

static void gather_ladders(const integrators *p, const integrators_group *g, subjects *out)
{
    for (int i = g->first; i < g->first + g->runs;) {
        const integrators_ladder ladder = integrators_order_of(p, i);
        const subject one = subject_of(p, i, gather_keep(out, &ladder, sizeof ladder));
        if (ladder.count > 1 && one.record != NULL)
            gather_add(out, &one);
        i += ladder.count;
    }
}

static void gather_reached(const integrators *p, const integrators_group *g, subjects *out)
{
    const char *name[INTEGRATORS_METHODS_MOST];
    const int count = integrators_reach_methods(p, name);
    for (int l = 0; l < INTEGRATORS_LEVELS; l++)
        for (int i = 0; i < count; i++) {
            const record_reached row = {
                integrators_levels[l], name[i],
                integrators_reach_of(p, (int)(g - p->group), name[i], integrators_levels[l])};
            const void *kept = row.way.run != NULL ? gather_keep(out, &row, sizeof row) : NULL;
            const subject one = subject_of(p, g->first, kept);
            if (kept != NULL)
                gather_add(out, &one);
        }
}

static void gather_group(const integrators *p, const integrators_group *g, const record_type *type,
                         subjects *out)
{
    for (int i = g->first; i < g->first + g->runs; i++)
        if (type == &record_integrators_run)
            gather_run(p, i, out);
        else if (type == &record_integrators_error)
            gather_errors(p, i, out);
    if (g->reference < 0 || g->runs == 0)
        return;
    const subject one = subject_of(p, g->first, g);
    if (type == &record_integrators_reference)
        gather_add(out, &one);
    else if (type == &record_integrators_ladder)
        gather_ladders(p, g, out);
    else if (type == &record_integrators_reached)
        gather_reached(p, g, out);
}

static void integrators_gather(const void *found, const record_type *type, subjects *out)
{
    const motions *m = found;
    if (type == &record_integrators_all)
        gather_add(out, &(subject){.record = m});
    for (int i = 0; type == &record_integrators_verdict && i < m->verdicts.count; i++)
        gather_add(out, &(subject){.record = &m->verdicts.verdict[i]});
    for (int i = 0; i < m->integrators.groups; i++)
        gather_group(&m->integrators, &m->integrators.group[i], type, out);
}

const record_type *const integrators_records[] = {&record_integrators_reference,
                                                  &record_integrators_run,
                                                  &record_integrators_error,
                                                  &record_integrators_ladder,
                                                  &record_integrators_reached,
                                                  &record_integrators_verdict,
                                                  NULL};

static status plan_point(const motion_request *r, motions *m, integrators_plan_request *q, fault *f)
{
    TRY(integrators_plan_default(q, f));
    for (int i = 0; i < r->formulations; i++) {
        q->formulation = r->formulation[i];
        TRY(integrators_plan_add(&m->integrators, q, f));
    }
    return STATUS_OK;
}

static status plan_axis(const motion_request *r, motions *m, const integrators_plan_request *q,
                        const sweep_axis *a, fault *f)
{
    double value[CASE_MAX_PARAMETERS];
    if (a->count == 0)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: the number of parts is missing; write a range such as "
                         "%s=1..2/4, or values such as %s=1,2,4",
                         a->of->name, a->of->name, a->of->name);
    memcpy(value, r->parameter, sizeof value);
    for (int i = 0; i < a->count; i++) {
        integrators_plan_request one = *q;
        one.parameter = value;
        value[a->index] = axis_value(a, i);
        TRY(plan_point(r, m, &one, f));
    }
    return STATUS_OK;
}

static status plan_points(const motion_request *r, motions *m, integrators_plan_request *q,
                          fault *f)
{
    sweep_axis a;
    if (r->vary == NULL)
        return plan_point(r, m, q, f);
    TRY(axis_read(r->type, r->vary, &a, f));
    const status outcome = plan_axis(r, m, q, &a, f);
    axis_free(&a);
    return outcome;
}

static status plan_motions(const motion_request *r, motions *m, fault *f)
{
    integrators_plan_request q = {.type = r->type,
                                  .parameter = r->parameter,
                                  .elements = r->elements,
                                  .method = m->method,
                                  .errors = !r->conservation_only,
                                  .whole = r->conservation_only};
    TRY(integrators_method_read_list(r->integrators != NULL ? r->integrators
                                                            : integrators_method_all,
                                     INTEGRATORS_LIST_MOST, m->method, &m->methods, f));
    q.methods = m->methods;
    if (r->steps != NULL)
        TRY(integrators_list_read("step", r->steps, 2, &q.steps, f));
    if (r->tolerances != NULL)
        TRY(integrators_list_read("tolerance", r->tolerances, 100, &q.tolerances, f));
    return plan_points(r, m, &q, f);
}

static status plan(const void *requested, void *found, fault *f)
{
    const motion_request *r = requested;
    motions *m = found;
    m->each = r->each;
    return r->expected != NULL
               ? integrators_verdict_plan(r->expected, &m->integrators, &m->verdicts, f)
               : plan_motions(r, m, f);
}

static status run(const void *requested, void *found, fault *f)
{
    const motion_request *r = requested;
    motions *m = found;
    return integrators_evaluate(&m->integrators, &r->cells, f);
}

static status evaluate(const void *requested, void *found, fault *f)
{
    motions *m = found;
    (void)requested;
    (void)f;
    integrators_verdict_reach(&m->integrators, &m->verdicts);
    return STATUS_OK;
}

static void print(FILE *to, const void *found)
{
    const motions *m = found;
    integrators_table(to, &m->integrators, &m->verdicts, m->each);
}

void motions_free(motions *m)
{
    integrators_verdict_free(&m->verdicts);
    integrators_free(&m->integrators);
}

const experiment_type experiment_motion = {.name = "motion",
                                           .plan = plan,
                                           .run = run,
                                           .evaluate = evaluate,
                                           .records = integrators_records,
                                           .about = &record_integrators_all,
                                           .rows = &record_integrators_run,
                                           .gather = integrators_gather,
                                           .print = print};
