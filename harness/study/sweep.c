#include "harness/study/study_impl.h"

#include <stdlib.h>
#include <string.h>

/* Returns 0 if the options of the formulation change only features that do not affect the
 * quantity. */
static int option_matters(const sweep_point *p, const formulation *chosen, const char *quantity)
{
    const unsigned features = formulation_bears_on(chosen);
    if (features != 0)
        for (int q = 0; q < p->scene.quantities; q++)
            if (strcmp(p->scene.quantity[q].name, quantity) == 0)
                return (features & features_needed_by_quantity(&p->scene, q)) != 0;
    return 1;
}

void sweep_text(const sweep_point *p, const formulation *chosen, const char *quantity,
                char text[SWEEP_TEXT])
{
    snprintf(text, SWEEP_TEXT, "%s/%s/%s/%s", p->type->name,
             p->text[0] != '\0' ? p->text : "default", chosen->key, quantity);
}

int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity)
{
    if (!option_matters(p, chosen, quantity))
        return 0;
    char text[SWEEP_TEXT];
    sweep_text(p, chosen, quantity, text);
    return s->select == NULL || select_matches(s->select, text) > 0;
}

int sweep_gates(const sweep *s, const series *one)
{
    const element_type *type = one->formulation.type;
    if (one->imported != NULL)
        return one->imported->gates;
    return s->named || formulations_is_loaded(type) || !formulations_is_new(type);
}

int sweep_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].missing[0] == '\0' && s->series[i].imported == NULL &&
                         s->point[s->series[i].point].status == STATUS_OK
                     ? s->series[i].meshes
                     : 0;
    return cells;
}

void sweep_series_free(series *one)
{
    if (one->cell != NULL)
        for (int k = 0; k < one->meshes; k++)
            cell_result_free(&one->cell[k]);
    free(one->cell);
    free(one->noise);
    free(one->timing);
    imported_free(one->imported);
}

void sweep_free(sweep *s)
{
    for (int i = 0; i < s->seriess; i++)
        sweep_series_free(&s->series[i]);
    for (int i = 0; i < s->points; i++)
        scene_free(&s->point[i].scene);
    free(s->point);
    free(s->series);
    memset(s, 0, sizeof *s);
}

cell_request sweep_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    cell_request out = {.scene = &p->scene, .elements = one->mesh[mesh]};
    cell_formulation(&out, &one->formulation);
    out.solve.steps_between = p->steps;
    out.solve.condition = p->condition;
    out.solve.values_only = s->values_only;
    out.solve.whole_steps = p->whole_steps;
    out.solve.shapes = p->shapes;
    out.threads = s->threads;
    if (p->shapes == 0 && p->text[0] == '\0' && mesh == one->meshes - 1)
        out.solve.shapes = s->shapes;
    return out;
}

static status add_point(sweep *s, const case_type *type, const double value[],
                        const scene_edit *edit, fault *f)
{
    sweep_point *more = realloc(s->point, (size_t)(s->points + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "parameter points");
    s->point = more;
    sweep_point *p = &s->point[s->points++];
    memset(p, 0, sizeof *p);
    p->type = type;
    memcpy(p->parameter, value, (size_t)parameters_count(type) * sizeof *value);
    parameters_text(type, value, p->text, sizeof p->text);
    if (p->text[0] == '\0')
        snprintf(p->name, sizeof p->name, "default");
    else
        snprintf(p->name, sizeof p->name, "%012llx",
                 (unsigned long long)(parameters_hash(type, value, NULL) >> 16));
    p->edit = *edit;
    fault why = {""};
    p->status = cell_scene(type, value, edit, &p->scene, &why);
    snprintf(p->reason, sizeof p->reason, "%s", why.text);
    return STATUS_OK;
}

static const scene_edit unchanged = {.kind = SCENE_EDIT_NONE};

static int known_point(const sweep *s, const case_type *type, const double value[])
{
    for (int i = 0; i < s->points; i++)
        if (s->point[i].type == type && memcmp(s->point[i].parameter, value,
                                               (size_t)parameters_count(type) * sizeof *value) == 0)
            return 1;
    return 0;
}

static int is_complete(const truth *row)
{
    const int count = parameter_count(row->type->parameters);
    for (int i = 0; i < count; i++)
        if (row->any[i])
            return 0;
    return 1;
}

static status plan_points(const case_type *const *cases, const truths *t, sweep *s, fault *f)
{
    for (int c = 0; cases[c] != NULL; c++) {
        const case_type *type = cases[c];
        double value[CASE_MAX_PARAMETERS] = {0};
        parameters_default(type, value);
        TRY(add_point(s, type, value, &unchanged, f));
        for (int i = 0; i < t->rows; i++)
            if (t->row[i].type == type && is_complete(&t->row[i]) &&
                !known_point(s, type, t->row[i].parameter))
                TRY(add_point(s, type, t->row[i].parameter, &unchanged, f));
    }
    return STATUS_OK;
}

static status add_mesh(series *s, const char *name, int n, fault *f)
{
    int at = 0;
    while (at < s->meshes && s->mesh[at] < n)
        at++;
    if (at < s->meshes && s->mesh[at] == n)
        return STATUS_OK;
    if (s->meshes == SERIES_MAX_MESHES)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: more than %d meshes in a series; give fewer with -n, or a smaller --refine", name,
            SERIES_MAX_MESHES);
    for (int i = s->meshes++; i > at; i--)
        s->mesh[i] = s->mesh[i - 1];
    s->mesh[at] = n;
    return STATUS_OK;
}

