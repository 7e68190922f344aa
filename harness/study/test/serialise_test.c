/* A cell's result on its way between processes: everything arrives as it was sent, bit for bit, and nothing that is cut short is
 * believed. What is compared are the fields, whatever the bytes between look like. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/serialise.h"

typedef struct dice {
    uint64_t state;
} dice;

static uint64_t roll(dice *d)
{
    d->state ^= d->state << 13;
    d->state ^= d->state >> 7;
    d->state ^= d->state << 17;
    return d->state;
}

static int whole(dice *d, int most)
{
    return (int)(roll(d) % (uint64_t)(most + 1));
}

/* Any number, the odd ones among them. */
static double number(dice *d)
{
    static const double odd[] = {0, -0.0, INFINITY, -INFINITY, NAN, 5e-324, 1.7e308};
    const int which = whole(d, 30);
    return which < 7 ? odd[which] : ldexp((double)(int64_t)roll(d), whole(d, 200) - 160);
}

static void fill(dice *d, size_t count, double value[])
{
    for (size_t i = 0; i < count; i++)
        value[i] = number(d);
}

static double *numbers(dice *d, size_t count)
{
    double *out = calloc(count + 1, sizeof *out);
    fill(d, count, out);
    return out;
}

/* No zero byte before the end, of any length. */
static void fill_text(dice *d, size_t size, char text[])
{
    const size_t length = (size_t)whole(d, (int)size - 1);
    for (size_t i = 0; i < length; i++)
        text[i] = (char)(1 + whole(d, 254));
    text[length] = '\0';
}

static void fill_counts(dice *d, cell_result *c)
{
    int *const size[] = {&c->size.elements, &c->size.vertices, &c->size.free,
                         &c->size.driven,   &c->size.strains,  &c->size.inner};
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++)
        *size[i] = whole(d, 1 << 30);
    c->size.features = (unsigned)roll(d);
    /* any bits: also of counters that are new */
    for (size_t at = 0; at < sizeof c->counters; at += sizeof(uint64_t)) {
        const uint64_t bits = roll(d);
        memcpy((char *)&c->counters + at, &bits, sizeof bits);
    }
}

static void fill_quantities(dice *d, solve_result *s)
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

static void fill_steps(dice *d, solve_result *s)
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
                                   .residual = number(d),
                                   .correction = number(d),
                                   .incompatibility = number(d),
                                   .first = whole(d, 99),
                                   .energy = number(d)};
    for (int i = 0; i < s->iterations; i++)
        s->iteration[i] = (iteration_record){
            .residual = number(d), .correction = number(d), .incompatibility = number(d)};
}

static void fill_events(dice *d, solve_result *s)
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
                                   .measure = number(d)};
}

static void fill_matrices(dice *d, solve_result *s)
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

static void fill_shapes(dice *d, shapes *s)
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

static void fill_left_out(dice *d, cell_result *c)
{
    c->left_out_lines = 1 + whole(d, 3);
    c->left_out = calloc((size_t)c->left_out_lines, sizeof *c->left_out);
    for (int i = 0; i < c->left_out_lines; i++) {
        c->left_out[i] = calloc(200, 1);
        fill_text(d, 200, c->left_out[i]);
    }
}

/* Owned by cell_result_free. */
static cell_result random_cell(dice *d)
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
    fill_matrices(d, s);
    fill_shapes(d, &s->shapes);
    s->seconds_setup = number(d);
    s->seconds_solve = number(d);
    fill(d, PHASES, s->phase);
    return c;
}

/* What differs, by name; the first one is kept. */
typedef struct difference {
    const char *name;
} difference;

static void compare(difference *out, const char *name, const void *a, const void *b, size_t size)
{
    if (out->name == NULL && (size > 0 && (a == NULL || b == NULL || memcmp(a, b, size) != 0)))
        out->name = name;
}

