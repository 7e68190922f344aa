/* Steps of all integrators: the trapezoidal rule runs back to where it came from, a rigid body that
 * no torque acts on keeps to its exact motion with the order of the scheme, and kinks of loads are
 * hit. */
#include <math.h>

#include "elements/test/worst.h"
#include "harness/model/model.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space;

/* A free rod on its way. */
static void throw_rod(scene *s, scene_scheme by, const scene_alpha *alpha)
{
    moving_case(&case_free_flight_space, "", s);
    const int motion = moving_add(s, by, 0.05, 1);
    moving_unload(s);
    s->analysis[motion].of.motion.alpha = *alpha;
    s->analysis[motion].of.motion.start = (scene_start){.spin = {0.3, 1, 2}};
}

static void steps_begin(const scene *s, flying *f)
{
    const status outcome = flying_begin(s, &element_geometrically_exact, 3, f);
    gsl_test(outcome != STATUS_OK, "begins: %s", f->why.text);
}

static void reverse(void)
{
    enum { STEPS = 40 };
    const scene_alpha trapezoidal = {0, 0};
    scene s;
    flying f;
    double largest = 0;
    throw_rod(&s, SCENE_ALPHA, &trapezoidal);
    steps_begin(&s, &f);
    double *first = flying_all(&f);
    for (int i = 0; i < 2 * STEPS; i++)
        gsl_test(flying_step(&f, i < STEPS ? 0.02 : -0.02) != STATUS_OK, "step %d: %s", i,
                 f.why.text);
    const size_t n = (size_t)model_unknowns(f.m);
    double *last = flying_all(&f);
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, fabs(last[i] - first[i]));
    for (int i = 0; i < 3 * model_vertices(f.m); i++)
        largest = fmax(largest, fabs(f.now.state->u[i]));
    gsl_test(!(largest < 1e-10), "the trapezoidal rule runs back (%g)", largest);
    free(first);
    free(last);
    flying_end(&f);
    scene_free(&s);
}

/* J = diag(1, 2, 3), w(0) = (0.5, 0.2, 2): Jacobi's elliptic functions, at 10 s. */
static double turn_body(scene_scheme by, double h)
{
    static const double w[3] = {0.069492061156576, 0.5340139075307, 1.9794636602342},
                        R[6] = {0.1439879275647, -0.9562925632996, 0.2545034579204,
                                0.9873599189256, 0.1560479392089,  0.02773862231498},
                        y_axis[3] = {0, 1, 0}, at[1] = {10};
    scene s;
    answer a;
    double largest = 0;
    scene_init(&s, "body");
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const section_spec spec = timed_profile(&(timed_section){.EA = 1e-3,
                                                             .GA = 1e-3,
                                                             .GJ = 1e-3,
                                                             .EI = 1e-3,
                                                             .mass = 1e-11,
                                                             .polar = 2e-11,
                                                             .rotary = 1e-11});
    const int profile = scene_add_section(&s, &spec), body = scene_add_node(&s, 0, 0, 0);
    /* with a rod that weighs nothing: something must be joined to it */
    scene_add_member(&s, body, scene_add_node(&s, 1, 0, 0), profile, y_axis);
    scene_node_at(&s, body)->body = (scene_body){.mass = 1, .inertia = {1, 2, 3}};
    const int motion = scene_add_motion(&s, SCENE_NONE, 1, at,
                                        (scene_motion){.scheme = by,
                                                       .alpha = scene_alpha_of_radius(0.9),
                                                       .step = h,
                                                       .start = {.spin = {0.5, 0.2, 2}}});
    for (int i = 0; i < 9; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "%d", i);
        scene_add_quantity(&s, name, "1", motion,
                           i < 3 ? scene_rate(body, SCENE_RX + i)
                                 : scene_orientation_entry(body, (i - 3) / 3, i % 3));
    }
    ask_scene(&s, &element_geometrically_exact, NULL, 1, &a);
    scene_free(&s);
    for (int i = 0; i < 9; i++)
        largest = worst_of(largest, fabs(a.value[i] - (i < 3 ? w[i] : R[i - 3])));
    return largest;
}

static void check_body(scene_scheme by, double h, double order, double least)
{
    const double first = turn_body(by, h), second = turn_body(by, h / 2);
    gsl_test(!(second < least && fabs(log2(first / second) - order) < 0.15),
             "scheme %d: a free body, errors %g, %g, order %g", by, first, second,
             log2(first / second));
}

/* The impulse of 50 N s is exact, though no step but those that are cut ends at a kink. */
static void impulse(scene_scheme by)
{
    scene s;
    answer a;
    moving_case(&case_free_flight_space, "", &s);
    const int motion = moving_add(&s, by, 0.07, 6);
    scene_add_quantity(&s, "px", "1", motion, scene_balance_of(SCENE_PX));
    scene_add_quantity(&s, "py", "1", motion, scene_balance_of(SCENE_PY));
    ask_scene(&s, &element_geometrically_exact, NULL, 3, &a);
    scene_free(&s);
    gsl_test(!(fabs(answer_of(&a, "px") - 50) < 1e-11 && fabs(answer_of(&a, "py")) < 1e-11),
             "scheme %d: momentum is the impulse (%.15g, %g) %s", by, answer_of(&a, "px"),
             answer_of(&a, "py"), a.reason);
}

int main(void)
{
    reverse();
    check_body(SCENE_ALPHA, 0.05, 2, 2.3e-3);
    check_body(SCENE_CONSERVING, 0.05, 2, 5e-3);
    check_body(SCENE_RADAU, 0.1, 5, 2e-8);
    for (int by = 0; by <= SCENE_RADAU; by++)
        impulse((scene_scheme)by);
    return gsl_test_summary();
}
