/* Damped modes: the eigenvectors of the dynamic stiffness D (harmonic_matrices.c) at s = i w. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for damped modes");
}

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

/* Frequencies of damped modes. K unsymmetric, or gyroscopic damping: those without damping, if
 * there are any, may be far from all peaks. */
static status find_damped(vibration *v, harmonic_modes *m, double below, unsymmetric_result *r,
                          fault *f)
{
    fault why = {""};
    m->n = v->free;
    TRY(harmonic_modes_blocks(v, m, f));
    TRY(factor_alloc(&m->K, &m->factor, f));
    v->c->run->counters.factorisations++;
    if (factor_numeric(m->factor, &m->K, &why) != STATUS_OK)
        return STATUS_OK;
    for (int wanted = 16, enough = 0; !enough; wanted *= 4) {
        const unsymmetric_problem p = {.K = &m->K,
                                       .M = &m->M,
                                       .C = v->damped ? &m->C : NULL,
                                       .K_factor = m->factor,
                                       .wanted = wanted,
                                       .decaying = v->damped};
        unsymmetric_free(r);
        const status found = unsymmetric_solve(&p, r, &why);
        v->c->run->counters.solutions += r->solutions;
        if (found == STATUS_FAULT)
            return fault_set(f, found, "%s", why.text);
        enough = found != STATUS_OK || r->count < wanted ||
                 hypot(r->growth[r->count - 1], r->frequency[r->count - 1]) > 2 * PI * below;
    }
    return STATUS_OK;
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

status harmonic_judge_springs(vibration *v, double below, fault *f)
{
    const scene *s = v->c->scene;
    harmonic_modes *m = NULL;
    unsymmetric_result r = {0};
    int circulates = 0;
    double growth = 0;
    for (int i = 0; i < s->springs; i++)
        circulates |= scene_spring_circulates(&s->spring[i]);
    if (!circulates || s->analysis[v->analysis].by_modes)
        return STATUS_OK;
    m = calloc(1, sizeof *m);
    const status outcome = m != NULL ? find_damped(v, m, below, &r, f) : no_memory(f);
    for (int i = 0; i < r.count; i++)
        if (r.growth[i] > 1e-9 * r.frequency[i])
            growth = fmax(growth, r.growth[i]);
    unsymmetric_free(&r);
    harmonic_modes_free(m);
    if (outcome != STATUS_OK || growth == 0)
        return outcome;
    return fault_set(f, STATUS_REFUSED,
                     "nothing vibrates steadily, because a mode grows with %.4g 1/s: see modal: "
                     "{damped: yes}; add damping, or make cross terms of springs smaller",
                     growth);
}

static int is_unsymmetric(const scene *s)
{
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
    if (is_unsymmetric(v->c->scene))
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

static void note_growth(analysis_context *c, const unsymmetric_result *r, outcome_spectrum *out)
{
    for (int i = 0; i < r->count; i++)
        out->growth = fmax(out->growth, r->growth[i]);
    if (out->growth > 0 && c->result->reason[0] == '\0')
        snprintf(c->result->reason, sizeof c->result->reason,
                 "unstable: a damped mode grows at %.4g 1/s", out->growth);
}

static status find_modes(vibration *v, unsymmetric_result *r, fault *f)
{
    analysis_context *c = v->c;
    const model_size size = model_sizes(c->model);
    fault why = {""};
    v->state = kinematics_rest(c->model);
    v->room = calloc((size_t)model_stresses(c->model) + (size_t)(size.free + size.driven) + 1,
                     sizeof *v->room);
    if (v->room == NULL)
        return no_memory(f);
    TRY(harmonic_matrices(v, 0, f));
    TRY(factor_alloc(&v->K, &v->factor, f));
    c->run->counters.factorisations++;
    const status factored = factor_numeric(v->factor, &v->K, &why);
    if (factored == STATUS_SINGULAR)
        return fault_set(f, STATUS_REFUSED,
                         "damped modes require stiffness against every motion, but one motion has "
                         "none: hold the structure, or support it by a soft spring");
    if (factored != STATUS_OK)
        return fault_set(f, factored, "%s", why.text);
    const unsymmetric_problem p = {.K = &v->K,
                                   .M = &v->M,
                                   .C = &v->C,
                                   .B = v->inside ? &v->B : NULL,
                                   .mass = c->scene->analysis[v->analysis].damping.mass,
                                   .stiffness = c->scene->analysis[v->analysis].damping.stiffness,
                                   .K_factor = v->factor,
                                   .wanted = modal_wanted(c, v->analysis),
                                   .estimate = 1,
                                   .decaying = 1};
    const status found = unsymmetric_solve(&p, r, f);
    c->run->counters.solutions += r->solutions;
    return found;
}

status damped_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    unsymmetric_result r = {0};
    outcome_spectrum *out = &o->left.spectrum;
    const status outcome = find_modes(&v, &r, f);
    if (outcome == STATUS_OK) {
        note_growth(c, &r, out);
        out->positive.growth = r.growth;
        flutter_take(&r, &out->positive);
        snprintf(out->meaning, sizeof out->meaning, "%s", v.damped ? "damped" : "");
    }
    unsymmetric_free(&r);
    harmonic_release(&v);
    return outcome;
}
