#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics.h"

static status copy_left_out(const model *m, cell_result *out, fault *f)
{
    const char *const *lines;
    const int count = model_left_out(m, &lines);
    out->left_out = calloc((size_t)count + 1, sizeof *out->left_out);
    if (out->left_out != NULL)
        for (int i = 0; i < count; i++)
            if ((out->left_out[out->left_out_lines] = strdup(lines[i])) != NULL)
                out->left_out_lines++;
    return out->left_out_lines == count ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory");
}

status cell_scene(const case_type *type, const double parameter[], const scene_edit *edit,
                  scene *out, fault *f)
{
    scene_init(out, type->name);
    TRY(case_build(type, parameter, out, f));
    if (edit != NULL)
        TRY(scene_edit_apply(out, edit, f));
    return scene_validate(out, f);
}

static status set_up(const cell_request *request, const scene *s, model **m, cell_result *out,
                     fault *f)
{
    const model_request what = {s,
                                request->formulation,
                                request->option,
                                request->elements,
                                request->keep_all,
                                request->omit};
    TRY(model_alloc(&what, m, f));
    out->size = model_sizes(*m);
    out->mass = model_mass(*m);
    return copy_left_out(*m, out, f);
}

/* Sets *s to the scene of the request. If the request has none, builds the scene and stores it in
 * the result. */
static status scene_of(const cell_request *request, const scene **s, cell_result *out, fault *f)
{
    *s = request->scene;
    if (*s != NULL)
        return STATUS_OK;
    *s = &out->scene;
    return cell_scene(request->type, request->parameter, &request->edit, &out->scene, f);
}

static status run(const cell_request *request, model **m, cell_result *out, fault *f)
{
    const scene *s;
    TRY(scene_of(request, &s, out, f));
    const double start = clock_processor_seconds();
    const status ready = set_up(request, s, m, out, f);
    const double prepared = clock_processor_seconds() - start;
    out->solve.seconds_setup = prepared;
    TRY(ready);
    if (request->is_known != NULL && request->is_known(request->context, *m))
        return STATUS_OK;
    solve_options options = request->solve;
    options.threads = request->threads;
    const status outcome = solve_scene(s, *m, &options, &out->solve, f);
    out->solve.seconds_setup += prepared;
    out->counters = out->solve.counters;
    return outcome;
}

void cell_formulation(cell_request *request, const formulation *chosen)
{
    request->formulation = chosen->type;
    memcpy(request->option, chosen->option, sizeof request->option);
    request->solve.newton = formulation_newton(chosen);
}

static status nothing_counts(const char *trouble, solve_result *out, fault *f)
{
    out->status = STATUS_NOT_CONVERGED;
    snprintf(out->reason, sizeof out->reason, "%s", trouble);
    for (int i = 0; i < out->quantities; i++)
        quantity_no_value(&out->quantity[i], out->status, trouble);
    return fault_set(f, out->status, "%s", trouble);
}

status cell_run(const cell_request *request, cell_result *out, fault *f)
{
    model *m = NULL;
    memset(out, 0, sizeof *out);
    status outcome = run(request, &m, out, f);
    const char *trouble = m != NULL ? model_trouble(m) : NULL;
    if (trouble != NULL)
        outcome = nothing_counts(trouble, &out->solve, f);
    if (outcome != STATUS_OK && out->solve.status == STATUS_OK) {
        out->solve.status = outcome;
        snprintf(out->solve.reason, sizeof out->solve.reason, "%s", f != NULL ? f->text : "");
    }
    model_free(m);
    return outcome;
}

int cell_values(const cell_result *r)
{
    int count = 0;
    for (int i = 0; i < r->solve.quantities; i++)
        count += r->solve.quantity[i].status == STATUS_OK;
    return count;
}

void cell_result_free(cell_result *r)
{
    for (int i = 0; i < r->left_out_lines; i++)
        free(r->left_out[i]);
    free(r->left_out);
    result_free(&r->solve);
    scene_free(&r->scene);
    memset(r, 0, sizeof *r);
}

