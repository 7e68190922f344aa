/* The balance of energy is a verdict: what is allowed is, what is not ends a motion with one line;
 * what acts from outside is in it, whatever the kind, with every integrator. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/time/time.h"
#include "harness/tools/kit/scenes.h"

#define SWUNG "harness/time/test/swung.yaml"

extern const case_type case_free_flight_space, case_elbow;

static const struct {
    const char *name, *values;
} account_kind[] = {{"free", "base=free"},
                    {"driven base", "base=driven;thrown=0"},
                    {"turned base", "base=turned;thrown=0"},
                    {"damped", "damping=0.05"},
                    {"follower", "load=follower"},
                    {"goes on", "parts=2;middle=0.6"}};
enum { DAMPED = 3, KINDS = sizeof account_kind / sizeof account_kind[0] };

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
            scenes_solve(SWUNG, "collocation", 1, &r, "%s;integrator=%s;step=%.17g;tolerance=%g",
                         account_kind[k].values, scenes_integrator[by], step, adapts ? 1e-6 : 0);
            off = missing(&r.solve, &turned);
            gsl_test(!(off < (adapts ? fmax(most, 1e-4) : most)), "scheme %d, %s%s: %g of it", by,
                     account_kind[k].name, adapts ? ", adaptive" : "", off);
            gsl_test(!(turned > 0.01), "scheme %d, %s: work is done (%g)", by, account_kind[k].name,
                     turned);
            const double *last = r.solve.motion[r.solve.motions - 1].at.balance;
            gsl_test((k == DAMPED) != (last[SCENE_DISSIPATED] > 1e-3 * last[SCENE_ENERGY]),
                     "scheme %d, %s: %g J dissipated of %g J", by, account_kind[k].name,
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
