/* A damped leaf without rotary inertia, bent far by a kick or turned by a moment that is there at
 * once: energies, reactions and resultants of all integrators, of linear and of other stresses. */
#include <math.h>

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/time/time_impl.h"

extern const element_type element_geometrically_exact, element_beamw, element_beamw_consistent,
    element_collocation;

static const double y_axis[3] = {0, 1, 0};

typedef struct blow {
    double force[3], moment[3]; /* at the tip [N, N m]; one of them */
    const char *first;          /* factor until 0.0205 s */
    const char *then;
} blow;

/* 0.5 m along x, with a mass at its tip. */
static int leaf(scene *s, double damping, const blow *by, int *root)
{
    section_spec spec = section_spec_rectangle(200e9, 77e9, 0.02, 0.001);
    spec.density = 7800;
    scene_init(s, "damped leaf");
    *root = scene_add_node(s, 0, 0, 0);
    const int tip = scene_add_node(s, 0.5, 0, 0);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    const int profile = scene_add_section(s, &spec);
    const int member = scene_add_member(s, *root, tip, profile, y_axis);
    scene_member_at(s, member)->damping = damping;
    scene_hold_all(s, *root);
    scene_set_body(s, tip, (scene_body){.mass = 0.05});
    const int pushed = vec3_norm(by->force) > 0;
    const double *v = pushed ? by->force : by->moment;
    const int load = scene_add_load(s, pushed ? SCENE_FORCE : SCENE_MOMENT, tip, v[0], v[1], v[2]);
    scene_load_piece(s, load, 0.0205, by->first);
    scene_load_piece(s, load, 0, by->then);
    return member;
}

static void take(const element_type *type, scene_scheme with, double damping, const blow *by,
                 double step, answer *a)
{
    scene s;
    int root;
    const int member = leaf(&s, damping, by, &root);
    const int motion = moving_add(&s, with, step, 0.1);
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "energy", motion, SCENE_ENERGY);
    scene_add_quantity(&s, "reaction", "N m", motion, scene_reaction(root, SCENE_RY));
    scene_add_quantity(&s, "middle", "N m", motion, scene_internal_at(member, 0.5, SCENE_MY));
    ask_scene(&s, type, NULL, 4, a);
    gsl_test(a->outcome != ASK_ANSWERED, "%s, scheme %d, damping %g s: %s", type->name, with,
             damping, a->reason);
    scene_free(&s);
}

static double drift(const answer *a)
{
    return moving_largest(a, "drift") / moving_largest(a, "energy");
}

static void compare(const element_type *type, double damping, const blow *by, double most)
{
    static const scene_scheme other[] = {SCENE_ALPHA, SCENE_CONSERVING};
    answer fine, a;
    take(type, SCENE_RADAU, damping, by, 0.0005, &fine);
    gsl_test(!(drift(&fine) < most), "%s, damping %g s: radau misses %g of the energy", type->name,
             damping, drift(&fine));
    for (int i = 0; i < 2; i++) {
        take(type, other[i], damping, by, 0.0005, &a);
        if (other[i] == SCENE_CONSERVING)
            gsl_test(!(drift(&a) < 1e-12), "%s, damping %g s: no drift (%g)", type->name, damping,
                     drift(&a));
        const double size = 0.5 * vec3_norm(by->force) + vec3_norm(by->moment);
        for (int k = 0; k < 2; k++) {
            const char *name = k ? "middle" : "reaction";
            const double off = fabs(answer_of(&a, name) - answer_of(&fine, name));
            gsl_test(!(off < 0.01 * size), "%s, scheme %d, damping %g s: %s %g of %g N m off",
                     type->name, other[i], damping, name, off, size);
        }
    }
}

/* Resultant in the middle at 0.1 s. */
static double middle(double step)
{
    const blow swing = {{0, 0, 2}, {0}, "sin(50*t)", "sin(50*t)"};
    answer a;
    take(&element_geometrically_exact, SCENE_CONSERVING, 1e-3, &swing, step, &a);
    return answer_of(&a, "middle");
}