const double omission_most = 1e-4;
const double omission_safety = 2;
/* [s] longest estimated time of a solution; if it would take longer, the change is reported as
 * unknown */
static const double longest = 20;
/* [s] a solution with a shorter estimated time is always made */
static const double brief = 0.2;
/* A change larger than this multiple of omission_most is significant without the safety factor. */
static const double many_times = 100;
/* values below this fraction of the largest value in the same unit count as zero */
static const double nothing = 1e-9;

/* Returns the physics that have no effect because the corresponding constants of the section are
 * zero. */
static unsigned absent_in(const section *c)
{
    const double length = sqrt(c->Ip / c->A), moment = 1e-12 * c->Ip * length;
    unsigned absent = 0;
    int rigid = 1;
    for (int i = 0; i < 9; i++)
        rigid &= fabs(c->F[i]) <= 0;
    if (c->matrices)
        return 0;
    absent |= rigid ? FEATURE_SHEAR : 0;
    absent |= c->F[0] <= 0 ? OMIT_SHEAR_Y : 0;
    absent |= c->F[8] <= 0 || c->Iw <= 0 ? OMIT_SHEAR_WARPING : 0;
    absent |= fabs(c->wagner_torque) <= 0 ? FEATURE_WAGNER_TORQUE : 0;
    absent |=
        fabs(c->wagner_y) <= moment && fabs(c->wagner_z) <= moment ? FEATURE_WAGNER_MOMENTS : 0;
    return absent | (c->Iw <= 0 ? FEATURE_WARPING : 0);
}

/* Returns the physics that have no effect in any analysis of the scene: second-order physics if all
 * analyses are linear about the undeformed state, and rotary inertia if all analyses are static. */
static unsigned absent_in_analyses(const scene *s)
{
    const unsigned higher = FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE;
    int undeformed = 1, rests = 1;
    for (int i = 0; i < s->analyses; i++) {
        const scene_analysis *a = &s->analysis[i];
        undeformed &=
            a->kind == SCENE_LINEAR ||
            ((a->kind == SCENE_MODAL || a->kind == SCENE_COMPLIANCE || a->kind == SCENE_HARMONIC) &&
             a->follows == SCENE_NONE);
        rests &= a->kind != SCENE_MODAL && a->kind != SCENE_HARMONIC && a->kind != SCENE_ROTATION &&
                 a->kind != SCENE_MOTION && !scene_rotates(a);
    }
    return (undeformed ? higher : 0) | (rests ? FEATURE_ROTARY_INERTIA : 0);
}

static unsigned absent_in_sections(const scene *s)
{
    unsigned absent = scene_tapers(s) ? 0 : ~0U;
    for (int i = 0; i < s->sections && absent != 0; i++) {
        section c;
        absent &= scene_constants(s, i, &c, NULL) == STATUS_OK ? absent_in(&c) : 0;
    }
    return absent;
}

static int can_be_shown(const scene *s)
{
    int can = 1;
    for (int i = 0; i < s->sections; i++)
        can &= s->section[i].kind != SECTION_MATRICES;
    return can;
}

static const element_type *whole_model(const scene *s)
{
    const element_type *best = NULL;
    int highest = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *t = registry_formulations[i];
        char words[OMIT_WORDS];
        double options[ELEMENT_MAX_OPTIONS] = {0};
        if (missing_words(s, t, words, sizeof words) || lacks_of(s, t, words, sizeof words))
            continue;
        parameter_defaults(t->options, options);
        const int order = element_order_in(t, ELEMENT_STATICS, options).highest;
        if (best != NULL && order <= highest)
            continue;
        best = t;
        highest = order;
    }
    return best;
}

static status solve(const scene *s, const element_type *type, unsigned omit, int elements,
                    cell_result *out, fault *f)
{
    formulation chosen;
    cell_request request = {.scene = s, .elements = elements, .omit = omit};
    formulation_default(type, &chosen);
    cell_formulation(&request, &chosen);
    return cell_run(&request, out, f);
}

