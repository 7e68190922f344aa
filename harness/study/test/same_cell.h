/* Compares two cells member by member, which ignores padding bytes. */
#ifndef BEAMWORK_TEST_SAME_CELL_H
#define BEAMWORK_TEST_SAME_CELL_H

#include <string.h>

#include "harness/study/study.h"

typedef struct difference {
    const char *name;
} difference;

static inline void compare(difference *out, const char *name, const void *a, const void *b,
                           size_t size)
{
    if (out->name == NULL && (size > 0 && (a == NULL || b == NULL || memcmp(a, b, size) != 0)))
        out->name = name;
}

#define SAME(field) compare(out, #field, &a->field, &b->field, sizeof a->field)

#define SAME_ARRAY(field, count)                                                                   \
    compare(out, #field "[]", a->field, b->field, (size_t)(count) * sizeof *a->field)

static inline void compare_text(difference *out, const char *name, const char *a, const char *b)
{
    compare(out, name, a, b, strlen(a) + 1);
}

static inline void compare_counts(difference *out, const cell_result *a, const cell_result *b)
{
    SAME(size.elements);
    SAME(size.vertices);
    SAME(size.free);
    SAME(size.driven);
    SAME(size.strains);
    SAME(size.inner);
    SAME(size.features);
    SAME(mass);
    SAME(counters);
    SAME(left_out_lines);
    for (int i = 0; i < a->left_out_lines && out->name == NULL; i++)
        compare_text(out, "left_out", a->left_out[i], b->left_out[i]);
}

static inline void compare_quantity(difference *out, const quantity_result *a,
                                    const quantity_result *b)
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

static inline void compare_step(difference *out, const step_record *a, const step_record *b)
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

static inline void compare_iteration(difference *out, const iteration_record *a,
                                     const iteration_record *b)
{
    SAME(residual);
    SAME(correction);
    SAME(incompatibility);
}

static inline void compare_event(difference *out, const path_event *a, const path_event *b)
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

static inline void compare_motion(difference *out, const motion_record *a, const motion_record *b)
{
    SAME(analysis);
    SAME(at.time);
    SAME(at.step);
    SAME(at.error);
    SAME(at.iterations);
    SAME(at.rejected);
    SAME(at.balance);
}

static inline void compare_matrices(difference *out, const nodal_matrices *a,
                                    const nodal_matrices *b)
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

static inline void compare_state(difference *out, const shape_state *a, const shape_state *b)
{
    SAME(kind);
    SAME(analysis);
    SAME(value);
    SAME(scale);
}

static inline void compare_point(difference *out, const centreline_point *a,
                                 const centreline_point *b)
{
    SAME(r);
    SAME(q);
    SAME(force);
    SAME(moment);
    SAME(bimoment);
}

static inline void compare_shapes(difference *out, const shapes *a, const shapes *b)
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

static inline void compare_solution(difference *out, const solve_result *a, const solve_result *b)
{
    SAME(status);
    compare_text(out, "reason", a->reason, b->reason);
    SAME(quantities);
    SAME(steps);
    SAME(iterations);
    SAME(matrix_sets);
    SAME(events);
    SAME(motions);
    SAME(seconds_setup);
    SAME(seconds_solve);
    SAME(phase);
    if (out->name != NULL)
        return;
    for (int i = 0; i < a->quantities; i++)
        compare_quantity(out, &a->quantity[i], &b->quantity[i]);
    for (int i = 0; i < a->steps; i++)
        compare_step(out, &a->step[i], &b->step[i]);
    for (int i = 0; i < a->iterations; i++)
        compare_iteration(out, &a->iteration[i], &b->iteration[i]);
    for (int i = 0; i < a->events; i++)
        compare_event(out, &a->event[i], &b->event[i]);
    for (int i = 0; i < a->motions; i++)
        compare_motion(out, &a->motion[i], &b->motion[i]);
    for (int i = 0; i < a->matrix_sets; i++)
        compare_matrices(out, &a->matrices[i], &b->matrices[i]);
    compare_shapes(out, &a->shapes, &b->shapes);
}

static inline difference compare_cells(const cell_result *a, const cell_result *b)
{
    difference out = {NULL};
    compare_counts(&out, a, b);
    compare_solution(&out, &a->solve, &b->solve);
    return out;
}

#undef SAME
#undef SAME_ARRAY

#endif
