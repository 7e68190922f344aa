/* A rejected step must have no effect. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/scalar.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/time/time_impl.h"
#include "harness/tools/kit/scenes.h"

#define REJECTED_SWUNG "harness/time/test/swung.yaml"

extern const element_type element_geometrically_exact, element_collocation;
extern const case_type case_free_flight_space;

static void throw_rod(scene *s, scene_scheme by)
{
    moving_case(&case_free_flight_space, "", s);
    scene_member_at(s, 0)->damping = by <= SCENE_ALPHA || by == SCENE_RADAU ? 1e-3 : 0;
    motion_added(s, by, 0.05, 1);
}

static void shake_rods(scene *s, scene_scheme by)
{
    scenes_read(s, REJECTED_SWUNG, "base=shaken;second=%s;integrator=%s;step=0.02",
                by == SCENE_EXPLICIT ? "joined" : "slides", scenes_integrator[by]);
    scene_set_body(s, scenes_find(s, SCENE_NODES, "tip_free"),
                   (scene_body){0.3, {0, 0.1, 0.1}, {0.1, 0.2, 0.3, 0, 0.01, 0}});
}

static int same(const flying *f, const double a[], const double b[])
{
    return memcmp(a, b, flying_numbers(f, &f->now, NULL) * sizeof *a) == 0;
}

/* Returns 1 if two instants are equal up to round-off. */
static int is_close(const flying *f, const double a[], const double b[])
{
    const double rounding = 5e-11;
    for (size_t i = 0; i < flying_numbers(f, &f->now, NULL); i++)
        if (fabs(a[i] - b[i]) > rounding * (1 + fabs(a[i])))
            return 0;
    return 1;
}

static int try_rejected(flying *f, double h)
{
    int failed = 0;
    for (int k = 1; k < 6; k++)
        failed += flying_try(f, pow(8, k) * h) != STATUS_OK;
    gsl_test(flying_try(f, 0.7 * h) != STATUS_OK, "a short step: %s", f->why.text);
    return failed;
}

static void reject(const char *name, void (*build)(scene *, scene_scheme), const element_type *type,
                   int elements, scene_scheme by, double h)
{
    scene s;
    flying tried, plain;
    build(&s, by);
    gsl_test(flying_begin(&s, type, elements, &tried) != STATUS_OK, "%s: %s", name, tried.why.text);
    gsl_test(flying_begin(&s, type, elements, &plain) != STATUS_OK, "%s: %s", name, plain.why.text);
    for (int i = 0; i < 3; i++) {
        flying_step(&tried, h);
        flying_step(&plain, h);
    }
    double *before = flying_all(&tried);
    gsl_test(try_rejected(&tried, h) == 0, "%s, scheme %d: a long step fails", name, by);
    double *behind = flying_all(&tried);
    gsl_test(!same(&tried, before, behind), "%s, scheme %d: a rejected step leaves all bits", name,
             by);
    const status again = flying_step(&plain, h);
    flying_step(&tried, h);
    double *then = flying_all(&tried), *without = flying_all(&plain);
    int (*const agrees)(const flying *, const double[], const double[]) =
        by == SCENE_RADAU ? is_close : same;
    gsl_test(again != STATUS_OK || !agrees(&tried, then, without),
             "%s, scheme %d: what follows a rejected step knows nothing of it (%s)", name, by,
             plain.why.text);
    gsl_test(by == SCENE_RADAU ? !(fabs(tried.error / plain.error - 1) < 1e-8)
                               : memcmp(&tried.error, &plain.error, sizeof tried.error) != 0,
             "%s, scheme %d: nor does its error (%g, %g)", name, by, tried.error, plain.error);
    free(before);
    free(behind);
    free(then);
    free(without);
    flying_end(&tried);
    flying_end(&plain);
    scene_free(&s);
}

enum { STATIONS = 60, CROSSINGS = 4, PERIOD = CROSSINGS, MEAN, WAY, TIP };