static double size_of_unit(const scene *s, const solve_result *r, int quantity)
{
    double size = 0;
    for (int q = 0; q < s->quantities; q++)
        if (strcmp(s->quantity[q].unit, s->quantity[quantity].unit) == 0 &&
            isfinite(r->quantity[q].value))
            size = fmax(size, fabs(r->quantity[q].value));
    return size;
}

static double relative(double apart, double scale)
{
    return apart > 0 ? apart / scale : isfinite(apart) ? 0 : INFINITY;
}

/* Returns the largest difference between two curves over their points, relative to the largest
 * magnitude of a or, if larger, to `least`. INFINITY: the curves have different points. */
static double change_of_curve(const curve *a, const curve *b, double least)
{
    double apart = 0, size = least;
    if (a->points != b->points)
        return INFINITY;
    for (int i = 0; i < a->points; i++) {
        size = fmax(size, fabs(a->value[i]));
        apart = fmax(apart, fabs(b->value[i] - a->value[i]));
        if (fabs(a->x[i] - b->x[i]) > 1e-9 * fmax(fabs(a->x[i]), fabs(a->x[a->points - 1])))
            return INFINITY;
    }
    return relative(apart, size);
}

/* Returns the relative change of a quantity; INFINITY: one of the two values is missing. */
static double change_of(const scene *s, const solve_result *with, const solve_result *without,
                        int quantity)
{
    const scene_quantity *q = &s->quantity[quantity];
    const quantity_result *a = &with->quantity[quantity], *b = &without->quantity[quantity];
    const double least = fmax(q->near_zero, nothing * size_of_unit(s, with, quantity));
    if (a->status != STATUS_OK || b->status != STATUS_OK)
        return INFINITY;
    if (q->reduction == SCENE_CURVE)
        return change_of_curve(&a->curve, &b->curve, least);
    return relative(fabs(b->value - a->value), fmax(fabs(a->value), least));
}

static int is_whole(const scene *s, const cell_result *c, char why[FAULT_TEXT])
{
    if (c->solve.status != STATUS_OK || c->solve.quantities < s->quantities) {
        snprintf(why, FAULT_TEXT, "%s", c->solve.reason);
        return 0;
    }
    for (int q = 0; q < s->quantities; q++)
        if (c->solve.quantity[q].status != STATUS_OK) {
            snprintf(why, FAULT_TEXT, "%s: %.200s", s->quantity[q].name,
                     c->solve.quantity[q].reason);
            return 0;
        }
    return 1;
}

/* Returns the result with all physics on one mesh, and keeps it in `known`. */
static const cell_result *whole_result(const scene *s, const element_type *type, int elements,
                                       whole_results *known)
{
    int i = 0;
    fault f;
    while (i < known->count && known->elements[i] != elements)
        i++;
    if (i < known->count)
        return &known->cell[i];
    if (i == WHOLE_RESULTS)
        cell_result_free(&known->cell[--i]);
    known->elements[i] = elements;
    known->count = i + 1;
    solve(s, type, 0, elements, &known->cell[i], &f);
    return &known->cell[i];
}

void whole_results_free(whole_results *known)
{
    for (int i = 0; i < known->count; i++)
        cell_result_free(&known->cell[i]);
    known->count = 0;
}

/* Returns the largest relative change of a quantity on one mesh if the physics out->what are
 * omitted. NAN: a value is missing, and out->why gives the reason. */
static double change_on(const scene *s, const element_type *type, int elements,
                        whole_results *known, omission *out)
{
    const cell_result *with = whole_result(s, type, elements, known);
    cell_result without;
    fault f = {""};
    double largest = NAN;
    solve(s, type, out->what, elements, &without, &f);
    if (is_whole(s, with, out->why) && is_whole(s, &without, out->why)) {
        largest = 0;
        for (int q = 0; q < s->quantities; q++) {
            const double change = change_of(s, &with->solve, &without.solve, q);
            if (change <= largest)
                continue;
            largest = change;
            snprintf(out->quantity, sizeof out->quantity, "%s", s->quantity[q].name);
        }
    }
    cell_result_free(&without);
    return largest;
}

/* Returns 1 if the changes on two meshes differ by at most a factor of two. Changes below the
 * scatter also agree. */
