#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/numerics/numerics.h"

enum { HALVINGS = 20 };

static status keep_sample(follow_state *w, double value, int requested, follow_shapes *s, fault *f)
{
    follow_curves *c = w->out;
    const size_t modes = (size_t)c->modes;
    if (c->samples == w->room) {
        const int room = 2 * w->room + 64;
        follow_sample *more = realloc(c->sample, (size_t)room * sizeof *more);
        c->sample = more != NULL ? more : c->sample;
        follow_shapes *kept = realloc(w->shapes, (size_t)room * sizeof *kept);
        w->shapes = kept != NULL ? kept : w->shapes;
        if (more == NULL || kept == NULL) {
            follow_match_free(s);
            fault_memory(f, "curves of modes");
            return STATUS_FAULT;
        }
        w->room = room;
    }
    w->shapes[c->samples] = *s;
    follow_sample *out = &c->sample[c->samples++];
    *out = (follow_sample){.value = value, .requested = requested};
    out->frequency = calloc(2 * modes + 1, sizeof *out->frequency);
    if (out->frequency == NULL) {
        fault_memory(f, "curves of modes");
        return STATUS_FAULT;
    }
    out->match = out->frequency + modes;
    for (size_t i = 0; i < modes; i++) {
        out->frequency[i] = s->frequency[i] / (2 * PI);
        out->match[i] = s->match[i];
    }
    return STATUS_OK;
}

static void drop_sample(follow_state *w)
{
    const int last = --w->out->samples;
    free(w->out->sample[last].frequency);
    follow_match_free(&w->shapes[last]);
}

/* Makes one step from the last sample. If *least < follow_sure, the step is too large and no sample
 * is stored. */
static status try_step(follow_state *w, double target, int requested, double *least, fault *f)
{
    follow_shapes next;
    const int events = w->out->events;
    const status outcome =
        follow_solve(w, target, &w->shapes[w->out->samples - 1], &next, least, f);
    if (outcome != STATUS_OK || *least < follow_sure) {
        follow_match_free(&next);
        return outcome;
    }
    TRY(keep_sample(w, target, requested, &next, f));
    TRY(follow_events_step(w, least, f));
    if (*least < follow_sure) {
        drop_sample(w);
        w->out->events = events;
    }
    return STATUS_OK;
}

static status step_to(follow_state *w, double to, fault *f)
{
    const follow_curves *c = w->out;
    double target = to, at = c->sample[c->samples - 1].value;
    const double least_step = ldexp(fabs(to - at), -HALVINGS);
    while (at != to) {
        double least = 1;
        TRY(try_step(w, target, target == to, &least, f));
        at = c->sample[c->samples - 1].value;
        target = least >= follow_sure ? to : at + (target - at) / 2;
        if (fabs(target - at) < least_step && at != to)
            return fault_set(
                f, STATUS_NOT_CONVERGED,
                "a mode cannot be followed beyond %.6g, where the computed modes represent only "
                "%.2f of its shape; begin at another value, or request more frequencies",
                at, least);
    }
    return STATUS_OK;
}

static status follow_to_end(follow_state *w, fault *f)
{
    const follow_request *r = w->of;
    follow_shapes first;
    double least;
    const status begun = follow_solve(w, r->from, NULL, &first, &least, f);
    if (begun != STATUS_OK)
        follow_match_free(&first);
    TRY(begun);
    TRY(keep_sample(w, r->from, 1, &first, f));
    for (int i = 1; i <= r->parts; i++)
        TRY(step_to(w, i == r->parts ? r->to : r->from + (r->to - r->from) * i / r->parts, f));
    return STATUS_OK;
}

static status follow(follow_state *w, fault *f)
{
    TRY(follow_to_end(w, f));
    return follow_events_rest(w, f);
}

status follow_run(const follow_request *r, follow_curves *out, fault *f)
{
    follow_state w = {.of = r, .out = out};
    memset(out, 0, sizeof *out);
    const status outcome = follow(&w, f);
    for (int i = 0; i < out->samples; i++)
        follow_match_free(&w.shapes[i]);
    free(w.shapes);
    if (outcome != STATUS_OK)
        follow_free(out);
    return outcome;
}

void follow_free(follow_curves *c)
{
    for (int i = 0; i < c->samples; i++)
        free(c->sample[i].frequency);
    free(c->sample);
    free(c->event);
    memset(c, 0, sizeof *c);
}

/* Largest last correction of a converged step; the next correction would be about its square. A
 * larger last correction, up to largest_correction, is accepted if the predicted next correction is
 * negligible. Above many_elements, promised_correction grows with the number of elements, because
 * rounding of positions limits the corrections. */
static const double promised_correction = 1e-8, largest_correction = 1e-6,
                    negligible_correction = 1e-14, many_elements = 1e4;

static int iterations_of_steps(const solve_result *r)
{
    int sum = 0;
    for (int i = 0; i < r->steps; i++)
        sum += r->step[i].iterations;
    return sum;
}

static long rejected_before_steps(const solve_result *r)
{
    long sum = 0;
    for (int i = 0; i < r->steps; i++)
        sum += r->step[i].rejected;
    return sum;
}

static int searches_beyond(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_BUCKLING && s->analysis[i].follows != SCENE_NONE)
            return 1;
    return 0;
}

static int unfinished_step(const solve_result *r, double promised)
{
    for (int i = 0; i < r->steps; i++)
        if (!(r->step[i].correction <= promised) &&
            !(r->step[i].correction <= largest_correction &&
              r->step[i].remaining <= negligible_correction))
            return i;
    return -1;
}

