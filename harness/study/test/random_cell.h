/* Makes cells whose members all have random contents, including special numbers and bytes. */
#ifndef BEAMWORK_TEST_RANDOM_CELL_H
#define BEAMWORK_TEST_RANDOM_CELL_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

typedef struct random_source {
    uint64_t state;
} random_source;

static inline uint64_t roll(random_source *d)
{
    d->state ^= d->state << 13;
    d->state ^= d->state >> 7;
    d->state ^= d->state << 17;
    return d->state;
}

static inline int whole(random_source *d, int most)
{
    return (int)(roll(d) % (uint64_t)(most + 1));
}

static inline double number(random_source *d)
{
    static const double odd[] = {0, -0.0, INFINITY, -INFINITY, NAN, 5e-324, 1.7e308};
    const int which = whole(d, 30);
    return which < 7 ? odd[which] : ldexp((double)(int64_t)roll(d), whole(d, 200) - 160);
}

static inline void fill(random_source *d, size_t count, double value[])
{
    for (size_t i = 0; i < count; i++)
        value[i] = number(d);
}

static inline double *numbers(random_source *d, size_t count)
{
    double *out = calloc(count + 1, sizeof *out);
    fill(d, count, out);
    return out;
}

/* Makes a random text of any length, without a zero byte before its end. */
static inline void fill_text(random_source *d, size_t size, char text[])
{
    const size_t length = (size_t)whole(d, (int)size - 1);
    for (size_t i = 0; i < length; i++)
        text[i] = (char)(1 + whole(d, 254));
    text[length] = '\0';
}

static inline void fill_counts(random_source *d, cell_result *c)
{
    int *const size[] = {&c->size.elements, &c->size.vertices, &c->size.free, &c->size.driven,
                         &c->size.strains,  &c->size.inner,    &c->size.kinds};
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++)
        *size[i] = whole(d, 1 << 30);
    c->size.features = (unsigned)roll(d);
    for (size_t at = 0; at < sizeof c->counters; at += sizeof(uint64_t)) {
        const uint64_t bits = roll(d);
        memcpy((char *)&c->counters + at, &bits, sizeof bits);
    }
}

static inline void fill_quantities(random_source *d, solve_result *s)
{
    s->quantities = 1 + whole(d, 5);
    s->quantity = calloc((size_t)s->quantities, sizeof *s->quantity);
    for (int i = 0; i < s->quantities; i++) {
        quantity_result *q = &s->quantity[i];
        q->status = (status)whole(d, STATUS_NO_VALUE);
        q->value = number(d);
        q->x = number(d);
        q->curve.points = i % 2 == 0 ? 1 + whole(d, 8) : 0;
        q->curve.x = i % 2 == 0 ? numbers(d, (size_t)q->curve.points) : NULL;
        q->curve.value = i % 2 == 0 ? numbers(d, (size_t)q->curve.points) : NULL;
        fill_text(d, sizeof q->reason, q->reason);
    }
}

static inline void fill_steps(random_source *d, solve_result *s)
{
    s->steps = 1 + whole(d, 4);
    s->iterations = 1 + whole(d, 9);
    s->step = calloc((size_t)s->steps, sizeof *s->step);
    s->iteration = calloc((size_t)s->iterations, sizeof *s->iteration);
    for (int i = 0; i < s->steps; i++)
        s->step[i] = (step_record){.path = number(d),
                                   .increment = number(d),
                                   .iterations = whole(d, 99),
                                   .rejected = whole(d, 99),
                                   .negative_pivots = whole(d, 99),
                                   .by_eigenvalues = whole(d, 1),
                                   .passed = whole(d, 9),
                                   .stability = (step_stability)whole(d, STEP_STABILITIES),
                                   .residual = number(d),
                                   .correction = number(d),
                                   .incompatibility = number(d),
                                   .remaining = number(d),
                                   .first = whole(d, 99),
                                   .energy = number(d)};
    for (int i = 0; i < s->iterations; i++)
        s->iteration[i] = (iteration_record){
            .residual = number(d), .correction = number(d), .incompatibility = number(d)};
}

static inline void fill_motion(random_source *d, solve_result *s)
{
    s->motions = 1 + whole(d, 3);
    s->motion = calloc((size_t)s->motions, sizeof *s->motion);
    for (int i = 0; i < s->motions; i++) {
        outcome_step *at = &s->motion[i].at;
        *at = (outcome_step){number(d), number(d), number(d), whole(d, 9), whole(d, 9), {0}};
        fill(d, SCENE_BALANCES, at->balance);
        s->motion[i].analysis = whole(d, 9);
    }
}