/* Forces on what has no inertia [N m], the largest of them. */
static double out_of_balance(flying *f)
{
    const size_t all = (size_t)model_all_coordinates(f->m) + 1;
    double *residual = calloc(all, sizeof *residual), most = 0;
    model_linearisation lin = {.path = f->now.time, .residual = residual};
    const status outcome = linearise_state(&f->c.eq, &f->run.memory, f->now.state, &lin, &f->why);
    inertia_subtract(f->m, &f->masses, f->now.state, f->now.v, f->now.a, residual);
    massless_forces(f->m, &f->masses, f->now.state, residual, &f->why);
    for (int c = 0; c < model_unknowns(f->m); c++)
        most = fmax(most, fabs(residual[c]));
    free(residual);
    return outcome == STATUS_OK ? most : NAN;
}

/* The largest of the rates less those of before, by the largest of them. */
static double changed(const flying *f, const double before[])
{
    double most = 0, size = 0;
    for (int c = 0; c < model_unknowns(f->m); c++) {
        most = fmax(most, fabs(f->now.v[c] - before[c]));
        size = fmax(size, fabs(before[c]));
    }
    return most / size;
}

/* A moment that turns round in an instant finds rates that balance it, and moves nothing; one that
 * goes on changes nothing. */
static void launch_there(const char *then, double least, double most)
{
    const blow back = {{0}, {0.1, 0.3, 0.1}, "1", then};
    const int steps = 41;
    scene s;
    flying f;
    int root;
    double before[4], after[4], r[3];
    leaf(&s, 1e-3, &back, &root);
    moving_add(&s, SCENE_RADAU, 0.0005, 0.1);
    gsl_test(flying_begin(&s, &element_geometrically_exact, 4, &f) != STATUS_OK, "begins: %s",
             f.why.text);
    for (int i = 0; i < steps; i++) /* on the instant, or the load is that behind it */
        gsl_test(flying_step(&f, (0.0205 - f.now.time) / (steps - i)) != STATUS_OK, "step %d: %s",
                 i, f.why.text);
    for (int k = 0; k < model_elements(f.m) * model_strains(f.m); k++)
        f.now.state->e[k] *= 1 + 1e-9; /* as iterations leave them */
    kinematics_frame(f.m, f.now.state, 1, r, before);
    double *rates = malloc((size_t)model_unknowns(f.m) * sizeof *rates);
    memcpy(rates, f.now.v, (size_t)model_unknowns(f.m) * sizeof *rates);
    gsl_test(launch_again(&f.c, &f.masses, scene_motion_of(&s.analysis[0]), &f.now, &f.next,
                          &f.why) != STATUS_OK,
             "goes on: %s", f.why.text);
    kinematics_frame(f.m, f.now.state, 1, r, after);
    gsl_test(!(fabs(before[0]) < 0.999), "the tip has turned (%g)", before[0]);
    double turned = 0;
    for (int i = 0; i < 4; i++)
        turned = fmax(turned, fabs(after[i] - before[i]));
    gsl_test(!(turned < 1e-13), "and turns by no more in no time (%g)", turned);
    const double other = changed(&f, rates);
    gsl_test(!(other >= least && other < most), "then %s: rates change by %g of them", then, other);
    free(rates);
    const double left = out_of_balance(&f);
    gsl_test(!(left < 5e-6), "its rates balance the moment (%g of 0.6 N m left)", left);
    flying_end(&f);
    scene_free(&s);
}

int main(void)
{
    static const element_type *const type[] = {&element_geometrically_exact, &element_beamw,
                                               &element_beamw_consistent, &element_collocation};
    const blow kick = {{0, 0, 2}, {0}, "1-cos(2*pi*t/0.0205)", "0"},
               turn = {{0}, {0, 0.3, 0}, "0", "1"},
               hard = {{0, 30, 0}, {0}, "1-cos(2*pi*t/0.0205)", "0"};
    for (int i = 0; i < 4; i++) {
        compare(type[i], 1e-3, &kick, 1e-4);
        compare(type[i], 1e-3, &turn, 1e-3);
    }
    answer a;
    take(&element_beamw, SCENE_RADAU, 1e-3, &hard, 0.001, &a);
    gsl_test(!(drift(&a) < 1e-5), "a hard kick of beamw: radau misses %g of the energy", drift(&a));
    launch_there("-1", 0.1, 10);
    launch_there("1", 0, 1e-5);
    const double coarse = middle(0.002), half = middle(0.001), quarter = middle(0.0005),
                 ratio = (coarse - half) / (half - quarter);
    gsl_test(!(fabs(ratio - 4) < 0.5), "resultants of the conserving scheme have order 2 (%g)",
             ratio);
    return gsl_test_summary();
}
