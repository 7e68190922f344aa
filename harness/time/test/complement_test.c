/* Strains from stresses: a member that is a million times stiffer in elongation than in bending
 * takes the stresses it is given, also where Newton does not find them at once; elements that have
 * them already keep their bits; and types whose stresses are linear are left alone. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/time_impl.h"

extern const element_type element_beamw_consistent, element_beamw, element_geometrically_exact,
    element_collocation;

enum { ELEMENTS = 9, MOST = ELEMENT_MAX_STRAINS }; /* more than go in one go */

/* A long thin leaf along x. */
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

/* Stresses of element i: bending by `angle`, a little twist, hardly any elongation; and the strains
 * that a linear law has for them. */
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

static long looks(const equations *eq, complement *c, model_state *s, int iteration,
                  double correction)
{
    const long before = eq->run->counters.stress_evaluations;
    complement_strains(c, s, iteration, correction);
    return eq->run->counters.stress_evaluations - before;
}

/* All elements agree: looked at again after larger corrections and in a new step alone. */
static void again(const equations *eq, complement *c, model_state *s)
{
    gsl_test(looks(eq, c, s, 2, 0.5) != ELEMENTS, "some did not agree before: all are looked at");
    gsl_test(looks(eq, c, s, 3, 0.1) != 0, "a smaller correction is not looked at");
    gsl_test(looks(eq, c, s, 4, 0.6) != ELEMENTS, "a larger one is");
    gsl_test(looks(eq, c, s, 1, 0.1) != ELEMENTS, "and the first of a step");
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
    complement *c;
    const size_t n = (size_t)model_strains(m);
    gsl_test(kinematics_state_alloc(m, &state, &f) != STATUS_OK ||
                 complement_alloc(&eq, &c, &f) != STATUS_OK || c == NULL,
             "%s has stresses that are not linear", type->name);
    complement_keep(c, state);
    for (int i = 0; i < ELEMENTS; i++)
        load(m, i, i == 3 ? 0 : angle, &state->sigma[(size_t)i * n], &state->e[(size_t)i * n]);
    double linear[ELEMENTS * MOST];
    memcpy(linear, state->e, ELEMENTS * n * sizeof *linear);
    complement_strains(c, state, 1, 1);
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
    complement_free(c);
    kinematics_state_free(state);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

/* What cannot be found stays. */
static void keep(void)
{
    scene s;
    fault f = {""};
    model *m = leaf(&element_beamw_consistent, &s);
    run_state run;
    run_state_begin(&run, m, 1, &f);
    equations eq = {.m = m, .run = &run};
    model_state *state;
    complement *c;
    if (kinematics_state_alloc(m, &state, &f) == STATUS_OK &&
        complement_alloc(&eq, &c, &f) == STATUS_OK) {
        const size_t n = (size_t)(ELEMENTS * model_strains(m));
        double before[ELEMENTS * MOST];
        complement_keep(c, state);
        for (size_t i = 0; i < n; i++) {
            before[i] = state->e[i] = 1e-3 * (double)(i % 7);
            state->sigma[i] = i % 2 ? NAN : 1e300;
        }
        complement_strains(c, state, 1, 1);
        gsl_test(memcmp(before, state->e, n * sizeof *before) != 0, "what is not found stays");
        complement_free(c);
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
    complement *c;
    gsl_test(complement_alloc(&eq, &c, &f) != STATUS_OK || c != NULL, "%s: %s", type->name, why);
    complement_keep(c, NULL);
    complement_strains(c, NULL, 1, 1);
    complement_free(c);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    for (double angle = 0.02; angle < 0.5; angle *= 2) {
        take(&element_beamw_consistent, angle);
        take(&element_beamw, angle);
    }
    keep();
    leave(&element_geometrically_exact, "its stresses are linear");
    leave(&element_collocation, "it has unknowns of its own");
    return gsl_test_summary();
}
