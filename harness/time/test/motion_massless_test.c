/* Bending turns without inertia where the twist has some: its gyroscopic moment loads them. Rods
 * that spin obliquely come into balance with it and are integrated from there, with the orders of
 * the integrators; they are what less and less inertia of the bending turns goes to; and where they
 * are in balance, another start changes nothing. */
#include <math.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/test/flying.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

#define RODS "harness/time/test/rods.yaml"

enum { PLACES = 3 };

static struct {
    double rotary, spin;
    int joint, thrown;
} how;

/* Oblique to all axes; with a joint another rod at its end, which turns about one axis of its own.
 * Thrown: from rest, by a force and a moment that come and go. */
static void build(scene *s, scene_scheme by, double step)
{
    scenes_read(s, RODS,
                "of=oblique;end=1;integrator=%s;step=%.17g;spin=%g;rotary=%g;joint=%s;"
                "comes_and_goes=%d",
                scenes_integrator[by], step, how.spin, how.rotary, how.joint ? "hinge" : "stiff",
                how.thrown);
}

/* Where B is after 0.8 s. */
static void fly(scene_scheme by, double step, double place[PLACES])
{
    scene s;
    flying f;
    build(&s, by, step);
    status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    for (int i = 0; i < lround(0.8 / step) && outcome == STATUS_OK; i++)
        outcome = flying_step(&f, step);
    gsl_test(outcome != STATUS_OK, "integrator %d, spin %g, rotary %g, step %g s: %s", by, how.spin,
             how.rotary, step, f.why.text);
    kinematics_position(f.m, f.now.state, 1, place);
    flying_end(&f);
    scene_free(&s);
}

static double distance(const double a[PLACES], const double b[PLACES])
{
    const double apart[PLACES] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dense_dot(PLACES, apart, apart));
}

static double error_of(scene_scheme by, double step)
{
    double exact[PLACES], place[PLACES];
    fly(SCENE_RADAU, 0.005, exact);
    fly(by, step, place);
    return distance(place, exact);
}

/* The error of time, and that with half the step. */
static void converge(scene_scheme by, double step, double ratio)
{
    const double first = error_of(by, step), second = error_of(by, step / 2);
    gsl_test(!(fabs(first / second / ratio - 1) < 0.25),
             "integrator %d, spin %g: errors %g and %g m", by, how.spin, first, second);
}

static void agree(scene_scheme by, double step, double most)
{
    const double error = error_of(by, step);
    gsl_test(!(error < most), "integrator %d, spin %g, joint: error %g m", by, how.spin, error);
}

/* Explicit steps, which need inertia, with less and less of it. */
static void limit(void)
{
    double place[3][PLACES], without[PLACES];
    for (int i = 0; i < 3; i++) {
        how.rotary = i < 2 ? 0.04 / (1 + i) : 0;
        fly(i < 2 ? SCENE_EXPLICIT : SCENE_RADAU, i < 2 ? 0.0025 : 0.01, place[i]);
    }
    for (int i = 0; i < PLACES; i++)
        without[i] = 2 * place[1][i] - place[0][i];
    const double coarse = distance(place[0], place[2]), fine = distance(place[1], place[2]),
                 rest = distance(without, place[2]);
    gsl_test(!(fabs(coarse / fine - 2) < 0.1 && rest < 0.04 * coarse),
             "less inertia of bending turns: %g, %g, then %g m from none", coarse, fine, rest);
}

/* In the middle of a motion everything is where and as fast as it belongs. */
static void start_again(void)
{
    scene s;
    flying f;
    instant before;
    build(&s, SCENE_RADAU, 0.01);
    status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    for (int i = 0; i < 50 && outcome == STATUS_OK; i++)
        outcome = flying_step(&f, 0.01);
    if (outcome == STATUS_OK)
        outcome = instant_alloc(f.m, &before, &f.why);
    gsl_test(outcome != STATUS_OK, "%s", f.why.text);
    instant_copy(f.m, &f.now, &before);
    const scene_motion *motion = scene_motion_of(&s.analysis[0]);
    outcome = launch_again(&f.c, &f.masses, motion, &f.now, &f.next, &f.why);
    gsl_test(outcome != STATUS_OK, "%s", f.why.text);
    double moved = 0, changed = 0, largest = 0, forces[2][100] = {{0}};
    for (int i = 0; i < model_vertices(f.m); i++) {
        double p[3], q[3];
        kinematics_position(f.m, before.state, i, p);
        kinematics_position(f.m, f.now.state, i, q);
        moved = fmax(moved, distance(p, q));
        for (int k = 0; k < 4; k++)
            moved = fmax(moved, fabs(before.state->q[4 * i + k] - f.now.state->q[4 * i + k]));
    }
    inertia_subtract(f.m, &f.masses, f.now.state, f.now.v, before.a, forces[0]);
    inertia_subtract(f.m, &f.masses, f.now.state, f.now.v, f.now.a, forces[1]);
    for (int c = 0; c < model_unknowns(f.m); c++) {
        changed = fmax(changed, fabs(forces[0][c] - forces[1][c]));
        largest = fmax(largest, fabs(forces[1][c]));
    }
    gsl_test(!(moved < 1e-9), "joint %d: started again it moves by %g", how.joint, moved);
    gsl_test(!(changed < 1e-3 * largest), "joint %d: started again inertia changes by %g of %g N",
             how.joint, changed, largest);
    instant_free(&before);
    flying_end(&f);
    scene_free(&s);
}

/* So much spin that bending does not hold the gyroscopic moments. */
static void refuse(void)
{
    scene s;
    flying f;
    build(&s, SCENE_ALPHA, 0.01);
    const status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    gsl_test(outcome != STATUS_NOT_CONVERGED || strstr(f.why.text, "no balance") == NULL,
             "without a balance: %s", f.why.text);
    flying_end(&f);
    scene_free(&s);
}

int main(void)
{
    static const double spins[] = {0.3, 1};
    for (how.joint = 0; how.joint < 2; how.joint++)
        for (int i = 0; i < 2; i++) {
            how.spin = spins[i];
            if (how.joint) { /* whose modes these steps do not resolve */
                agree(SCENE_ALPHA, 0.01, 3e-3);
            } else {
                converge(SCENE_ALPHA, 0.02, 4);
                converge(SCENE_CONSERVING, 0.02, 4);
                converge(SCENE_RADAU, 0.02, 28);
            }
            start_again();
        }
    how.joint = 0;
    how.spin = 60;
    refuse();
    how.spin = 0;
    how.thrown = 1;
    limit();
    return gsl_test_summary();
}