/* Returns 1 if the solution consists only of Newton iterations, without rejected steps. Each
 * iteration then evaluates each element once and factors the matrix once. */
static int is_plain(const cell_result *cell, const scene *s, newton_form newton)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind != SCENE_STATIC)
            return 0;
    return newton == NEWTON_MIXED && cell->counters.rejected_steps == 0;
}

static long most_reused(const cell_result *cell, const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind == SCENE_CONTINUATION)
            return cell->counters.steps;
    return 0;
}

static long most_stale(const cell_result *cell, const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i) && s->analysis[i].kind == SCENE_MOTION)
            return cell->counters.iterations - cell->counters.steps;
    return 0;
}

static const char *wrong_count(const cell_result *cell, long reused, long stale, int plain)
{
    const counters *c = &cell->counters;
    const long linearised = c->iterations - reused, evaluations = linearised * cell->size.elements;
    const struct {
        const char *name;
        long counted, needed;
    } row[] = {{"strain evaluations", c->strain_evaluations, evaluations},
               {"stress evaluations", c->stress_evaluations, evaluations},
               {"factorisations", c->factorisations, linearised - stale}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        if (row[i].counted < row[i].needed || (plain && row[i].counted != row[i].needed))
            return row[i].name;
    return c->numerics.solutions < c->iterations ? "solutions" : NULL;
}

int record_is_consistent(const cell_result *cell, const scene *s, newton_form newton,
                         char why[FAULT_TEXT])
{
    const solve_result *r = &cell->solve;
    const counters *c = &cell->counters;
    if (r->status != STATUS_OK)
        return 1;
    const double promised = promised_correction * fmax(1, cell->size.elements / many_elements);
    const int iterations = iterations_of_steps(r), early = unfinished_step(r, promised);
    const long rejected = rejected_before_steps(r);
    const char *count =
        wrong_count(cell, most_reused(cell, s), most_stale(cell, s), is_plain(cell, s, newton));
    if (c->steps != r->steps)
        snprintf(why, FAULT_TEXT,
                 "the number of counted steps (%ld) differs from the number of recorded steps (%d)",
                 c->steps, r->steps);
    else if (c->rejected_steps < rejected || (c->rejected_steps != rejected && !searches_beyond(s)))
        snprintf(why, FAULT_TEXT,
                 "the number of counted rejected steps (%ld) differs from the number in the "
                 "records of the steps (%ld)",
                 c->rejected_steps, rejected);
    else if (iterations > r->iterations || r->iterations > c->iterations)
        snprintf(why, FAULT_TEXT,
                 "the numbers of iterations differ: %d in the steps, %d recorded, %ld counted",
                 iterations, r->iterations, c->iterations);
    else if (early >= 0)
        snprintf(
            why, FAULT_TEXT,
            "step %d ended without convergence: correction %.1e, predicted next correction %.1e",
            early, r->step[early].correction, r->step[early].remaining);
    else if (count != NULL)
        snprintf(why, FAULT_TEXT, "the number of %s does not match %ld iterations with %d elements",
                 count, c->iterations, cell->size.elements);
    else
        return 1;
    return 0;
}

/* largest relative difference between a value and the stored discrete value */
static const double agreement_least = 1e-6;

static status add_agreement(const agreement *one, evaluation *out, fault *f)
{
    TRY(memory_append(&out->agreement, &out->agreements, one, sizeof *one, "agreements", f));
    out->disagreements += !one->good;
    return STATUS_OK;
}

static status compare_mesh(const sweep *s, const truth *row, int index, int mesh, evaluation *out,
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

status agreements_add(const sweep *s, const truths *t, int index, evaluation *out, fault *f)
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

/* Returns the row for the case and the formulation of the series, and adds it if necessary. NULL:
 * out of memory. */
static coverage *row_of(const sweep *s, evaluation *j, const series *one, fault *f)
{
    const case_type *of = s->point[one->point].type;
    for (int i = 0; i < j->coverages; i++)
        if (j->coverage[i].type == one->formulation.type && j->coverage[i].of == of)
            return &j->coverage[i];
    coverage *more = realloc(j->coverage, (size_t)(j->coverages + 1) * sizeof *more);
    if (more == NULL) {
        fault_memory(f, "coverages");
        return NULL;
    }
    j->coverage = more;
    more[j->coverages] = (coverage){.of = of, .type = one->formulation.type, .point = one->point};
    return &more[j->coverages++];
}

static void count(const sweep *s, const verdict *v, coverage *row)
{
    for (int k = 0; k < COVERAGE_MESHES && k < s->series[v->series].meshes; k++) {
        const mesh_limit l = k == 0 ? v->fit : verdict_limit(s, v->series, v->quantity, k);
        if (l.meshes < 3)
            continue;
        row->series[k]++;
        row->covered[k] +=
            fabs(l.limit - v->truth->value) <= l.limit_uncertainty + v->truth->uncertainty;
    }
}

status coverage_count(const sweep *s, int first, evaluation *out, fault *f)
{
    for (int i = first; i < out->verdicts; i++) {
        const verdict *v = &out->verdict[i];
        if (v->truth == NULL || strcmp(v->truth->kind, "exact") != 0 || isnan(v->fit.limit))
            continue;
        if (s->series[v->series].imported != NULL)
            continue;
        coverage *row = row_of(s, out, &s->series[v->series], f);
        if (row == NULL)
            return STATUS_FAULT;
        count(s, v, row);
    }
    return STATUS_OK;
}
