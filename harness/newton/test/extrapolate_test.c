/* The guess of the next state of a path: exact for as smooth a path as the states that are kept
 * allow, and no longer than they do. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "elements/math/rotation.h"
#include "elements/test/random.h"
#include "elements/test/worst.h"
#include "harness/model/model.h"
#include "harness/model/test/corner.h"
#include "harness/newton/newton.h"

enum { MOST_DEGREE = MODEL_EXTRAPOLATED };

/* A path of that degree in its parameter; every vertex turns about an axis of its own. */
static void extrapolate_fill(const model *m, int degree, double path, model_state *s)
{
    uint64_t seed = 42;
    s->path = path;
    for (size_t k = 0; k < s->size; k++) {
        double value = 0;
        for (int p = 0; p <= MOST_DEGREE; p++) {
            const double c = random_number(&seed);
            value += p <= degree ? c * pow(path, p) : 0;
        }
        s->block[k] = value;
    }
    for (int v = 0; v < model_vertices(m); v++) {
        double turn[3], angle = 0;
        for (int p = 1; p <= degree; p++)
            angle += 0.3 / p * pow(path, p);
        for (int c = 0; c < 3; c++)
            turn[c] = angle * random_number(&seed);
        rotation_exp(turn, &s->q[4 * v]);
    }
}

/* Largest difference in what has coordinates of its own. */
static double apart(const model *m, const model_state *a, const model_state *b)
{
    double worst = 0;
    for (int v = 0; v < model_vertices(m); v++) {
        double turn[3];
        if (model_vertex(m, v)->body != v)
            continue;
        rotation_between(&a->q[4 * v], &b->q[4 * v], turn);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fmax(fabs(a->u[3 * v + c] - b->u[3 * v + c]), fabs(turn[c])));
    }
    for (int i = 0; i < model_elements(m) * model_strains(m); i++)
        worst = worst_of(worst, fmax(fabs(a->e[i] - b->e[i]), fabs(a->sigma[i] - b->sigma[i])));
    return worst;
}

/* Error of the guess at `to` after states at path[count] of a path of that degree, which turns back
 * at a kink. */
static double error_of_guess(const model *m, int degree, double kink, int count,
                             const double path[], double to)
{
    predictor t;
    run_state run;
    model_state *s, *exact;
    fault f = {""};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    gsl_test(predictor_alloc(m, &t, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &s, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &exact, &f) != STATUS_OK,
             "states: %s", f.text);
    for (int i = 0; i < count; i++) {
        extrapolate_fill(m, degree, fabs(path[i] - kink), s);
        s->path = path[i];
        gsl_test(predictor_add(&eq, s, 3, &t, &f) != STATUS_OK, "a state: %s", f.text);
    }
    predictor_guess(&eq, &t, to, s);
    run_state_end(&run);
    extrapolate_fill(m, degree, fabs(to - kink), exact);
    const double error = apart(m, s, exact);
    predictor_free(&t);
    kinematics_state_free(s);
    kinematics_state_free(exact);
    return error;
}

/* Steps of different lengths, more of them than are kept. */
static void smooth_paths(const model *m)
{
    static const double path[] = {0.04, 0.09, 0.15, 0.2,  0.26, 0.33, 0.39, 0.46,
                                  0.53, 0.6,  0.68, 0.75, 0.83, 0.9,  0.98};
    for (int count = MODEL_EXTRAPOLATED + 1; count <= 14; count++)
        for (int degree = 0; degree <= MOST_DEGREE; degree++) {
            const double error = error_of_guess(m, degree, 0, count, path, path[count]);
            if (degree < MODEL_EXTRAPOLATED)
                gsl_test(!(error < 1e-11), "degree %d after %d steps: error %.1e", degree, count,
                         error);
            else
                gsl_test(!(error > 1e-6), "degree %d after %d steps: no guess is exact (%.1e)",
                         degree, count, error);
        }
}

/* A step half as long again as the last one is the longest that is guessed. */
static void long_steps(const model *m)
{
    static const double path[] = {0.1, 0.2, 0.3, 0.4, 0.5};
    const double within = error_of_guess(m, 2, 0, 5, path, 0.5 + 0.149),
                 beyond = error_of_guess(m, 2, 0, 5, path, 0.5 + 0.151);
    gsl_test(!(within < 1e-13), "a longer step is guessed (%.1e)", within);
    gsl_test(!(beyond > 1e-3), "a much longer one starts where the last ended (%.1e)", beyond);
}

/* Two states behind a kink a line goes on from them, whatever came before. */
static void kinks(const model *m)
{
    static const double path[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
    const double error = error_of_guess(m, 1, 0.45, 7, path, 0.8);
    gsl_test(!(error < 1e-12), "behind a kink: error %.1e", error);
}

int main(void)
{
    scene s;
    model *m = NULL;
    if (corner("geometrically_exact", 2, 0, &s, &m)) {
        smooth_paths(m);
        long_steps(m);
        kinks(m);
    }
    model_free(m);
    scene_free(&s);
    return gsl_test_summary();
}