#define SAME(field) compare(out, #field, &a->field, &b->field, sizeof a->field)
#define SAME_ARRAY(field, count)                                                                   \
    compare(out, #field "[]", a->field, b->field, (size_t)(count) * sizeof *a->field)

static void compare_text(difference *out, const char *name, const char *a, const char *b)
{
    compare(out, name, a, b, strlen(a) + 1);
}

static void compare_counts(difference *out, const cell_result *a, const cell_result *b)
{
    SAME(size.elements);
    SAME(size.vertices);
    SAME(size.free);
    SAME(size.driven);
    SAME(size.strains);
    SAME(size.inner);
    SAME(size.features);
    SAME(counters);
    SAME(left_out_lines);
    for (int i = 0; i < a->left_out_lines && out->name == NULL; i++)
        compare_text(out, "left_out", a->left_out[i], b->left_out[i]);
}

static void compare_quantity(difference *out, const quantity_result *a, const quantity_result *b)
{
    SAME(status);
    SAME(value);
    SAME(x);
    SAME(curve.points);
    compare_text(out, "quantity.reason", a->reason, b->reason);
    if (out->name == NULL) {
        SAME_ARRAY(curve.x, a->curve.points);
        SAME_ARRAY(curve.value, a->curve.points);
    }
}

static void compare_step(difference *out, const step_record *a, const step_record *b)
{
    SAME(path);
    SAME(increment);
    SAME(iterations);
    SAME(rejected);
    SAME(negative_pivots);
    SAME(residual);
    SAME(correction);
    SAME(incompatibility);
    SAME(first);
    SAME(energy);
}

static void compare_iteration(difference *out, const iteration_record *a, const iteration_record *b)
{
    SAME(residual);
    SAME(correction);
    SAME(incompatibility);
}

static void compare_event(difference *out, const path_event *a, const path_event *b)
{
    SAME(kind);
    SAME(analysis);
    SAME(negative_before);
    SAME(negative_after);
    SAME(factor);
    SAME(control);
    SAME(other_factor);
    SAME(measure);
}

static void compare_matrices(difference *out, const nodal_matrices *a, const nodal_matrices *b)
{
    SAME(node);
    SAME(moments);
    SAME(stations);
    if (out->name == NULL) {
        SAME_ARRAY(path, a->stations);
        SAME_ARRAY(compliance, 36 * a->stations);
        SAME_ARRAY(stiffness, 36 * a->stations);
    }
}

static void compare_state(difference *out, const shape_state *a, const shape_state *b)
{
    SAME(kind);
    SAME(analysis);
    SAME(value);
    SAME(scale);
}

static void compare_point(difference *out, const centreline_point *a, const centreline_point *b)
{
    SAME(r);
    SAME(q);
    SAME(force);
    SAME(moment);
    SAME(bimoment);
}

static void compare_shapes(difference *out, const shapes *a, const shapes *b)
{
    SAME(states);
    SAME(members);
    SAME(points);
    SAME(nodes);
    if (out->name != NULL || a->states == 0)
        return;
    SAME_ARRAY(first, a->members + 1);
    SAME_ARRAY(node, 3 * a->states * a->nodes);
    for (int i = 0; i < a->states; i++)
        compare_state(out, &a->state[i], &b->state[i]);
    for (int i = 0; i < a->states * a->points; i++)
        compare_point(out, &a->point[i], &b->point[i]);
}

static void compare_solution(difference *out, const solve_result *a, const solve_result *b)
{
    SAME(status);
    compare_text(out, "reason", a->reason, b->reason);
    SAME(quantities);
    SAME(steps);
    SAME(iterations);
    SAME(matrix_sets);
    SAME(events);
    SAME(seconds_setup);
    SAME(seconds_solve);
    SAME(phase);
    if (out->name != NULL) /* without the same counts there is nothing to walk along */
        return;
    for (int i = 0; i < a->quantities; i++)
        compare_quantity(out, &a->quantity[i], &b->quantity[i]);
    for (int i = 0; i < a->steps; i++)
        compare_step(out, &a->step[i], &b->step[i]);
    for (int i = 0; i < a->iterations; i++)
        compare_iteration(out, &a->iteration[i], &b->iteration[i]);
    for (int i = 0; i < a->events; i++)
        compare_event(out, &a->event[i], &b->event[i]);
    for (int i = 0; i < a->matrix_sets; i++)
        compare_matrices(out, &a->matrices[i], &b->matrices[i]);
    compare_shapes(out, &a->shapes, &b->shapes);
}

static difference compare_cells(const cell_result *a, const cell_result *b)
{
    difference out = {NULL};
    compare_counts(&out, a, b);
    compare_solution(&out, &a->solve, &b->solve);
    return out;
}

/* Everything that could be forgotten must be filled: a struct that has grown (padding included) needs its new member here. */
static void complete(void)
{
    gsl_test_int((int)(sizeof(counters) % sizeof(uint64_t)), 0, "counters are filled by words");
    gsl_test_int((int)sizeof(model_size), 7 * (int)sizeof(int), "sizes as filled above");
    gsl_test_int((int)sizeof(step_record), (int)(6 * sizeof(double) + 6 * sizeof(int)),
                 "steps as filled above");
    gsl_test_int((int)sizeof(iteration_record), (int)(3 * sizeof(double)),
                 "iterations as filled above");
    gsl_test_int((int)sizeof(path_event), (int)(4 * sizeof(double) + 4 * sizeof(int)),
                 "events as filled above");
    gsl_test_int((int)sizeof(centreline_point), (int)(14 * sizeof(double)),
                 "points as filled above");
    gsl_test_int((int)sizeof(shape_state), (int)(2 * sizeof(double) + 2 * sizeof(int)),
                 "states as filled above");
}

static void round_trips(dice *d)
{
    enum { CELLS = 200 };
    cell_result sent[CELLS];
    FILE *file = tmpfile();
    int unwritten = 0, unread = 0;
    difference first = {NULL};
    for (int i = 0; i < CELLS && file != NULL; i++) {
        sent[i] = random_cell(d);
        unwritten += serialise_write(file, &sent[i]) != 0;
    }
    rewind(file);
    for (int i = 0; i < CELLS; i++) { /* one behind the other, as a worker sends them */
        cell_result got;
        unread += serialise_read(file, &got) != 0;
        const difference here = compare_cells(&sent[i], &got);
        if (first.name == NULL)
            first = here;
        cell_result_free(&got);
        cell_result_free(&sent[i]);
    }
    gsl_test_int(unwritten, 0, "cells that were not sent");
    gsl_test_int(unread, 0, "cells that did not arrive");
    gsl_test(first.name != NULL, "what arrives is what was sent (%s)",
             first.name != NULL ? first.name : "all");
    gsl_test_int(fgetc(file), EOF, "and nothing more");
    fclose(file);
}

/* The least there is: a cell that failed before it had anything. */
static void empty_cell(void)
{
    const cell_result sent = {.solve = {.status = STATUS_SINGULAR, .reason = "nothing"}};
    cell_result got;
    FILE *file = tmpfile();
    gsl_test(file == NULL || serialise_write(file, &sent) != 0, "sent");
    rewind(file);
    gsl_test(serialise_read(file, &got) != 0 || compare_cells(&sent, &got).name != NULL,
             "an empty cell arrives");
    cell_result_free(&got);
    fclose(file);
}

static int is_empty(const cell_result *c)
{
    const solve_result *s = &c->solve;
    return c->left_out == NULL && s->quantity == NULL && s->step == NULL && s->iteration == NULL &&
           s->event == NULL && s->matrices == NULL && s->shapes.first == NULL &&
           s->shapes.state == NULL && s->shapes.point == NULL && s->shapes.node == NULL;
}

/* Every truncation is noticed and leaves nothing behind, whichever part comes last. */
static void truncated(dice *d, int pictured)
{
    cell_result sent = random_cell(d), got;
    if (!pictured)
        shapes_free(&sent.solve.shapes);
    char *bytes = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&bytes, &size);
    gsl_test(file == NULL || serialise_write(file, &sent) != 0 || fclose(file) != 0, "written");
    int accepted = 0, left = 0;
    for (size_t cut = 0; cut < size; cut++) {
        file = cut > 0 ? fmemopen(bytes, cut, "rb") : fopen("/dev/null", "rb");
        accepted += serialise_read(file, &got) == 0;
        left += !is_empty(&got);
        fclose(file);
    }
    file = fmemopen(bytes, size, "rb");
    gsl_test(serialise_read(file, &got) != 0, "the whole is read");
    fclose(file);
    cell_result_free(&got);
    cell_result_free(&sent);
    free(bytes);
    gsl_test(size < 1000, "%ld bytes", (long)size);
    gsl_test_int(accepted, 0, "truncated cells that were accepted");
    gsl_test_int(left, 0, "truncated cells that left something");
}

int main(void)
{
    dice d = {88172645463325252ull};
    complete();
    round_trips(&d);
    empty_cell();
    for (int i = 0; i < 6; i++)
        truncated(&d, i % 2);
    return gsl_test_summary();
}
