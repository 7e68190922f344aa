/* Damped modes: the eigenvectors of the dynamic stiffness D (harmonic_matrices.c) at s = i w. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "harness/model/model.h"

/* Up to this number of states, all poles of closed loops are computed. */
enum { ALL_STATES = 400 };

static status no_memory(fault *f)
{
    return fault_memory(f, "damped modes");
}

static const char *const one_each = "; each integral gain must move the coordinate that it "
                                    "measures, and no two gains may move the same coordinate";

static status take_frequencies(const harmonic_modes *m, int *count, double **hertz, fault *f)
{
    *hertz = calloc((size_t)m->kept + 1, sizeof **hertz);
    if (*hertz == NULL)
        return no_memory(f);
    for (int i = 0; i < m->kept; i++)
        if (isfinite(m->square[i]) && m->square[i] > m->shift)
            (*hertz)[(*count)++] = sqrt(m->square[i] - m->shift) / (2 * PI);
    return STATUS_OK;
}

/* Finds the damped modes up to the frequency `below` [Hz], or all modes if loops are closed and
 * there are at most ALL_STATES states. */
static status find_damped_of(vibration *v, const sparse *const of[], sparse closed[],
                             matrix_factor *factor, double below, unsymmetric_result *r, fault *f)
{
    enum { FIRST = 16 };
    const int states = 2 * of[0]->n, all = v->loops > 0 && states <= ALL_STATES;
    fault why = {""};
    for (int wanted = all ? states : FIRST, enough = 0; !enough; wanted *= 4) {
        unsymmetric_problem p = {.K = of[0],
                                 .M = of[1],
                                 .C = v->damped || v->loops > 0 ? of[2] : NULL,
                                 .B = v->inside && v->loops > 0 ? of[3] : NULL,
                                 .mass = v->c->scene->analysis[v->analysis].damping.mass,
                                 .stiffness = v->c->scene->analysis[v->analysis].damping.stiffness,
                                 .K_factor = factor,
                                 .wanted = wanted,
                                 .estimate = v->loops > 0,
                                 .decaying = v->damped || v->loops > 0};
        unsymmetric_free(r);
        const status found = poles_solve(v, &p, closed, r, &why);
        if (found == STATUS_FAULT)
            return fault_set(f, found, "%s", why.text);
        if (found != STATUS_OK && v->loops > 0)
            return fault_set(
                f, found,
                "it is not known whether the feedback loop is stable (%.150s); use fewer elements",
                why.text);
        enough = all || found != STATUS_OK || r->count < wanted ||
                 hypot(r->growth[r->count - 1], r->frequency[r->count - 1]) > 2 * PI * below;
    }
    return STATUS_OK;
}

/* Finds the frequencies of damped modes if K is unsymmetric or the damping is gyroscopic. In these
 * cases, undamped frequencies may be far from the peaks of responses. */
static status find_damped(vibration *v, harmonic_modes *m, double below, unsymmetric_result *r,
                          fault *f)
{
    fault why = {""};
    sparse closed[4] = {{0}};
    const sparse *const own[] = {&m->K, &m->M, &m->C, &m->B}, *const with[] = {
                                                                  &closed[0], &closed[1],
                                                                  &closed[2], &closed[3]};
    const sparse *const *of = v->loops > 0 ? with : own;
    m->n = v->free;
    TRY(harmonic_modes_blocks(v, m, f));
    status outcome = v->loops > 0 ? loops_close(v, own, closed, f) : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = factor_alloc(of[0], &m->factor, f);
    if (outcome == STATUS_OK) {
        v->c->run->counters.factorisations++;
        if (factor_numeric(m->factor, of[0], &why) == STATUS_OK)
            outcome = find_damped_of(v, of, closed, m->factor, below, r, f);
        else if (v->loops > 0)
            outcome = fault_set(f, STATUS_REFUSED,
                                "it is not known whether the feedback loop is stable, because one "
                                "motion has no stiffness; support it by a soft spring, or give the "
                                "feedback a proportional gain%s",
                                poles_integrals(v) > 0 ? one_each : "");
    }
    loops_release(closed);
    return outcome;
}

static status damped_frequencies(vibration *v, double below, int *count, double **hertz, fault *f)
{
    harmonic_modes *m = calloc(1, sizeof *m);
    unsymmetric_result r = {0};
    status outcome = m != NULL ? find_damped(v, m, below, &r, f) : no_memory(f);
    *hertz = calloc((size_t)r.count + 1, sizeof **hertz);
    for (int i = 0; *hertz != NULL && i < r.count; i++) {
        int at = *count;
        if (r.frequency[i] <= 0)
            continue;
        for (; at > 0 && (*hertz)[at - 1] > r.frequency[i] / (2 * PI); at--)
            (*hertz)[at] = (*hertz)[at - 1];
        (*hertz)[at] = r.frequency[i] / (2 * PI);
        ++*count;
    }
    if (outcome == STATUS_OK && *hertz == NULL)
        outcome = no_memory(f);
    unsymmetric_free(&r);
    harmonic_modes_free(m);
    return outcome;
}

