#include "harness/experiments/experiments_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/import_export/import_export.h"
#include "harness/model/model.h"

static cell_request cell_of(const solution_request *r, const scene *s)
{
    cell_request out = {
        .scene = s, .elements = r->elements, .keep_all = r->keep_all, .threads = r->threads};
    if (r->formulation.type != NULL)
        cell_formulation(&out, &r->formulation);
    out.solve.steps_between = r->steps;
    return out;
}

void solution_choice_free(solution_choice *why)
{
    free(why->change);
    why->change = NULL;
}

static void take(solution_request *r, default_choice *p, solution_choice *why)
{
    r->formulation = p->chosen;
    r->elements = p->elements;
    memcpy(why->formulation, p->why_formulation, sizeof why->formulation);
    memcpy(why->elements, p->why_elements, sizeof why->elements);
    why->short_of = p->short_of;
    why->change = p->change;
    p->change = NULL;
}

static status choose(solution_request *r, const rule *rules, int count, int elements, scene *s,
                     solution_choice *why, fault *f)
{
    const double requested = r->error > 0 ? r->error : DEFAULT_CHOICE_ERROR;
    TRY(cell_scene(r->type, r->parameter, NULL, s, f));
    TRY(narrow_scene(s, r->type, r->parameter, &r->formulation, r->select, f));
    if (r->systems)
        scene_demand(s, FEATURE_MASS);
    const rule_subject where = {
        .type = r->type, .parameter = r->parameter, .features = features_needed(s)};
    const cell_request cell = cell_of(r, s);
    default_choice found;
    if (r->formulation.type == NULL && !(elements && r->elements == 0))
        return default_choice_formulation(s, &where, rules, count, &r->formulation,
                                          why->formulation, f);
    if (r->formulation.type == NULL)
        TRY(default_choice_both(&cell, &where, rules, count, requested, &found, f));
    else
        TRY(default_choice_elements(&cell, &r->formulation, requested, &found, f));
    take(r, &found, why);
    return STATUS_OK;
}

status solution_choose(solution_request *r, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f)
{
    scene s = {0};
    *why = (solution_choice){.formulation = ""};
    if (r->formulation.type != NULL && (!elements || r->elements > 0))
        return STATUS_OK;
    const status outcome = choose(r, rules, count, elements, &s, why, f);
    scene_free(&s);
    return outcome;
}

status solution_plan(const solution_request *r, sweep *s, fault *f)
{
    TRY(plan_one(r->type, r->parameter, &r->formulation, 1, &r->elements, 1, s, f));
    TRY(narrow_to(s, r->select, f));
    if (r->systems)
        scene_demand(&s->point[0].scene, FEATURE_MASS);
    return STATUS_OK;
}

static status report_change(const solution_request *r, const solution_choice *why,
                            solve_result *out, fault *f)
{
    const double requested = r->error > 0 ? r->error : DEFAULT_CHOICE_ERROR;
    for (int i = 0; i < out->quantities && why->change != NULL; i++)
        out->quantity[i].change = why->change[i];
    if (!why->short_of || out->status != STATUS_OK)
        return out->status;
    out->status = STATUS_NOT_CONVERGED;
    snprintf(out->reason, sizeof out->reason,
             "no convergence on %.200s; %.3g %% was requested; use more elements, such as -n %d, "
             "or a larger --error",
             why->elements, 100 * requested, 2 * r->elements);
    return fault_set(f, STATUS_NOT_CONVERGED, "%s", out->reason);
}

status solution_run(const solution_request *r, const solution_choice *why, sweep *s, fault *f)
{
    cell_request request = cell_of(r, &s->point[0].scene);
    cell_result *out = &s->series[0].cell[0];
    request.solve.shapes = r->shapes;
    request.solve.systems = r->systems;
    request.solve.reduce = r->reduce;
    request.solve.keep_ends = r->keep_ends;
    request.solve.all_analyses = r->shapes > 0 || r->systems || r->keep_ends;
    request.solve.checks_flutter = !r->skips_stability;
    request.solve.restarts = r->restarts;
    request.solve.restart = r->restart;
    TRY(cell_run(&request, out, f));
    return report_change(r, why, &out->solve, f);
}