static int agree(double coarse, double fine)
{
    const double noise = 1e-9, apart = 2;
    return fmax(coarse, fine) <= noise || (coarse <= apart * fine && fine <= apart * coarse);
}

/* Solves on repeatedly doubled meshes until the changes on two meshes agree. The result is the
 * larger of these changes times omission_safety or, if the last change exceeds many_times
 * omission_most, the last change. If a further solution would take longer than `brief`, one change
 * above this bound is sufficient. */
static void estimate(const scene *s, const element_type *type, whole_results *known, omission *out)
{
    enum { FINEST = 32 };
    double last = NAN;
    for (int n = 1; n <= FINEST; n *= 2) {
        const double cost = run_cost_of_scene(s, 0, type, n);
        if (last > many_times * omission_most && cost > brief) {
            out->change = last;
            return;
        }
        if (cost > longest) {
            snprintf(out->why, sizeof out->why, "a solution would take more than %g s", longest);
            return;
        }
        const double change = change_on(s, type, n, known, out);
        if (isfinite(last) && isfinite(change) && agree(last, change)) {
            out->change =
                change > many_times * omission_most ? change : omission_safety * fmax(last, change);
            return;
        }
        if (isfinite(last) && isfinite(change))
            snprintf(out->why, sizeof out->why,
                     "the effect depends on the mesh: %.2g, but %.2g with %d elements", last,
                     change, n);
        last = change;
    }
    if (out->why[0] == '\0')
        snprintf(out->why, sizeof out->why,
                 "fewer than two meshes of up to %d elements have all values", FINEST);
}

static void find_change(const scene *s, whole_results *known, omission *out)
{
    const element_type *whole = whole_model(s);
    out->exact = (out->what & ~absent_in_sections(s) & ~absent_in_analyses(s)) == 0;
    if (out->exact)
        out->change = 0;
    else if (whole == NULL)
        snprintf(out->why, sizeof out->why,
                 "no built-in formulation supports all physics of the scene");
    else if (!can_be_shown(s))
        snprintf(out->why, sizeof out->why, "a section is given by its matrices");
    else
        estimate(s, whole, known, out);
}

double omission_on_mesh(const scene *s, unsigned what, int elements)
{
    const element_type *whole = whole_model(s);
    omission out = {.what = what};
    whole_results known = {.count = 0};
    const double change = whole != NULL ? change_on(s, whole, elements, &known, &out) : NAN;
    whole_results_free(&known);
    return change;
}

void omission_beside(const scene *s, const element_type *type, whole_results *known, omission *out)
{
    *out = (omission){.what = missing_omits(s, type), .change = NAN};
    missing_omit_words(out->what, out->words);
    if (out->what == 0)
        return;
    find_change(s, known, out);
    out->other = !(out->change <= omission_most); /* true even for NAN */
}

void omission_of(const scene *s, const element_type *type, omission *out)
{
    whole_results known = {.count = 0};
    omission_beside(s, type, &known, out);
    whole_results_free(&known);
}

void omission_words(const omission *o, char text[OMISSION_TEXT])
{
    text[0] = '\0';
    if (o->what == 0)
        return;
    if (o->exact || o->change == 0)
        snprintf(text, OMISSION_TEXT, "without %s; the omission changes no value", o->words);
    else if (!o->other)
        snprintf(text, OMISSION_TEXT, "without %s; the omission changes no value by more than %.1g",
                 o->words, o->change);
    else if (isfinite(o->change))
        snprintf(text, OMISSION_TEXT,
                 "another model: %s not modelled (changes %s by about %.*f %%)", o->words,
                 o->quantity, o->change < 0.01 ? 2 : o->change < 0.1, 100 * o->change);
    else if (isnan(o->change))
        snprintf(text, OMISSION_TEXT, "another model: %s not modelled (its effect is unknown: %s)",
                 o->words, o->why);
    else
        snprintf(text, OMISSION_TEXT,
                 "another model: %s not modelled (%s changes from zero, or its path changes)",
                 o->words, o->quantity);
}
