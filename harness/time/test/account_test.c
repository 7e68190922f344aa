/* The balance of energy is a verdict: what is allowed is, what is not ends a motion with one line;
 * what acts from outside is in it, whatever the kind, with every integrator. */
#include <math.h>
#include <string.h>

#include "harness/time/account.h"
#include "harness/time/test/swung.h"

extern const case_type case_free_flight_space, case_elbow;

enum { INTEGRATOR, STEP, TOLERANCE, KIND, RADIUS, PARAMETERS };
typedef enum kind { FREE, DRIVEN, TURNED, DAMPED, FOLLOWED, PARTED, KINDS } kind;
static const char *const kind_name[] = {"free",   "driven base", "turned base",
                                        "damped", "follower",    "goes on"};

static void drive(scene *s, int node, int component, const char *name, const char *function)
{
    const int driver = scene_add_moving_driver(s, name);
    scene_drive_piece(s, driver, 0, function);
    scene_drive(s, node, component, driver);
}

static status build(const double value[], scene *s, fault *f)
{
    static const double middle[] = {0.6}, end[] = {1};
    const kind of_kind = (kind)value[KIND];
    (void)f;
    const swung of = swung_build(s);
    scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    how.tolerance = value[TOLERANCE];
    how.alpha = scene_alpha_of_radius(value[RADIUS]);
    if (of_kind == DRIVEN || of_kind == TURNED) {
        how.start = (scene_start){.spin = {0}};
        scene_hold(s, of.base, SCENE_UX, SCENE_RZ);
    }
    if (of_kind == DRIVEN)
        drive(s, of.base, SCENE_UY, "shift", "0.4*t^4");
    if (of_kind == TURNED)
        drive(s, of.base, SCENE_RZ, "turn", "1.5*t^4");
    if (of_kind == DAMPED)
        scene_member_at(s, of.member)->damping = 0.05;
    if (of_kind == FOLLOWED) {
        const int load = scene_add_load(s, SCENE_FORCE, of.tip, 0.5, -1, 2);
        scene_load_piece(s, load, 0, "sin(2*t)");
        scene_load_at(s, load)->follower = 1;
    }
    int motion = SCENE_NONE;
    if (of_kind == PARTED) {
        motion = scene_add_motion(s, motion, 1, middle, how);
        how.start = (scene_start){.spin = {0}};
    }
    motion = scene_add_motion(s, motion, 1, end, how);
    scene_add_quantity(s, "x", "m", motion, scene_coordinate(of.tip, SCENE_UX));
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.1, 1e-6, 1, NULL, "of it"},
    [TOLERANCE] = {"tolerance", "1", 0, 0, 1, NULL, "of the error of a step"},
    [KIND] = {"kind", "1", 0, 0, KINDS - 1, NULL, "of what acts"},
    [RADIUS] = {"rho", "1", 0.9, 0, 1, NULL, "spectral radius"},
    {0}};
static const case_type moved = {.name = "moved", .parameters = {table}, .build = build};

/* What is missing at most of the last motion, by account_size; *turned: the work by the energy. */
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

/* Of steps as they are; with a tolerance as good at least as that. */
static void balanced(scene_scheme by, double step, double most)
{
    for (int k = 0; k < KINDS; k++) {
        if (k == DAMPED && by == SCENE_EXPLICIT)
            continue;
        for (int adapts = 0; adapts < 2; adapts++) {
            cell_result r;
            double turned, off;
            swung_solve(&moved, (const double[]){by, step, adapts ? 1e-6 : 0, k, 0.9}, PARAMETERS,
                        &r);
            off = missing(&r.solve, &turned);
            gsl_test(!(off < (adapts ? fmax(most, 1e-4) : most)), "scheme %d, %s%s: %g of it", by,
                     kind_name[k], adapts ? ", adaptive" : "", off);
            gsl_test(!(turned > 0.01), "scheme %d, %s: work is done (%g)", by, kind_name[k],
                     turned);
            const double *last = r.solve.motion[r.solve.motions - 1].at.balance;
            gsl_test((k == DAMPED) != (last[SCENE_DISSIPATED] > 1e-3 * last[SCENE_ENERGY]),
                     "scheme %d, %s: %g J dissipated of %g J", by, kind_name[k],
                     last[SCENE_DISSIPATED], last[SCENE_ENERGY]);
            cell_result_free(&r);
        }
    }
}

/* Energy 10 J, work 2 J back and forth and as many as `turned` says; what is missing by it. */
static const struct {
    double drift, turned, rounding, rho, tolerance;
    scene_scheme by;
    const char *words; /* NULL: it is allowed */
} row[] = {
    {0.09, 0, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_ALPHA, "more energy than work was done, 1.1 % of 10 J"},
    {0.11, 0, 0, 0.5, 1e-4, SCENE_ALPHA, "smaller tolerance"},
    {0.11, 0, 0, 0.9, 0, SCENE_ALPHA, "smaller step"},
    {0.11, 0, 0, 0.9, 0, SCENE_RADAU, "smaller step"},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_EXPLICIT, "smaller tolerance"},
    {0.11, 0, 0, 0.9, 1e-4, SCENE_CONSERVING, "radau"},
    {0.11, 20, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {0.21, 20, 0, 0.9, 1e-4, SCENE_ALPHA, "1.1 % of 20 J"},
    {0.11, 0, 100, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {NAN, 0, 100, 0.9, 1e-4, SCENE_ALPHA, "nan"},
    {-0.9, 0, 0, 0.9, 1e-4, SCENE_ALPHA, NULL},
    {-1.1, 0, 0, 0.9, 1e-4, SCENE_ALPHA, "has lost 1.1 J of energy, 11 % of 10 J"},
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
        const status outcome = account_judge(&of, &how, 0.5, balance, row[i].rounding, &f);
        gsl_test((outcome == STATUS_OK) != (row[i].words == NULL), "row %d: %s", i, f.text);
        gsl_test(row[i].words != NULL && strstr(f.text, row[i].words) == NULL, "row %d: %s", i,
                 f.text);
        gsl_test(row[i].words != NULL && strstr(f.text, "at 0.5 s") == NULL, "row %d: when", i);
    }
}

/* A case by parameters "name=value;...", as `solve` runs it. */
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

/* Steps that do not resolve axial waves make energy: a motion ends there, or takes shorter ones. */
static void made(void)
{
    cell_result r;
    double turned;
    gsl_test(run(&case_free_flight_space,
                 "time=40;stiffening=1e4;integrator=alpha;tolerance=0;"
                 "step=0.2",
                 4, &r) != STATUS_NOT_CONVERGED,
             "long steps: not converged");
    gsl_test(strstr(r.solve.reason, "more energy than work was done") == NULL, "why: %s",
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

int main(void)
{
    judged();
    made();
    balanced(SCENE_ALPHA, 1 / 128.0, 2e-3);
    balanced(SCENE_RADAU, 1 / 64.0, 1e-5);
    balanced(SCENE_CONSERVING, 1 / 64.0, 1e-10);
    balanced(SCENE_EXPLICIT, 1 / 512.0, 1e-8);
    return gsl_test_summary();
}