static void observe_rejections(int by, double step, double tolerance, cell_result *out)
{
    scenes_solve(REJECTED_SWUNG, "collocation", 1, out,
                 "base=shaken;read=passed;stations=sixty;integrator=%s;step=%g;tolerance=%g",
                 scenes_integrator[by], step, tolerance);
}

static void near(int by, const char *what, double found, double expected)
{
    gsl_test(!(fabs(found - expected) < 1e-9), "scheme %d, %s: %.12g, expected %.12g", by, what,
             found, expected);
}

/* Each crossing must be counted once, regardless of rejected steps. Stations must have values of
 * accepted steps only, which must agree within `close` [m] with the motion of the tip for short
 * steps. */
static void pass(int by, double step, double tolerance, double close, const cell_result *exact)
{
    cell_result r;
    observe_rejections(by, step, tolerance, &r);
    const quantity_result *q = r.solve.quantity;
    for (int i = 0; i < CROSSINGS; i++)
        near(by, r.scene.quantity[i].name, q[i].value, (i + 1) * PI / 5);
    near(by, "period", q[PERIOD].value, 2 * PI / 5);
    near(by, "mean", q[MEAN].value, 0.06 * (1 - cos(5)));
    gsl_test_int(q[WAY].curve.points, STATIONS, "scheme %d: stations", by);
    for (int i = 0; i < q[WAY].curve.points; i++)
        near(by, "station", q[WAY].curve.value[i], 0.3 * sin(5 * 3.0 * (i + 1) / STATIONS));
    const curve *tip = &q[TIP].curve, *way = &exact->solve.quantity[TIP].curve;
    double apart = 0;
    for (int i = 0; i < tip->points; i++)
        apart = fmax(apart, fabs(tip->value[i] - way->value[i]));
    gsl_test(!(apart < close), "scheme %d: stations are %g m beside the way", by, apart);
    gsl_test(r.counters.rejected_steps < 2, "scheme %d: %ld steps are rejected", by,
             r.counters.rejected_steps);
    gsl_test_int(r.solve.motions, r.solve.steps + 1, "scheme %d: a record of each step", by);
    int rejected = 0;
    for (int i = 1; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at, *before = &r.solve.motion[i - 1].at;
        gsl_test(!(fabs(one->time - before->time - one->step) < 1e-12),
                 "scheme %d: step %d from %g to %g s is %g s long", by, i, before->time, one->time,
                 one->step);
        rejected += one->rejected;
    }
    gsl_test_int(rejected, (int)r.counters.rejected_steps, "scheme %d: rejected in records", by);
    cell_result_free(&r);
}

static void rejected_tests(void)
{
    for (int by = 0; by < SCENE_SCHEMES; by++) {
        const scene_scheme of = (scene_scheme)by;
        const double h = by == SCENE_EXPLICIT ? 0.002 : 0.05;
        reject("rod", throw_rod, &element_geometrically_exact, 3, of, h);
        reject("shaken", shake_rods, &element_collocation, 1, of, h / 4);
    }
    cell_result exact;
    observe_rejections(SCENE_RADAU, 0.1, 1e-8, &exact);
    pass(SCENE_ALPHA, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_CONSERVING, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_RADAU, 0.2, 1e-6, 4e-6, &exact);
    pass(SCENE_EXPLICIT, 0.2, 1e-6, 4e-5, &exact);
    cell_result_free(&exact);
}

extern const element_type element_geometrically_exact, element_beamw, element_beamw_consistent,
    element_collocation;

static const double y_axis[3] = {0, 1, 0};

typedef struct blow {
    double force[3], moment[3]; /* load at the tip [N], [N m]; one of the two is zero */
    const char *first;          /* factor of the load until 0.0205 s, and after it */
    const char *then;
} blow;

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
    const int motion = motion_added(&s, with, step, 0.1);
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