static inline void fill_events(random_source *d, solve_result *s)
{
    s->events = 1 + whole(d, 3);
    s->event = calloc((size_t)s->events, sizeof *s->event);
    for (int i = 0; i < s->events; i++)
        s->event[i] = (path_event){.kind = (event_kind)whole(d, EVENT_KINDS - 1),
                                   .analysis = whole(d, 9),
                                   .negative_before = whole(d, 9) - 1,
                                   .negative_after = whole(d, 9) - 1,
                                   .factor = number(d),
                                   .control = number(d),
                                   .other_factor = number(d),
                                   .measure = number(d),
                                   .factor_error = number(d),
                                   .control_error = number(d)};
}

static inline void fill_matrices(random_source *d, solve_result *s)
{
    s->matrix_sets = 1 + whole(d, 2);
    s->matrices = calloc((size_t)s->matrix_sets, sizeof *s->matrices);
    for (int i = 0; i < s->matrix_sets; i++) {
        nodal_matrices *m = &s->matrices[i];
        m->node = whole(d, 99);
        m->moments = (scene_moments)whole(d, 2);
        m->stations = 1 + whole(d, 3);
        m->path = numbers(d, (size_t)m->stations);
        m->compliance = numbers(d, 36 * (size_t)m->stations);
        m->stiffness = numbers(d, 36 * (size_t)m->stations);
    }
}

static inline void fill_shapes(random_source *d, shapes *s)
{
    *s = (shapes){.states = 1 + whole(d, 2),
                  .members = 1 + whole(d, 2),
                  .points = 1 + whole(d, 4),
                  .nodes = 1 + whole(d, 3)};
    gsl_test(shapes_alloc(s, NULL) != STATUS_OK, "memory for the shapes");
    for (int i = 0; i <= s->members; i++)
        s->first[i] = whole(d, 99);
    for (int i = 0; i < s->states; i++)
        s->state[i] = (shape_state){.kind = (shape_kind)whole(d, SHAPE_MODE),
                                    .analysis = whole(d, 9),
                                    .value = number(d),
                                    .scale = number(d)};
    for (int i = 0; i < s->states * s->points; i++) {
        centreline_point *p = &s->point[i];
        fill(d, 3, p->r);
        fill(d, 4, p->q);
        fill(d, 3, p->force);
        fill(d, 3, p->moment);
        p->bimoment = number(d);
    }
    fill(d, 3 * (size_t)s->states * (size_t)s->nodes, s->node);
}

static inline void fill_left_out(random_source *d, cell_result *c)
{
    c->left_out_lines = 1 + whole(d, 3);
    c->left_out = calloc((size_t)c->left_out_lines, sizeof *c->left_out);
    for (int i = 0; i < c->left_out_lines; i++) {
        c->left_out[i] = calloc(200, 1);
        fill_text(d, 200, c->left_out[i]);
    }
}

/* Returns a random cell, which the caller frees with cell_result_free. */
static inline cell_result random_cell(random_source *d)
{
    cell_result c = {.size = {0}};
    solve_result *s = &c.solve;
    fill_counts(d, &c);
    fill_left_out(d, &c);
    s->status = (status)whole(d, STATUS_NO_VALUE);
    fill_text(d, sizeof s->reason, s->reason);
    fill_quantities(d, s);
    fill_steps(d, s);
    fill_events(d, s);
    fill_motion(d, s);
    fill_matrices(d, s);
    fill_shapes(d, &s->shapes);
    s->seconds_setup = number(d);
    s->seconds_solve = number(d);
    fill(d, PHASES, s->phase);
    return c;
}

/* Checks that every member is filled. If this check fails, a struct has a new member that must be
 * added above. */
static inline void random_cell_complete(void)
{
    gsl_test_int((int)(sizeof(counters) % sizeof(uint64_t)), 0, "counters are filled by words");
    gsl_test_int((int)sizeof(model_size), 8 * (int)sizeof(int), "sizes as filled above");
    gsl_test_int((int)sizeof(step_record), (int)(7 * sizeof(double) + 10 * sizeof(int)),
                 "steps as filled above");
    gsl_test_int((int)sizeof(iteration_record), (int)(3 * sizeof(double)),
                 "iterations as filled above");
    gsl_test_int((int)sizeof(path_event), (int)(6 * sizeof(double) + 4 * sizeof(int)),
                 "events as filled above");
    gsl_test_int((int)sizeof(outcome_step),
                 (int)((3 + SCENE_BALANCES) * sizeof(double) + 2 * sizeof(int)),
                 "steps of motions as filled above");
    gsl_test_int((int)sizeof(centreline_point), (int)(14 * sizeof(double)),
                 "points as filled above");
    gsl_test_int((int)sizeof(shape_state), (int)(2 * sizeof(double) + 2 * sizeof(int)),
                 "states as filled above");
}

#endif