enum { MOST = 64 };

static double scale_of(const scene_quantity *q, double value)
{
    const double scale = fmax(fabs(value), q->near_zero);
    return scale > 0 ? scale : 1;
}

static point_reference of_truth(const scene_quantity *q, const truth *t, rows_reference kind)
{
    return (point_reference){kind, t->value, t->uncertainty / scale_of(q, t->value)};
}

/* Returns 1 if the limit of series b may be a reference for series a: b must solve the scene of a
 * with all its physics and, unless a solves another model, with the shear theory of a. */
static int same_physics(const sweep *s, int a, int b)
{
    const series *one = &s->series[a], *other = &s->series[b];
    const scene *here = &s->point[one->point].scene;
    if (one->point != other->point || other->missing[0] != '\0' || other->without.other)
        return 0;
    return one->without.other || features_theory(here, one->formulation.type) ==
                                     features_theory(here, other->formulation.type);
}

typedef struct known_limit {
    double value, uncertainty;
} known_limit;

static int known_limits(const sweep *s, int index, int quantity, known_limit out[MOST])
{
    int count = 0;
    for (int i = 0; i < s->seriess && count < MOST; i++) {
        if (!same_physics(s, index, i))
            continue;
        const mesh_limit fit = verdict_limit(s, i, quantity, 0);
        if (isfinite(fit.limit) && isfinite(fit.limit_uncertainty))
            out[count++] = (known_limit){fit.limit, fit.limit_uncertainty};
    }
    return count;
}

static point_reference of_limits(const sweep *s, int index, int quantity, double tolerance)
{
    const scene_quantity *q = &s->point[s->series[index].point].scene.quantity[quantity];
    const point_reference none = {ROWS_NONE, NAN, NAN};
    known_limit all[MOST];
    const int count = known_limits(s, index, quantity, all);
    int best = 0;
    if (count == 0)
        return none;
    for (int i = 1; i < count; i++)
        if (all[i].uncertainty < all[best].uncertainty)
            best = i;
    double uncertainty = all[best].uncertainty;
    for (int i = 0; i < count; i++)
        uncertainty = fmax(uncertainty, fabs(all[i].value - all[best].value) - all[i].uncertainty);
    const double scale = scale_of(q, all[best].value), most = tolerance / 2;
    if (!(all[best].uncertainty / scale <= most))
        return none;
    if (!(uncertainty / scale <= most))
        return (point_reference){ROWS_DISPUTED, NAN, NAN};
    return (point_reference){ROWS_LIMIT, all[best].value, uncertainty / scale};
}

point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[quantity];
    const truth *row =
        stored != NULL ? verdict_truth(stored, p, &one->formulation, quantity) : NULL;
    point_reference found = {ROWS_NONE, NAN, NAN};
    if (row != NULL)
        found = of_truth(q, row, ROWS_STORED);
    if (found.uncertainty <= tolerance / 2) /* false for NAN */
        return found;
    row = derived != NULL ? verdict_truth(derived, p, &one->formulation, quantity) : NULL;
    if (row != NULL)
        found = of_truth(q, row, ROWS_DERIVED);
    return found.uncertainty <= tolerance / 2 ? found
                                              : of_limits(s, series_index, quantity, tolerance);
}

static status borrow(const truths *all, const sweep_point *p, known_truths *out, fault *f)
{
    out->borrowed = 1;
    out->stored.row = calloc((size_t)all->rows + 1, sizeof *out->stored.row);
    if (out->stored.row == NULL)
        return fault_memory(f, "reference values");
    for (int i = 0; i < all->rows; i++)
        if (truth_holds(&all->row[i], p->type, p->parameter))
            out->stored.row[out->stored.rows++] = all->row[i];
    return STATUS_OK;
}

static status find_stored(const parameter_ranges *r, const sweep_point *p, known_truths *out,
                          fault *f)
{
    const ranges_request *q = &r->request;
    fault why;
    if (q->file == NULL)
        return q->truths != NULL ? borrow(q->truths, p, out, f) : STATUS_OK;
    if (!scene_file_states(q->file, "truths"))
        return STATUS_OK;
    if (scene_truths_add(q->file, p->parameter, &out->stored, &why) == STATUS_OK)
        return STATUS_OK;
    truths_free(&out->stored);
    out->stored = (truths){0};
    return STATUS_OK;
}

