/* Steady spin of a rod that is stretched by 2 %, bent by 0.8 rad and twisted by 0.6 rad between
 * ends that are driven round: the shape that is in balance at the rate w = (2/h) tan(turn/2) stays,
 * for every formulation, about any axis, up to 3 rad a step. */
#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/model/test/turned_end.h"
#include "harness/newton/newton.h"
#include "harness/time/test/flight.h"
#include "harness/time/time_impl.h"

enum { STEPS = 30, SPIN_STAGES = 4, ITERATIONS = 40 };

static const double rate = 3, stretch = 0.02, first[3] = {0.5, 0.2, 0.1}, along[3] = {1, 0, 0};

static struct {
    double axis[3], turn; /* unit vector; a step [rad] */
    double h;             /* rate = (2/h) tan(turn/2) */
} present;

/* A node at r, with its end displaced by d at the begin, goes round the origin. */
static void drive(scene *s, int node, const int vector[3], const double r[3], const double d[3])
{
    const double *n = present.axis, spin = present.turn / present.h;
    double at[3], crossed[3];
    scene_node_at(s, node)->rotation = SCENE_ROTATION_VECTOR;
    for (int i = 0; i < 3; i++)
        at[i] = r[i] + d[i];
    vec3_cross(n, at, crossed);
    for (int i = 0; i < 3; i++) {
        char name[] = {'u', (char)('x' + i), (char)('0' + node), 0}, text[256];
        const double stays = n[i] * vec3_dot(n, at);
        const int driver = scene_add_moving_driver(s, name);
        snprintf(text, sizeof text, "%.17g + %.17g*cos(%.17g*t) + %.17g*sin(%.17g*t)", stays - r[i],
                 at[i] - stays, spin, crossed[i], spin);
        scene_drive_piece(s, driver, 0, text);
        scene_drive(s, node, i, driver);
        scene_node_at(s, node)->angle[i] = vector[i];
    }
}

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0}, end = 1e3, none[3] = {0, 0, 0};
    section_spec spec = section_spec_rectangle(2e6, 0.8e6, 0.1, 0.05);
    double moved[3], last[3];
    int vector[3];
    (void)value, (void)f;
    spec.density = 1000;
    for (int i = 0; i < 3; i++) {
        char name[] = {'t', (char)('x' + i), 0}, text[64];
        vector[i] = scene_add_moving_driver(s, name);
        snprintf(text, sizeof text, "%.17g*t", present.turn / present.h * present.axis[i]);
        scene_drive_piece(s, vector[i], 0, text);
        last[i] = first[i] + along[i];
        moved[i] = stretch * along[i];
    }
    const int profile = scene_add_section(s, &spec),
              A = scene_add_node(s, first[0], first[1], first[2]),
              B = scene_add_node(s, last[0], last[1], last[2]);
    scene_add_member(s, A, B, profile, y_axis);
    drive(s, A, vector, first, none);
    drive(s, B, vector, last, moved);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end,
                     (scene_motion){.scheme = SCENE_CONSERVING,
                                    .alpha = scene_alpha_of_radius(0.9),
                                    .step = present.h});
    return STATUS_OK;
}

/* Rates of a steady turn, and their derivatives. */
static void turn_rates(const flight *f)
{
    const model *m = f->m;
    double w[3];
    for (int i = 0; i < 3; i++)
        w[i] = rate * present.axis[i];
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate;
        double r[3], v[3], a[3], R[9], W[3];
        if (model_vertex(m, i)->body != i)
            continue;
        kinematics_position(m, f->now.state, i, r);
        vec3_cross(w, r, v);
        vec3_cross(w, v, a);
        rotation_matrix(&f->now.state->q[4 * (size_t)i], R);
        mat3_transpose_mul_vec(R, w, W);
        for (int k = 0; k < 3; k++) {
            if (at[k] != NONE) {
                f->now.v[at[k]] = v[k];
                f->now.a[at[k]] = a[k];
            }
            if (at[SCENE_RX + k] != NONE) {
                f->now.v[at[SCENE_RX + k]] = W[k];
                f->now.a[at[SCENE_RX + k]] = 0;
            }
        }
    }
}

