/* Motions advanced step by step, for tests of the integrators. */
#ifndef BEAMWORK_TEST_FLYING_H
#define BEAMWORK_TEST_FLYING_H

#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time_impl.h"

typedef struct flying {
    formulation chosen;
    solve_options options;
    solve_result result;
    analysis_context c;
    model *m;
    run_state run;
    context_work kept;
    frame_masses masses;
    outer_work work;
    run_damping damping;
    motion_scheme *scheme;
    motion_state now, next;
    double error; /* estimated error of the last step */
    fault why;
} flying;

static inline status flying_begin(const scene *s, const element_type *type, int elements, flying *f)
{
    memset(f, 0, sizeof *f);
    formulation_default(type, &f->chosen);
    const model_request wanted = {
        .scene = s, .type = type, .options = f->chosen.option, .elements = elements};
    TRY(model_alloc(&wanted, &f->m, &f->why));
    TRY(run_state_begin(&f->run, f->m, 1, &f->why));
    f->c = (analysis_context){.scene = s,
                              .model = f->m,
                              .run = &f->run,
                              .options = &f->options,
                              .result = &f->result,
                              .work = &f->kept};
    f->c.eq = (equations){f->m, loading_of(f->m, 0), &f->run};
    const scene_motion *how = scene_motion_of(&s->analysis[0]);
    TRY(frame_masses_alloc(f->m, &f->masses, &f->why));
    TRY(damping_begin(&f->c.eq, &f->damping, &f->why));
    TRY(work_alloc(&f->c.eq, &f->masses, &f->work, &f->why));
    const scheme_request request = {
        .c = &f->c, .masses = &f->masses, .how = how, .work = &f->work, .estimate = 1};
    TRY(integrator_alloc(&request, &f->scheme, &f->why));
    TRY(motion_state_alloc(f->m, &f->now, &f->why));
    TRY(motion_state_alloc(f->m, &f->next, &f->why));
    return initial_conditions(&f->c, &f->masses, how, &f->now, &f->next, &f->why);
}

static inline void flying_end(flying *f)
{
    damping_end(&f->c.eq, &f->damping);
    integrator_free(f->scheme);
    motion_state_free(&f->now);
    motion_state_free(&f->next);
    frame_masses_free(&f->masses);
    work_free(&f->work);
    result_free(&f->result);
    run_state_end(&f->run);
    model_free(f->m);
}

/* Makes one step of h [s], backwards if h < 0, and stores the result in `next`. */
static inline status flying_try(flying *f, double h)
{
    step_record record = {.path = f->now.time + h, .increment = h};
    const status outcome =
        f->scheme->step(f->scheme, &f->now, h, &f->next, &f->error, &record, &f->why);
    history_drop_step(&f->result, &record);
    f->next.time = record.path;
    return outcome;
}

/* Makes the step of flying_try. `now` becomes `next` unless the step fails. */
static inline status flying_step(flying *f, double h)
{
    const status outcome = flying_try(f, h);
    if (outcome == STATUS_OK)
        motion_state_copy(f->m, &f->next, &f->now);
    return outcome;
}

static inline size_t flying_numbers(const flying *f, const motion_state *at, double *numbers)
{
    const size_t n = (size_t)model_all_coordinates(f->m), size = at->state->size,
                 rates = at->strain != NULL
                             ? 2 * (size_t)(model_elements(f->m) * model_strains(f->m))
                             : 0,
                 ends = motion_state_ends(f->m);
    if (numbers != NULL) {
        memcpy(numbers, at->v, n * sizeof *numbers);
        memcpy(numbers + n, at->a, n * sizeof *numbers);
        memcpy(numbers + 2 * n, at->algorithm, n * sizeof *numbers);
        memcpy(numbers + 3 * n, at->state->block, size * sizeof *numbers);
        numbers[3 * n + size] = at->time;
        numbers[3 * n + size + 1] = at->work;
        numbers[3 * n + size + 2] = at->dissipated;
        numbers[3 * n + size + 3] = at->stress;
        numbers[3 * n + size + 4] = at->contraction;
        numbers[3 * n + size + 5] = at->ends_known;
        if (rates > 0)
            memcpy(numbers + 3 * n + size + 6, at->strain, rates * sizeof *numbers);
        if (ends > 0)
            memcpy(numbers + 3 * n + size + 6 + rates, at->ends, ends * sizeof *numbers);
    }
    return 3 * n + size + 6 + rates + ends;
}

/* Returns all numbers of the current instant; the caller frees them. */
static inline double *flying_all(const flying *f)
{
    double *all = malloc(flying_numbers(f, &f->now, NULL) * sizeof *all);
    flying_numbers(f, &f->now, all);
    return all;
}

#endif