/* Returns the shear theory that the scene requires for a critical load; "": none, or the quantity
 * is not a critical load. */
static const char *theory_of(const scene *s, const char *quantity)
{
    const unsigned both = FEATURE_ENGESSER | FEATURE_HARINGX, needs = features_needed(s) & both;
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, quantity) == 0 &&
            s->quantity[i].what.kind != SCENE_CRITICAL_FACTOR)
            return "";
    if (needs == FEATURE_ENGESSER)
        return "engesser";
    return needs == FEATURE_HARINGX ? "haringx" : "";
}

static status add_row(const sweep_point *p, const derived_value *v, truths *t, fault *f)
{
    truth *row = &t->row[t->rows++];
    *row = (truth){.type = p->type,
                   .value = v->value,
                   .uncertainty = v->uncertainty,
                   .at = NAN,
                   .met = 1,
                   .evaluated = 1,
                   .formulation = strdup(""),
                   .theory = strdup(theory_of(&p->scene, v->quantity)),
                   .quantity = strdup(v->quantity),
                   .unit = strdup(v->unit),
                   .kind = strdup("exact"),
                   .model = strdup("same"),
                   .convention = strdup(v->convention),
                   .source = strdup(v->source)};
    memcpy(row->parameter, p->parameter, sizeof row->parameter);
    return row->formulation != NULL && row->theory != NULL && row->quantity != NULL &&
                   row->unit != NULL && row->kind != NULL && row->model != NULL &&
                   row->convention != NULL && row->source != NULL
               ? STATUS_OK
               : fault_memory(f, "reference values");
}

static status ask_scene(const char *script, const sweep_point *p, derived_value **value, int *count,
                        fault *f)
{
    FILE *text = derive_text_file(f);
    const write_head head = {p->type->name, p->type->summary, p->type->source};
    if (text == NULL)
        return STATUS_FAULT;
    status outcome = write_scene(text, &p->scene, &head, f);
    if (outcome == STATUS_OK)
        outcome = derive_scene(script, text, value, count, f);
    fclose(text);
    return outcome;
}

static status derive(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f)
{
    derived_value *value = NULL;
    int count = 0;
    char text[PARAMETERS_TEXT];
    fault why;
    parameters_source_text(p->type, p->parameter, text, sizeof text);
    if (case_omits_nothing(p->type, p->parameter))
        return STATUS_OK;
    const status outcome =
        r->request.file != NULL
            ? ask_scene(r->request.derive, p, &value, &count, &why)
            : derive_values(r->request.derive, p->type->name, text, &value, &count, &why);
    if (outcome != STATUS_OK)
        return STATUS_OK;
    out->derived.row = calloc((size_t)count + 1, sizeof *out->derived.row);
    status added = out->derived.row != NULL ? STATUS_OK : fault_memory(f, "reference values");
    for (int i = 0; i < count && added == STATUS_OK; i++)
        added = add_row(p, &value[i], &out->derived, f);
    free(value);
    return added;
}

/* Returns 1 if every requested quantity has a reference value of the same model. */
static int all_stored(const parameter_ranges *r, const sweep_point *p, const truths *t)
{
    for (int i = 0; i < r->quantities; i++)
        if (truth_of(t, p->type, p->parameter, r->quantity[i].name, "same") == NULL)
            return 0;
    return 1;
}

status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    status outcome = find_stored(r, p, out, f);
    if (outcome == STATUS_OK && r->request.derive != NULL && !all_stored(r, p, &out->stored))
        outcome = derive(r, p, out, f);
    if (outcome != STATUS_OK)
        known_free(out);
    return outcome;
}

void known_free(known_truths *k)
{
    if (k->borrowed)
        free(k->stored.row);
    else
        truths_free(&k->stored);
    truths_free(&k->derived);
    memset(k, 0, sizeof *k);
}

static status plan(const void *requested, void *found, fault *f)
{
    const convergence_request *r = requested;
    convergence *c = found;
    c->level = r->level;
    c->verbose = r->verbose;
    TRY(plan_one(r->type, r->parameter, r->cells.formulation, r->cells.formulations, r->mesh,
                 r->meshes, &c->sweep, f));
    c->made = environment_now(r->cells.jobs);
    return narrow_to(&c->sweep, r->cells.select, f);
}