static int grows(const vibration *v, const unsymmetric_result *r, int i)
{
    return r->growth[i] > (v->about != NULL ? 1e-7 : 1e-9) * r->frequency[i];
}

status harmonic_check_growth(vibration *v, double below, fault *f)
{
    const scene *s = v->c->scene;
    harmonic_modes *m = NULL;
    unsymmetric_result r = {0};
    int circulates = 0;
    double growth = 0;
    for (int i = 0; i < s->springs; i++)
        circulates |= scene_spring_circulates(&s->spring[i]);
    if (v->loops == 0 &&
        ((!circulates && v->about == NULL && !v->rotates) || s->analysis[v->analysis].by_modes))
        return STATUS_OK;
    m = calloc(1, sizeof *m);
    status outcome = m != NULL ? find_damped(v, m, below, &r, f) : no_memory(f);
    if (outcome == STATUS_OK && r.lost > 0)
        outcome = fault_set(f, STATUS_NOT_CONVERGED,
                            "it is not known whether vibrations decay, because a slow mode is lost "
                            "in round-off; use "
                            "fewer elements or, with feedback, larger integral gains or none");
    for (int i = 0; i < r.count; i++)
        if (grows(v, &r, i) &&
            (v->about == NULL || hypot(r.growth[i], r.frequency[i]) <= 2 * PI * below))
            growth = fmax(growth, r.growth[i]);
    unsymmetric_free(&r);
    harmonic_modes_free(m);
    if (v->loops > 0 && 2 * v->free > ALL_STATES && v->c->result->reason[0] == '\0')
        snprintf(v->c->result->reason, sizeof v->c->result->reason,
                 "the stability of the feedback loop is known only up to %.4g Hz", below);
    if (outcome != STATUS_OK || growth == 0)
        return outcome;
    if (v->about != NULL) { /* growth about a state during a motion is not a loss of stability */
        if (v->c->result->reason[0] == '\0')
            snprintf(v->c->result->reason, sizeof v->c->result->reason,
                     "with the coefficients at %g s, a mode grows at %.4g 1/s, so the responses "
                     "are transfer functions and not steady vibrations",
                     v->about->time, growth);
        return STATUS_OK;
    }
    if (v->rotates)
        return fault_set(f, STATUS_REFUSED,
                         "there are no steady vibrations, because a mode grows at %.4g 1/s; reduce "
                         "the angular velocity, or the damping, which rotates with the structure "
                         "and can make whirl grow",
                         growth);
    return fault_set(f, STATUS_REFUSED,
                     "there are no steady vibrations, because a mode grows at %.4g 1/s (see modal: "
                     "{damped: yes}); add damping, or reduce %s",
                     growth, v->loops > 0 ? "gains of feedback" : "cross terms of springs");
}

static int is_unsymmetric(const vibration *v)
{
    const scene *s = v->c->scene;
    if (v->loops > 0 || v->about != NULL || v->rotates)
        return 1;
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_circulates(&s->spring[i]) || scene_spring_gyrates(&s->spring[i]))
            return 1;
    return 0;
}

status harmonic_natural(vibration *v, double below, int *count, double **hertz, fault *f)
{
    const double square = pow(2 * PI * below, 2);
    status outcome = STATUS_OK;
    *count = 0;
    *hertz = NULL;
    if (is_unsymmetric(v))
        return damped_frequencies(v, below, count, hertz, f);
    for (int wanted = 16, enough = 0; outcome == STATUS_OK && !enough; wanted *= 4) {
        fault why = {""};
        harmonic_modes *m = calloc(1, sizeof *m);
        if (m == NULL)
            return no_memory(f);
        outcome = harmonic_modes_lowest(v, m, wanted, &why);
        enough = outcome == STATUS_REFUSED || m->complete || m->least - m->shift > square;
        if (outcome == STATUS_OK && enough)
            outcome = take_frequencies(m, count, hertz, f);
        else if (outcome == STATUS_REFUSED)
            outcome = STATUS_OK;
        else if (outcome != STATUS_OK)
            fault_set(f, outcome, "%s", why.text);
        harmonic_modes_free(m);
    }
    return outcome;
}

static void note_growth(const vibration *v, const unsymmetric_result *r, outcome_spectrum *out)
{
    solve_result *to = v->c->result;
    for (int i = 0; i < r->count; i++)
        if (v->about == NULL || grows(v, r, i))
            out->growth = fmax(out->growth, r->growth[i]);
    if (!(out->growth > 0) || to->reason[0] != '\0')
        return;
    if (v->about != NULL)
        snprintf(to->reason, sizeof to->reason,
                 "with the coefficients at %g s, a mode grows at %.4g 1/s", v->about->time,
                 out->growth);
    else
        snprintf(to->reason, sizeof to->reason, "unstable: a damped mode grows at %.4g 1/s",
                 out->growth);
}

