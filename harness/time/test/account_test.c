/* The energy-balance error of motions must be small. account_check must report errors above its
 * limit, with advice. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/time/time_impl.h"
#include "harness/tools/kit/scenes.h"

#define SWUNG "harness/time/test/swung.yaml"

extern const case_type case_free_flight_space, case_elbow;

static const struct {
    const char *name, *values;
} account_kind[] = {{"free", "base=free"},
                    {"driven base", "base=driven;thrown=0"},
                    {"turned base", "base=turned;thrown=0"},
                    {"damped", "damping=0.05"},
                    {"dashpots", "dashpots=1"},
                    {"dashpots of a driven base", "dashpots=1;base=driven;thrown=0"},
                    {"follower", "load=follower"},
                    {"goes on", "parts=2;middle=0.6"}};
enum { DAMPED = 3, FOLLOWER = 6, KINDS = sizeof account_kind / sizeof account_kind[0] };

static double missing(const solve_result *r, double *turned)
{
    account of = {.largest = 0};
    double most = 0;
    for (int i = 0; i < r->motions; i++) {
        account_take(&of, i, r->motion[i].at.balance);
        most = fmax(most, fabs(r->motion[i].at.balance[SCENE_DRIFT]));
    }
    *turned = of.turned / of.largest;
    return most / account_size(&of);
}

static void balanced(scene_scheme by, double step, double most)
{
    for (int k = 0; k < KINDS; k++) {
        if (k == DAMPED && by == SCENE_EXPLICIT)
            continue;
        for (int adapts = 0; adapts < 2; adapts++) {
            cell_result r;
            double turned, off;
            scenes_solve(SWUNG, "collocation", 1, &r, "%s;integrator=%s;step=%.17g;tolerance=%g",
                         account_kind[k].values, scenes_integrator[by], step, adapts ? 1e-6 : 0);
            off = missing(&r.solve, &turned);
            gsl_test(!(off < (adapts ? fmax(most, 1e-4) : most)), "scheme %d, %s%s: %g of it", by,
                     account_kind[k].name, adapts ? ", adaptive" : "", off);
            gsl_test(!(turned > 0.01), "scheme %d, %s: work is done (%g)", by, account_kind[k].name,
                     turned);
            const double *last = r.solve.motion[r.solve.motions - 1].at.balance;
            gsl_test((k >= DAMPED && k < FOLLOWER) !=
                         (last[SCENE_DISSIPATED] > 1e-3 * last[SCENE_ENERGY]),
                     "scheme %d, %s: %g J dissipated of %g J", by, account_kind[k].name,
                     last[SCENE_DISSIPATED], last[SCENE_ENERGY]);
            cell_result_free(&r);
        }
    }
}

static const struct {
    double drift, turned, rounding, rho, tolerance;
    scene_scheme by;
    const char *words; /* words of the message; NULL: the error is allowed */
} row[] = {
    {0.09, 0, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_ALPHA,
     "which is 1.1 % of the largest energy or work so far, 10 J"},
    {0.11, 0, 0, 0.5, 1e-4, SCENE_ALPHA, "smaller tolerance"},
    {0.11, 0, 0, 0.9, 0, SCENE_ALPHA, "smaller step"},
    {0.11, 0, 0, 0.9, 0, SCENE_RADAU, "smaller step, a tolerance, or the integrator conserving"},
    {0.11, 0, 0, 0.9, 0, SCENE_CONSERVING, "smaller step, a tolerance, or the integrator radau"},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_EXPLICIT, "smaller tolerance"},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_CONSERVING, "radau"},
    {0.11, 20, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {0.21, 20, 0, 0.9, 1e-4, SCENE_ALPHA, "work so far, 20 J"},
    {0.11, 0, 100, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {NAN, 0, 100, 0.9, 1e-4, SCENE_ALPHA, "nan"},
    {-0.9, 0, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {-1.1, 0, 0, 0.9, 1e-4, SCENE_ALPHA, "has lost 1.1 J of energy, which is 11 % of the largest"},
    {-1.1, 0, 0, 0.9, 1e-4, SCENE_RADAU, "has lost"},
    {-1.1, 0, 0, 0.8, 1e-4, SCENE_RADAU, "has lost"},
    {-1.1, 0, 0, 0.8, 1e-4, SCENE_ALPHA, NULL},
    {-1.1, 0, 0, 0.9, 0, SCENE_ALPHA, NULL},
    {-1.1, 0, 0, 0.9, 0, SCENE_RADAU, NULL},
    {-1.1, 0, 1, 0.9, 1e-4, SCENE_RADAU, NULL},
};

static void judged(void)
{
    for (int i = 0; i < (int)(sizeof row / sizeof row[0]); i++) {
        const scene_motion how = {.scheme = row[i].by,
                                  .alpha = scene_alpha_of_radius(row[i].rho),
                                  .tolerance = row[i].tolerance};
        double balance[SCENE_BALANCES] = {0};
        account of = {.largest = 0};
        fault f = {""};
        balance[SCENE_ENERGY] = 10;
        account_take(&of, 0, balance);
        balance[SCENE_WORK] = row[i].turned / 2;
        account_take(&of, 1, balance);
        balance[SCENE_WORK] = 0;
        balance[SCENE_ENERGY] = 1;
        account_take(&of, 2, balance);
        balance[SCENE_DRIFT] = row[i].drift;
        const status outcome = account_check(&of, &how, 0.5, balance, row[i].rounding, &f);
        gsl_test((outcome == STATUS_OK) != (row[i].words == NULL), "row %d: %s", i, f.text);
        gsl_test(row[i].words != NULL && strstr(f.text, row[i].words) == NULL, "row %d: %s", i,
                 f.text);
        gsl_test(row[i].words != NULL && strstr(f.text, "at 0.5 s") == NULL, "row %d: when", i);
        gsl_test(row[i].by == SCENE_CONSERVING && strstr(f.text, "conserving") != NULL,
                 "row %d names the integrator in use: %s", i, f.text);
    }
}

static status run(const case_type *type, const char *parameters, int elements, cell_result *out)
{
    cell_request request = {.type = type, .elements = elements};
    fault f = {""};
    formulation chosen;
    formulation_default(formulation_find("geometrically_exact"), &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(type, request.parameter);
    gsl_test(parameters_parse(type, parameters, request.parameter, NULL, &f) != STATUS_OK, "%s",
             f.text);
    return cell_run(&request, out, &f);
}

static void made(void)
{
    cell_result r;
    double turned;
    gsl_test(run(&case_free_flight_space,
                 "time=40;stiffening=1e4;integrator=alpha;tolerance=0;"
                 "step=0.2",
                 4, &r) != STATUS_NOT_CONVERGED,
             "long steps: not converged");
    gsl_test(strstr(r.solve.reason, "the energy exceeds the initial energy") == NULL, "why: %s",
             r.solve.reason);
    gsl_test(r.solve.motions < 20, "and has gone on (%d records)", r.solve.motions);
    cell_result_free(&r);
    gsl_test(run(&case_elbow, "time=1;integrator=explicit", 4, &r) != STATUS_OK, "explicit: %s",
             r.solve.reason);
    const double off = missing(&r.solve, &turned);
    gsl_test(!(off <= account_gained), "explicit steps at their limit: %g made", off);
    gsl_test(r.counters.rejected_steps == 0, "none of them was rejected");
    cell_result_free(&r);
}

static void account_tests(void)
{
    judged();
    made();
    balanced(SCENE_ALPHA, 1 / 128.0, 2e-3);
    balanced(SCENE_RADAU, 1 / 64.0, 1e-5);
    balanced(SCENE_CONSERVING, 1 / 64.0, 1e-10);
    balanced(SCENE_EXPLICIT, 1 / 512.0, 1e-8);
}

extern const element_type element_beamw_consistent, element_beamw, element_geometrically_exact,
    element_collocation;

enum { ELEMENTS = 9, MOST = ELEMENT_MAX_STRAINS };

static model *leaf(const element_type *type, scene *s)
{
    static const double y[3] = {0, 1, 0};
    model *m = NULL;
    fault f = {""};
    const section_spec spec = section_spec_rectangle(2e11, 77e9, 0.04, 0.0005);
    scene_init(s, "leaf");
    const int p = scene_add_node(s, 0, 0, 0), q = scene_add_node(s, 1, 0, 0);
    scene_add_member(s, p, q, scene_add_section(s, &spec), y);
    const model_request request = {.scene = s, .type = type, .elements = ELEMENTS, .keep_all = 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", type->name, f.text);
    return m;
}

static void evaluate(const model *m, int i, const double e[], double sigma[], double C[])
{
    const element_data *data = model_kind_of(m, i)->data;
    gsl_test(model_type(m)->stress(data, e, NULL, &(stress_output){.sigma = sigma, .C = C}) !=
                 STATUS_OK,
             "%s: evaluated", model_type(m)->name);
}

static double largest(int n, const double a[], const double b[])
{
    double out = 0;
    for (int i = 0; i < n; i++)
        out = fmax(out, fabs(a[i] - (b != NULL ? b[i] : 0)));
    return out;
}

static void load(const model *m, int i, double angle, double sigma[], double e[])
{
    const double l = model_kind_of(m, i)->length;
    double rest[MOST] = {0}, none[MOST], C[MOST * MOST];
    evaluate(m, i, rest, none, C);
    for (int k = 0; k < model_strains(m); k++)
        e[k] = k == 4 || k == 5 ? (k == 4 ? 0.5 : 0.4) * angle * l : 0;
    e[1] = 0.02 * angle * l;
    dense_mul_vec(model_strains(m), model_strains(m), C, e, sigma);
}

static long checks_flutter(const equations *eq, strain_update *c, model_state *s, int iteration,
                           double correction)
{
    const long before = eq->run->counters.stress_evaluations;
    strain_update_apply(c, s, iteration, correction);
    return eq->run->counters.stress_evaluations - before;
}

static void again(const equations *eq, strain_update *c, model_state *s)
{
    gsl_test(checks_flutter(eq, c, s, 2, 0.5) != ELEMENTS,
             "some did not agree before: all are looked at");
    gsl_test(checks_flutter(eq, c, s, 3, 0.1) != 0, "a smaller correction is not looked at");
    gsl_test(checks_flutter(eq, c, s, 4, 0.6) != ELEMENTS, "a larger one is");
    gsl_test(checks_flutter(eq, c, s, 1, 0.1) != ELEMENTS, "and the first of a step");
}

static void take(const element_type *type, double angle)
{
    scene s;
    fault f = {""};
    model *m = leaf(type, &s);
    run_state run;
    run_state_begin(&run, m, 1, &f);
    equations eq = {.m = m, .run = &run};
    model_state *state;
    strain_update *c;
    const size_t n = (size_t)model_strains(m);
    gsl_test(kinematics_state_alloc(m, &state, &f) != STATUS_OK ||
                 strain_update_alloc(&eq, &c, &f) != STATUS_OK || c == NULL,
             "%s has stresses that are not linear", type->name);
    strain_update_begin(c, state);
    for (int i = 0; i < ELEMENTS; i++)
        load(m, i, i == 3 ? 0 : angle, &state->sigma[(size_t)i * n], &state->e[(size_t)i * n]);
    double linear[ELEMENTS * MOST];
    memcpy(linear, state->e, ELEMENTS * n * sizeof *linear);
    strain_update_apply(c, state, 1, 1);
    for (int i = 0; i < ELEMENTS; i++) {
        const double *e = &state->e[(size_t)i * n], *goal = &state->sigma[(size_t)i * n],
                     *first = &linear[(size_t)i * n], size = largest(model_strains(m), goal, NULL);
        double sigma[MOST], C[MOST * MOST];
        if (i == 3) {
            gsl_test(memcmp(e, first, n * sizeof *e) != 0, "what agrees keeps its bits");
            continue;
        }
        evaluate(m, i, first, sigma, C);
        gsl_test(!(largest(model_strains(m), sigma, goal) > 10 * size),
                 "%s: linear strains have false stresses (%g of %g N)", type->name,
                 largest(model_strains(m), sigma, goal), size);
        evaluate(m, i, e, sigma, C);
        gsl_test(!(largest(model_strains(m), sigma, goal) <= 0.1 * size),
                 "%s, %g rad: stresses as given (%g of %g N)", type->name, angle,
                 largest(model_strains(m), sigma, goal), size);
        gsl_test(!(fabs(e[4] / first[4] - 1) < 0.2 && fabs(e[5] / first[5] - 1) < 0.2),
                 "%s, %g rad: bent as much (%g, %g)", type->name, angle, e[4] / first[4],
                 e[5] / first[5]);
    }
    again(&eq, c, state);
    strain_update_free(c);
    kinematics_state_free(state);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

static void keep(void)
{
    scene s;
    fault f = {""};
    model *m = leaf(&element_beamw_consistent, &s);
    run_state run;
    run_state_begin(&run, m, 1, &f);
    equations eq = {.m = m, .run = &run};
    model_state *state;
    strain_update *c;
    if (kinematics_state_alloc(m, &state, &f) == STATUS_OK &&
        strain_update_alloc(&eq, &c, &f) == STATUS_OK) {
        const size_t n = (size_t)(ELEMENTS * model_strains(m));
        double before[ELEMENTS * MOST];
        strain_update_begin(c, state);
        for (size_t i = 0; i < n; i++) {
            before[i] = state->e[i] = 1e-3 * (double)(i % 7);
            state->sigma[i] = i % 2 ? NAN : 1e300;
        }
        strain_update_apply(c, state, 1, 1);
        gsl_test(memcmp(before, state->e, n * sizeof *before) != 0, "what is not found stays");
        strain_update_free(c);
        kinematics_state_free(state);
    }
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

static void leave(const element_type *type, const char *why)
{
    scene s;
    fault f = {""};
    model *m = leaf(type, &s);
    run_state run;
    run_state_begin(&run, m, 1, &f);
    equations eq = {.m = m, .run = &run};
    strain_update *c;
    gsl_test(strain_update_alloc(&eq, &c, &f) != STATUS_OK || c != NULL, "%s: %s", type->name, why);
    strain_update_begin(c, NULL);
    strain_update_apply(c, NULL, 1, 1);
    strain_update_free(c);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

static void strain_update_tests(void)
{
    for (double angle = 0.02; angle < 0.5; angle *= 2) {
        take(&element_beamw_consistent, angle);
        take(&element_beamw, angle);
    }
    keep();
    leave(&element_geometrically_exact, "its stresses are linear");
    leave(&element_collocation, "it has unknowns of its own");
}

enum { MASSLESS_MOST = 80 };

/* Warping amplitudes of a free member with an I-section must be treated as massless if and only if
 * they have no mass. `omit` is the omitted physics; heavy 1: warping amplitudes have mass. */
static void warps(unsigned omit, int heavy)
{
    static const double y[3] = {0, 1, 0}, point[][2] = {{-0.03, 0.05},  {0, 0.05},  {0.03, 0.05},
                                                        {-0.03, -0.05}, {0, -0.05}, {0.03, -0.05}},
                        thick[] = {2e-3, 2e-3, 1e-3, 2e-3, 2e-3};
    static const int walls[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    section_spec spec = section_spec_walls(2e11, 8e10, 5, point, walls, thick);
    formulation chosen;
    scene s;
    model *m = NULL;
    frame_masses masses;
    fault f = {""};
    double force[MASSLESS_MOST], motion[MASSLESS_MOST], given[MASSLESS_MOST], a[MASSLESS_MOST];
    const double end = 1;
    int massless = 0, seen = 0;
    spec.density = 7800;
    scene_init(&s, "bar");
    const int p = scene_add_node(&s, 0, 0, 0), q = scene_add_node(&s, 1, 0, 0);
    scene_add_member(&s, p, q, scene_add_section(&s, &spec), y);
    scene_omit(&s, omit);
    scene_add_motion(&s, SCENE_NONE, 1, &end,
                     (scene_motion){.step = 1, .start = {.velocity = {0}}});
    gsl_test(formulation_parse("beamw_consistent", &chosen, &f) != STATUS_OK, "%s", f.text);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 2};
    if (model_alloc(&request, &m, &f) != STATUS_OK ||
        frame_masses_alloc(m, &masses, &f) != STATUS_OK) {
        gsl_test(1, "%s", f.text);
        return;
    }
    const model_state *rest = kinematics_rest(m);
    for (int c = 0; c < model_unknowns(m); c++)
        force[c] = motion[c] = given[c] = 2;
    massless_count(m, &masses, rest, &massless, &f);
    massless_forces(m, &masses, rest, force, &f);
    massless_motion(m, &masses, rest, motion, &f);
    massless_accelerate(m, &masses, rest, given, a, &f);
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        const double mass = masses.warping[c];
        gsl_test((mass > 0) != heavy, "warping %d has mass: %g", w, mass);
        gsl_test_abs(force[c], heavy ? 0 : 2, 0, "force on warping %d, heavy: %d", w, heavy);
        gsl_test_abs(motion[c], heavy ? 0 : 2, 0, "motion of warping %d, heavy: %d", w, heavy);
        gsl_test_abs(a[c], heavy ? 2 / mass : 0, 1e-12 * fabs(a[c]), "acceleration of warping %d",
                     w);
        seen++;
    }
    gsl_test_int(seen, 3, "warping amplitudes");
    gsl_test((massless == 0) != heavy, "%d coordinates have no inertia, heavy: %d", massless,
             heavy);
    frame_masses_free(&masses);
    model_free(m);
    scene_free(&s);
}

static void scheme_massless_tests(void)
{
    warps(0, 1);
    warps(FEATURE_ROTARY_INERTIA, 0);
}

int main(void)
{
    account_tests();
    strain_update_tests();
    scheme_massless_tests();
    return gsl_test_summary();
}
