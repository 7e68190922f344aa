/* A scene in motion, advanced step by step, for tests of the conserving scheme. */
#ifndef BEAMWORK_TEST_FLIGHT_H
#define BEAMWORK_TEST_FLIGHT_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time_impl.h"

typedef struct flight {
    scene scene;
    formulation chosen;
    model *m;
    run_state run;
    context_work kept;
    solve_options options;
    solve_result result;
    analysis_context c;
    scene_motion how;
    frame_masses masses;
    motion_scheme *scheme;
    motion_state now, next;
    int most, sum, steps; /* largest number of iterations in a step, sum of the iterations, and
                             number of steps */
    fault why;
} flight;

/* Prepares the scene, whose only analysis is the motion. If it is rejected or fails, `why` is the
 * reason. */
static inline status flight_prepare(flight *f, const char *with, int elements)
{
    model_request request = {&f->scene, NULL, f->chosen.option, elements, 0, 0};
    TRY(formulation_parse(with, &f->chosen, &f->why));
    request.type = f->chosen.type;
    TRY(model_alloc(&request, &f->m, &f->why));
    TRY(run_state_begin(&f->run, f->m, 1, &f->why));
    f->c = (analysis_context){.scene = &f->scene,
                              .model = f->m,
                              .run = &f->run,
                              .options = &f->options,
                              .result = &f->result,
                              .work = &f->kept};
    f->c.eq = (equations){.m = f->m, .loading = {.in_time = 1}, .run = &f->run};
    f->how = *scene_motion_of(&f->scene.analysis[f->scene.analyses - 1]);
    TRY(frame_masses_alloc(f->m, &f->masses, &f->why));
    const scheme_request requested = {.c = &f->c, .masses = &f->masses, .how = &f->how};
    TRY(conserving_alloc(&requested, &f->scheme, &f->why));
    TRY(motion_state_alloc(f->m, &f->now, &f->why));
    return motion_state_alloc(f->m, &f->next, &f->why);
}

/* Prepares a case without parameters, whose function is `build`. It starts at rest in the
 * undeformed state. */
static inline status flight_ready(flight *f,
                                  status (*build)(const double value[], scene *, fault *),
                                  const char *with, int elements)
{
    memset(f, 0, sizeof *f);
    scene_init(&f->scene, "flight");
    TRY(build(NULL, &f->scene, &f->why));
    return flight_prepare(f, with, elements);
}

static inline status flight_begin(flight *f,
                                  status (*build)(const double value[], scene *, fault *),
                                  const char *with, int elements)
{
    TRY(flight_ready(f, build, with, elements));
    return initial_conditions(&f->c, &f->masses, &f->how, &f->now, &f->next, &f->why);
}

static inline void flight_end(flight *f)
{
    if (f->scheme != NULL)
        f->scheme->free(f->scheme);
    motion_state_free(&f->now);
    motion_state_free(&f->next);
    frame_masses_free(&f->masses);
    free(f->result.iteration);
    run_state_end(&f->run);
    model_free(f->m);
    scene_free(&f->scene);
}

/* Makes one step of h [s], backwards if h < 0. */
static inline status flight_step(flight *f, double h)
{
    double error;
    step_record record = {.path = f->now.time + h, .increment = h};
    const status outcome =
        f->scheme->step(f->scheme, &f->now, h, &f->next, &error, &record, &f->why);
    if (outcome == STATUS_OK) {
        motion_state_copy(f->m, &f->next, &f->now);
        f->most = record.iterations > f->most ? record.iterations : f->most;
        f->sum += record.iterations;
        f->steps++;
    }
    history_drop_step(&f->result, &record);
    return outcome;
}

static inline double flight_strain_energy(const flight *f)
{
    const model *m = f->m;
    const model_state *s = f->now.state;
    double sum = 0, none[1] = {0};
    for (int i = 0; i < model_elements(m); i++) {
        double energy = 0;
        const double *inner = model_inner(m) > 0 ? s->inner + (size_t)(i * model_inner(m)) : none;
        model_type(m)->stress(model_kind_of(m, i)->data, s->e + (size_t)(i * model_strains(m)),
                              inner, &(stress_output){.energy = &energy});
        sum += energy;
    }
    for (int i = model_discretes(m) - model_springs(m); i < model_discretes(m); i++) {
        double e[SPRING_STRAINS];
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, &model_discrete(m, i)->el, x);
        spring_strain(model_discrete(m, i)->el.nodes, x,
                      turns_of_spring(m, s, i - (model_discretes(m) - model_springs(m))),
                      &(strain_output){.e = e});
        sum += dense_quadratic(SPRING_STRAINS, model_discrete(m, i)->spring->stiffness, e) / 2;
    }
    return sum;
}

static inline inertia_balance flight_inertia(const flight *f)
{
    inertia_balance b;
    inertia_of(f->m, &f->masses, f->now.state, f->now.v, f->now.ends_known ? f->now.ends : NULL,
               &b);
    return b;
}

static inline double flight_energy(const flight *f)
{
    return flight_inertia(f).kinetic + flight_strain_energy(f);
}

#endif