static status run(const void *requested, void *found, fault *f)
{
    const convergence_request *r = requested;
    convergence *c = found;
    import_left left;
    for (int i = 0; i < r->importeds; i++) {
        TRY(import_store_read(r->imported[i], 0, &c->sweep, &left, f));
        if (left.series == left.all)
            return fault_set(f, STATUS_REFUSED,
                             "%.150s contains no results of this case at these parameters, but "
                             "results of %s; give that case and its parameters (--set)",
                             r->imported[i], left.first);
    }
    return verification_cells(&r->cells, &c->truths, &c->sweep, f);
}

static status evaluate(const void *requested, void *found, fault *f)
{
    convergence *c = found;
    (void)requested;
    TRY(families_add_truths(&c->sweep, 0, &c->truths, f));
    return evaluation_make(&c->sweep, &c->truths, 0, &c->evaluation, f);
}

static int running(const sweep *s)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++)
        count += s->series[i].missing[0] == '\0';
    return count;
}

static void write_answer(FILE *to, double level, const sweep *s, const truths *t)
{
    paragraph words;
    reach_line_write(paragraph_begin(&words, to), s, t, level);
    paragraph_end(&words, 0, 0);
    char *beyond = NULL;
    size_t size = 0;
    FILE *text = open_memstream(&beyond, &size);
    if (text == NULL)
        return;
    reach_model_write(text, s, t, level);
    if (fclose(text) == 0 && size > 0)
        paragraph_write(to, 0, 0, beyond);
    free(beyond);
}

static void write_text(FILE *to, const convergence *c)
{
    if (c->verbose || running(&c->sweep) == 1) {
        table_convergence(to, &c->sweep, &c->truths);
        fputc('\n', to);
    } else if (running(&c->sweep) > 1)
        table_beside(to, &c->sweep, &c->truths);
    write_answer(to, c->level, &c->sweep, &c->truths);
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const convergence *c = found;
    if (strcmp(format, "json") == 0)
        return json_convergence_write(to, &c->sweep, &c->truths, c->level, f);
    if (strcmp(format, "csv") == 0)
        csv_convergence(to, &c->sweep, &c->truths);
    else
        write_text(to, c);
    return STATUS_OK;
}

static experiment_cells cells(const void *found)
{
    const convergence *c = found;
    return (experiment_cells){&c->sweep, &c->evaluation, &c->made};
}

void convergence_free(convergence *c)
{
    evaluation_free(&c->evaluation);
    sweep_free(&c->sweep);
    truths_free(&c->truths);
}

const experiment_type experiment_converge = {.name = "converge",
                                             .plan = plan,
                                             .run = run,
                                             .evaluate = evaluate,
                                             .cells = cells,
                                             .write = write_form};

status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f)
{
    for (const char *at = list;; at++) {
        const int length = (int)strcspn(at, ",");
        char *end;
        if (*count == most)
            return fault_set(f, STATUS_REFUSED, "-n lists too many meshes; give at most %d numbers",
                             most);
        errno = 0;
        const long value = strtol(at, &end, 10);
        if (end == at || end != at + length || errno != 0 || value < 1 || value > MESHES_FINEST)
            return fault_set(f, STATUS_REFUSED,
                             "-n: the number of elements '%.*s' is not valid; give a whole number "
                             "from 1 to %d, such as 4",
                             length < 40 ? length : 40, at, MESHES_FINEST);
        mesh[(*count)++] = (int)value;
        at = end;
        if (*at == '\0')
            return STATUS_OK;
    }
}

static const char *const names[OUTCOME_KINDS] = {"value",         "coarse",   "wrong",
                                                 "not converged", "singular", "refused",
                                                 "no value",      "fault",    "skip"};

const char *outcome_name(outcome_kind kind)
{
    return kind >= 0 && kind < OUTCOME_KINDS ? names[kind] : "?";
}

int outcome_is_good(outcome_kind kind)
{
    return kind == OUTCOME_VALUE || kind == OUTCOME_COARSE;
}