static double middle(double step)
{
    const blow swing = {{0, 0, 2}, {0}, "sin(50*t)", "sin(50*t)"};
    answer a;
    take(&element_geometrically_exact, SCENE_CONSERVING, 1e-3, &swing, step, &a);
    return answer_of(&a, "middle");
}

/* Returns the largest unbalanced moment on rotations without inertia [N m]. */
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

static double changed(const flying *f, const double before[])
{
    double most = 0, size = 0;
    for (int c = 0; c < model_unknowns(f->m); c++) {
        most = fmax(most, fabs(f->now.v[c] - before[c]));
        size = fmax(size, fabs(before[c]));
    }
    return most / size;
}

static void start_from(const char *then, double least, double most)
{
    const blow back = {{0}, {0.1, 0.3, 0.1}, "1", then};
    const int steps = 41;
    scene s;
    flying f;
    int root;
    double before[4], after[4], r[3];
    leaf(&s, 1e-3, &back, &root);
    motion_added(&s, SCENE_RADAU, 0.0005, 0.1);
    gsl_test(flying_begin(&s, &element_geometrically_exact, 4, &f) != STATUS_OK, "begins: %s",
             f.why.text);
    for (int i = 0; i < steps; i++) /* the last step ends exactly at the jump; beyond it, the load
                                       after the jump would act */
        gsl_test(flying_step(&f, (0.0205 - f.now.time) / (steps - i)) != STATUS_OK, "step %d: %s",
                 i, f.why.text);
    for (int k = 0; k < model_elements(f.m) * model_strains(f.m); k++)
        f.now.state->e[k] *= 1 + 1e-9;
    kinematics_frame(f.m, f.now.state, 1, r, before);
    double *rates = malloc((size_t)model_unknowns(f.m) * sizeof *rates);
    memcpy(rates, f.now.v, (size_t)model_unknowns(f.m) * sizeof *rates);
    gsl_test(consistent_restart(&f.c, &f.masses, scene_motion_of(&s.analysis[0]), &f.now, &f.next,
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

static void damped_kick_tests(void)
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
    start_from("-1", 0.1, 10);
    start_from("1", 0, 1e-5);
    const double coarse = middle(0.002), half = middle(0.001), quarter = middle(0.0005),
                 ratio = (coarse - half) / (half - quarter);
    gsl_test(!(fabs(ratio - 4) < 0.5), "resultants of the conserving scheme have order 2 (%g)",
             ratio);
}

#define RATES_SWUNG "harness/time/test/swung.yaml"

static double *strains_in(flying *f, double h)
{
    const size_t n = (size_t)(model_elements(f->m) * model_strains(f->m));
    double *out = malloc(n * sizeof *out);
    gsl_test(flying_try(f, h) != STATUS_OK, "a step of %g s: %s", h, f->why.text);
    memcpy(out, kinematics_strains(f->next.state), n * sizeof *out);
    return out;
}

static double apart(int n, const double a[], const double b[])
{
    double most = 0, size = 0;
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fabs(b[i]));
    }
    return most / size;
}

static void damped_rates_tests(void)
{
    const double d = 1e-3, h = 0.002;
    scene s;
    flying f;
    scenes_read(&s, RATES_SWUNG, "damping=0.02;rho=0.5;step=0.01");
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &f) != STATUS_OK, "begins: %s",
             f.why.text);
    for (int i = 0; i < 300; i++)
        gsl_test(flying_step(&f, h) != STATUS_OK, "step %d: %s", i, f.why.text);
    const int n = model_elements(f.m) * model_strains(f.m);
    double *rate = calloc((size_t)n, sizeof *rate), *later = strains_in(&f, d),
           *before = strains_in(&f, -d);
    damping_rates(f.m, f.now.state, f.now.v, rate, &f.why);
    for (int i = 0; i < n; i++)
        later[i] = (later[i] - before[i]) / (2 * d);
    const double wrong = apart(n, rate, later), followed = apart(n, f.now.strain, later);
    gsl_test(!(wrong < 1e-4), "rates of strains by differences: %g apart", wrong);
    gsl_test(!(followed < 1e-4), "carried along: %g apart", followed);
    const double lost = f.now.dissipated, power = damping_power(&f.c.eq, rate);
    flying_step(&f, d);
    damping_rates(f.m, f.now.state, f.now.v, rate, &f.why);
    const double mean = (power + damping_power(&f.c.eq, rate)) / 2;
    gsl_test(!(fabs((f.now.dissipated - lost) / (d * mean) - 1) < 1e-3),
             "a step loses %g J, its power is %g W", f.now.dissipated - lost, mean);
    free(rate);
    free(later);
    free(before);
    flying_end(&f);
    scene_free(&s);
}