/* The state in balance with the inertia of that turn; the largest last correction. */
static double settle_flight(flight *f)
{
    model *m = f->m;
    const sparse *pattern;
    sparse K;
    matrix_factor *of = NULL;
    double correction = INFINITY;
    const size_t all = (size_t)model_all_coordinates(m) + 1;
    double *residual = calloc(all, sizeof *residual);
    memset(&K, 0, sizeof K);
    if (residual == NULL ||
        assemble_pattern(m, f->run.patterns, 0, &pattern, &f->why) != STATUS_OK ||
        sparse_alloc_like(pattern, &K, &f->why) != STATUS_OK ||
        factor_alloc(pattern, &of, &f->why) != STATUS_OK || of == NULL) {
        free(residual);
        sparse_free_values(&K);
        return INFINITY;
    }
    for (int i = 0; i < ITERATIONS && correction > 1e-15; i++) {
        model_linearisation lin = {.path = 0, .K = &K, .residual = residual};
        turn_rates(f);
        if (linearise_state(&f->c.eq, &f->run.memory, f->now.state, &lin, &f->why) != STATUS_OK)
            break;
        inertia_subtract(m, &f->masses, f->now.state, f->now.v, f->now.a, residual);
        memset(residual + model_unknowns(m), 0, (size_t)model_driven(m) * sizeof *residual);
        if (factor_numeric(of, &K, &f->why) != STATUS_OK)
            break;
        factor_solve(of, residual);
        correction = advance_state(&f->c.eq, &f->run.memory, f->now.state, residual, 0, NULL);
    }
    turn_rates(f);
    free(residual);
    factor_free(of);
    sparse_free_values(&K);
    return correction;
}

/* What is driven goes to where it is at the begin. */
static void pull(flight *f)
{
    model *m = f->m;
    double *dx = calloc((size_t)model_all_coordinates(m) + 1, sizeof *dx);
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) >= model_unknowns(m))
            dx[model_driver_coordinate(m, d)] =
                loads_driver_value(&f->c.eq, &model_scene(m)->driver[d], 0) -
                f->now.state->driver[d];
    increment_apply(m, f->now.state, dx, 0, f->next.state);
    instant_copy(m, &f->next, &f->now);
    free(dx);
}

/* Largest change of a strain over the steps, by the largest strain. */
static double spin_change(flight *f, const double begin[], int *iterations)
{
    const int count = model_elements(f->m) * model_strains(f->m);
    double largest = 0, change = 0;
    for (int i = 0; i < STEPS; i++) {
        if (flight_step(f, present.h) != STATUS_OK)
            return NAN;
        for (int k = 0; k < count; k++)
            change = fmax(change, fabs(f->now.state->e[k] - begin[k]));
    }
    for (int k = 0; k < count; k++)
        largest = fmax(largest, fabs(begin[k]));
    *iterations = f->most;
    return change / largest;
}

static void check(const char *name, const double axis[3], double turn)
{
    const double bend = 0.8, twist = 0.6, size = vec3_norm(axis);
    mesh_triad own[ELEMENT_MAX_NODES];
    flight f;
    int iterations = 0;
    double correction = INFINITY;
    present.turn = turn;
    present.h = 2 * tan(turn / 2) / rate;
    for (int i = 0; i < 3; i++)
        present.axis[i] = axis[i] / size;
    if (flight_ready(&f, build, name, 3) != STATUS_OK) {
        gsl_test(1, "%s: %s", name, f.why.text);
        flight_end(&f);
        return;
    }
    mesh_triad *before = model_element(f.m, model_elements(f.m) - 1)->triad;
    pull(&f);
    for (int part_of = 1; part_of <= SPIN_STAGES; part_of++) {
        const double part = (double)part_of / SPIN_STAGES,
                     vector[3] = {twist * part, 0, bend * part};
        turned_end(f.m, vector, own, before);
        correction = settle_flight(&f);
    }
    double *begin = malloc(sizeof *begin * (size_t)(model_elements(f.m) * model_strains(f.m)));
    memcpy(begin, f.now.state->e,
           sizeof *begin * (size_t)(model_elements(f.m) * model_strains(f.m)));
    const double change = spin_change(&f, begin, &iterations);
    gsl_test(!(correction < 1e-12), "%s, %g rad: in balance (%.1e) %s", name, turn, correction,
             f.why.text);
    gsl_test(!(change < 1e-12), "%s, %g rad a step about %g %g %g: strains change by %.1e %s", name,
             turn, axis[0], axis[1], axis[2], change, f.why.text);
    gsl_test(iterations > 4, "%s, %g rad a step: %d iterations at most", name, turn, iterations);
    free(begin);
    flight_end(&f);
}

int main(void)
{
    static const double axes[][3] = {{1, 0, 0}, {0, 1, 0}, {0.48, 0.6, 0.64}},
                        turns[] = {0.1, 0.3, 1, 2, 3};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int a = 0; a < 3; a++)
            for (int t = 0; t < 5; t++)
                check(registry_formulations[i]->name, axes[a], turns[t]);
    return gsl_test_summary();
}