static status double_meshes(series *s, const char *name, int doublings, fault *f)
{
    for (int i = 0; i < doublings && s->meshes > 0; i++) {
        const int finest = s->mesh[s->meshes - 1];
        if (finest > INT_MAX / 2)
            return fault_set(f, STATUS_REFUSED,
                             "%s: %d elements cannot be doubled again; give a smaller --refine",
                             name, finest);
        TRY(add_mesh(s, name, 2 * finest, f));
    }
    return STATUS_OK;
}

static status add_series(sweep *s, int index, const formulation *chosen, const truths *t, fault *f)
{
    series *more = realloc(s->series, (size_t)(s->seriess + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "series");
    s->series = more;
    series *one = &s->series[s->seriess++];
    const sweep_point *p = &s->point[index];
    memset(one, 0, sizeof *one);
    one->point = index;
    one->formulation = *chosen;
    if (p->status == STATUS_OK)
        (s->whole_only ? missing_words : missing_refused)(&p->scene, chosen->type, one->missing,
                                                          sizeof one->missing);
    for (int i = 0; i < p->scene.meshes; i++)
        TRY(add_mesh(one, p->type->name, p->scene.mesh[i], f));
    TRY(double_meshes(one, p->type->name, s->doublings, f));
    if (t != NULL)
        for (int i = 0; i < t->rows; i++)
            if (t->row[i].elements > 0 && strcmp(t->row[i].formulation, chosen->key) == 0 &&
                truth_holds(&t->row[i], p->type, p->parameter))
                TRY(add_mesh(one, p->type->name, t->row[i].elements, f));
    return STATUS_OK;
}

static void find_omission(const sweep *s, int index, whole_results *known)
{
    series *one = &s->series[index];
    const scene *here = &s->point[one->point].scene;
    const unsigned what = missing_omits(here, one->formulation.type);
    for (int i = 0; i < index; i++)
        if (s->series[i].point == one->point && s->series[i].without.what == what) {
            one->without = s->series[i].without;
            return;
        }
    omission_beside(here, one->formulation.type, known, &one->without);
}

static void plan_omissions(sweep *s, int point_index)
{
    const sweep_point *p = &s->point[point_index];
    whole_results known = {.count = 0};
    for (int i = 0; i < s->seriess && p->status == STATUS_OK; i++)
        if (s->series[i].point == point_index && s->series[i].missing[0] == '\0' &&
            s->series[i].imported == NULL)
            find_omission(s, i, &known);
    whole_results_free(&known);
}

enum { MOST_FORMULATIONS = 64 };
typedef struct chosen_cells {
    int count;
    formulation list[MOST_FORMULATIONS];
} chosen_cells;

static void choose_given(const sweep_request *request, chosen_cells *out)
{
    for (int i = 0; i < request->formulations && out->count < MOST_FORMULATIONS; i++)
        out->list[out->count++] = request->formulation[i];
}

static void choose_options(const element_type *type, chosen_cells *out)
{
    for (int k = 0; k < parameter_count(type->options); k++) {
        if (element_judged(type, k) == 0)
            continue;
        const int choices = parameter_choices(parameter_at(type->options, k));
        for (int choice = 0; choice < choices && out->count < MOST_FORMULATIONS; choice++)
            out->count += formulation_choice(type, k, choice, &out->list[out->count]);
    }
}

static void choose_stored(const truths *t, const sweep_point *p, chosen_cells *out)
{
    for (int i = 0; i < t->rows && out->count < MOST_FORMULATIONS; i++) {
        const char *key = t->row[i].formulation;
        int known = key[0] == '\0' || !truth_holds(&t->row[i], p->type, p->parameter);
        for (int k = 0; k < out->count && !known; k++)
            known = strcmp(out->list[k].key, key) == 0;
        if (!known)
            out->count += formulation_parse(key, &out->list[out->count], NULL) == STATUS_OK;
    }
}

static void choose_all(const truths *t, const sweep_point *p, chosen_cells *out)
{
    for (int i = 0; formulations_at(i) != NULL && out->count < MOST_FORMULATIONS; i++)
        formulation_default(formulations_at(i), &out->list[out->count++]);
    if (p->text[0] == '\0')
        for (int i = 0; formulations_at(i) != NULL; i++)
            choose_options(formulations_at(i), out);
    choose_stored(t, p, out);
}

static int is_selected(const sweep *s, const sweep_point *p, const formulation *one,
                       select_words *words, char requested[])
{
    int selected = 0;
    for (int q = 0; q < p->scene.quantities || q == 0; q++) {
        const char *quantity = q < p->scene.quantities ? p->scene.quantity[q].name : "";
        char text[SWEEP_TEXT];
        sweep_text(p, one, quantity, text);
        select_meet(s->select, text, words);
        requested[q] |= s->select == NULL || select_matches(s->select, text) > 0;
        selected = selected || sweep_selects(s, p, one, quantity);
    }
    return selected;
}

static status plan_series(const sweep_request *request, const truths *t, sweep *s, int index,
                          select_words *words, char requested[], fault *f)
{
    const sweep_point *p = &s->point[index];
    chosen_cells those = {.count = 0};
    if (request->formulations > 0)
        choose_given(request, &those);
    else
        choose_all(t, p, &those);
    for (int i = 0; i < those.count; i++)
        if (is_selected(s, p, &those.list[i], words, requested))
            TRY(add_series(s, index, &those.list[i], t, f));
    return STATUS_OK;
}

static void drop_quantities(scene *s, const char requested[])
{
    int kept = 0;
    for (int q = 0; q < s->quantities; q++)
        if (requested[q])
            s->quantity[kept++] = s->quantity[q];
    s->quantities = kept > 0 ? kept : s->quantities;
}

static status plan_point(const sweep_request *request, const truths *t, sweep *s, int index,
                         select_words *words, fault *f)
{
    char *requested = calloc((size_t)s->point[index].scene.quantities + 1, 1);
    if (requested == NULL)
        return fault_memory(f, "a selection");
    const status outcome = plan_series(request, t, s, index, words, requested, f);
    plan_omissions(s, index);
    drop_quantities(&s->point[index].scene, requested);
    free(requested);
    return outcome;
}

static status alloc_cells(sweep *s, fault *f)
{
    for (int i = 0; i < s->seriess; i++) {
        if (s->series[i].cell != NULL)
            continue;
        s->series[i].cell = calloc((size_t)s->series[i].meshes + 1, sizeof *s->series[i].cell);
        if (s->series[i].cell == NULL)
            return fault_memory(f, "results");
    }
    return STATUS_OK;
}

static status plan_all(const sweep_request *request, const truths *t, sweep *out, fault *f)
{
    select_words words;
    TRY(select_begin(request->select, &words, f));
    TRY(plan_points(out->cases, t, out, f));
    for (int i = 0; i < out->points; i++)
        TRY(plan_point(request, t, out, i, &words, f));
    TRY(select_all_met(request->select, &words, f));
    return alloc_cells(out, f);
}

status plan_sweep(const sweep_request *request, const truths *t, sweep *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->select = request->select;
    out->cases = request->cases != NULL ? request->cases : registry_cases;
    out->given = request->formulation;
    out->givens = request->formulations;
    out->named = request->named;
    out->tolerance = request->tolerance;
    out->doublings = request->doublings;
    out->whole_only = request->whole_only;
    const status outcome = plan_all(request, t, out, f);
    if (outcome != STATUS_OK)
        sweep_free(out);
    return outcome;
}

status plan_add(sweep *s, const case_type *type, const double value[], const scene_edit *edit,
                const int mesh[], int meshes, fault *f)
{
    TRY(add_point(s, type, value, edit != NULL ? edit : &unchanged, f));
    if (meshes > 0)
        scene_meshes(&s->point[s->points - 1].scene, meshes, mesh);
    return STATUS_OK;
}

status plan_extend(sweep *s, const formulation those[], int count, fault *f)
{
    for (int i = 0; i < count; i++)
        TRY(add_series(s, s->points - 1, &those[i], NULL, f));
    plan_omissions(s, s->points - 1);
    return alloc_cells(s, f);
}

static status fill_one(const case_type *type, const double value[], const formulation those[],
                       int count, const int mesh[], int meshes, sweep *out, fault *f)
{
    TRY(plan_add(out, type, value, NULL, mesh, meshes, f));
    if (out->point[0].status != STATUS_OK)
        return fault_set(f, out->point[0].status, "%s", out->point[0].reason);
    return plan_extend(out, those, count, f);
}

status plan_one(const case_type *type, const double value[], const formulation those[], int count,
                const int mesh[], int meshes, sweep *out, fault *f)
{
    memset(out, 0, sizeof *out);
    const status outcome = fill_one(type, value, those, count, mesh, meshes, out, f);
    if (outcome != STATUS_OK)
        sweep_free(out);
    return outcome;
}