#define LAUNCH_SWUNG "harness/time/test/swung.yaml"

static const double driven_rate = 0.4, none = 1e-10;

static void launched(int driven)
{
    scene s;
    flying at;
    scenes_read(&s, LAUNCH_SWUNG, "tip=%s;step=0.02", driven ? "askew_driven" : "askew");
    const int tip = scenes_find(&s, SCENE_NODES, driven ? "tip_askew_driven" : "tip_askew");
    const scene_start field = scene_motion_of(&s.analysis[0])->start;
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &at) != STATUS_OK, "begins: %s",
             at.why.text);
    for (int i = 0; i < model_vertices(at.m); i++) {
        frame_rates r;
        double place[3], turn[4], velocity[3], left[3];
        kinematics_frame(at.m, at.now.state, i, place, turn);
        forms_rates(at.m, at.now.state, i, at.now.v, NULL, &r);
        for (int k = 0; k < 3; k++)
            place[k] -= field.centre[k];
        vec3_cross(field.spin, place, velocity);
        for (int k = 0; k < 3; k++)
            gsl_test_abs(r.v[k], velocity[k] + field.velocity[k], none, "vertex %d, velocity %d", i,
                         k);
        for (int k = 0; k < 3; k++)
            left[k] = r.w[k] - field.spin[k];
        if (i != tip || !driven) {
            gsl_test(!(vec3_norm(left) < none), "vertex %d: %g rad/s beside its spin", i,
                     vec3_norm(left));
            continue;
        }
        const int *c = &model_vertex(at.m, i)->coordinate[SCENE_RX];
        double b[3][3];
        kinematics_axes(at.m, at.now.state, i, b);
        gsl_test_abs(at.now.v[c[0]], driven_rate, none, "the driven angle");
        gsl_test(!(vec3_norm(left) > 0.1), "what is driven is not of the field");
        for (int k = 1; k < 3; k++)
            gsl_test_abs(vec3_dot(b[k], left), 0, none, "about axis %d nothing is left", k);
    }
    flying_end(&at);
    scene_free(&s);
}

static void turning(double beside)
{
    scene_rotating_frame frame = {.omega = {0.8, -1.5, 1.1}, .centre = {0.3, 0.5, beside}};
    scene s;
    flying at;
    scenes_read(&s, LAUNCH_SWUNG, "base=held;thrown=0;step=0.02");
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &at) != STATUS_OK, "begins: %s",
             at.why.text);
    const status outcome = initial_conditions_rotating(
        &at.c, &at.masses, scene_motion_of(&s.analysis[0]), &frame, &at.now, &at.next, &at.why);
    gsl_test(outcome != (beside == 0 ? STATUS_OK : STATUS_REFUSED), "turns %g m beside it: %s",
             beside, at.why.text);
    flying_end(&at);
    scene_free(&s);
}

static void initial_conditions_tests(void)
{
    turning(0);
    turning(0.1);
    launched(0);
    launched(1);
}

int main(void)
{
    rejected_tests();
    damped_kick_tests();
    damped_rates_tests();
    initial_conditions_tests();
    return gsl_test_summary();
}