static void write_instant(const vibration *v, size_t size, char out[])
{
    const scene_analysis *a = &v->c->scene->analysis[v->analysis];
    snprintf(out, size, "coefficients at %g s, %s%.40s", v->about->time,
             a->axes_of != SCENE_NONE        ? "axes of "
             : a->axes == SCENE_TURNING_NONE ? "fixed axes"
                                             : "axes of the nodes",
             a->axes_of != SCENE_NONE ? scene_name(v->c->scene, SCENE_NODES, a->axes_of).text : "");
}

/* Finds modes with the factors of K. closed: matrices with closed loops, whose integrals follow the
 * coordinates; NULL: no loop is closed. */
static status find_modes_with(vibration *v, const sparse *const of[], matrix_factor *factor,
                              sparse closed[], unsymmetric_result *r, fault *f)
{
    analysis_context *c = v->c;
    fault why = {""};
    c->run->counters.factorisations++;
    const status factored = factor_numeric(factor, of[0], &why);
    if (factored == STATUS_SINGULAR)
        return fault_set(
            f, STATUS_REFUSED,
            "damped modes require stiffness in every direction, but the structure can move freely "
            "in one direction; hold it, or support it by a soft spring%s%s",
            closed != NULL ? ", or give feedback a proportional gain" : "",
            poles_integrals(v) > 0 ? one_each : "");
    if (factored != STATUS_OK)
        return fault_set(f, factored, "%s", why.text);
    unsymmetric_problem p = {.K = of[0],
                             .M = of[1],
                             .C = of[2],
                             .B = v->inside ? of[3] : NULL,
                             .mass = c->scene->analysis[v->analysis].damping.mass,
                             .stiffness = c->scene->analysis[v->analysis].damping.stiffness,
                             .K_factor = factor,
                             .wanted = modal_wanted(c, v->analysis),
                             .estimate = 1,
                             .decaying = 1};
    const status found = poles_solve(v, &p, closed, r, &why);
    return found == STATUS_OK
               ? found
               : fault_set(f, found, "%.200s%s", why.text,
                           closed != NULL ? "; if there is feedback, use fewer elements" : "");
}

static void shorten(unsymmetric_result *r, int n)
{
    for (int i = 1; i < r->count && n < r->n; i++)
        memmove(r->mode + (size_t)i * (size_t)n, r->mode + (size_t)i * (size_t)r->n,
                (size_t)n * sizeof *r->mode);
    r->n = n;
}

static status find_closed_modes(vibration *v, const sparse *const of[], unsymmetric_result *r,
                                fault *f)
{
    sparse closed[4] = {{0}};
    const sparse *const with[] = {&closed[0], &closed[1], &closed[2], &closed[3]};
    status outcome = loops_close(v, of, closed, f);
    if (outcome == STATUS_OK)
        outcome = factor_alloc(&closed[0], &v->factor, f);
    if (outcome == STATUS_OK)
        outcome = find_modes_with(v, with, v->factor, closed, r, f);
    shorten(r, of[0]->n);
    loops_release(closed);
    return outcome;
}

static status find_modes(vibration *v, unsymmetric_result *r, fault *f)
{
    const model_size size = model_sizes(v->c->model);
    const sparse *const of[] = {&v->K, &v->M, &v->C, &v->B};
    v->state = kinematics_rest(v->c->model);
    v->room = calloc((size_t)model_stresses(v->c->model) + (size_t)(size.free + size.driven) + 1,
                     sizeof *v->room);
    if (v->room == NULL)
        return no_memory(f);
    TRY(harmonic_matrices(v, 0, f));
    TRY(loops_find(v, f));
    if (v->loops > 0)
        return find_closed_modes(v, of, r, f);
    TRY(factor_alloc(&v->K, &v->factor, f));
    return find_modes_with(v, of, v->factor, NULL, r, f);
}

static void advise(outcome_side *to)
{
    const size_t used = strlen(to->reason);
    snprintf(to->reason + used, sizeof to->reason - used, ", or larger integral gains");
}

status damped_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    unsymmetric_result r = {0};
    outcome_spectrum *out = &o->left.spectrum;
    const status outcome = find_modes(&v, &r, f);
    if (outcome == STATUS_OK) {
        note_growth(&v, &r, out);
        out->positive.growth = r.growth;
        flutter_take(&r, &out->positive);
        if (v.loops > 0 && out->positive.status == STATUS_NOT_CONVERGED)
            advise(&out->positive);
        snprintf(out->meaning, sizeof out->meaning, "%s%s%s", v.damped ? "damped" : "",
                 v.damped && v.loops > 0 ? ", " : "", v.loops > 0 ? "loop closed" : "");
        if (v.about != NULL)
            write_instant(&v, sizeof out->meaning, out->meaning);
    }
    unsymmetric_free(&r);
    harmonic_release(&v);
    return outcome;
}
