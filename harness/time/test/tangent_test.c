/* The tangent of forces of inertia is their derivative, in the exponential chart, with rates that
 * follow the increments of a step of finite turns. */
#include "elements/test/worst.h"
#include "harness/model/model.h"
#include "harness/time/test/masses.h"
#include "harness/time/time_impl.h"

/* Rates follow the increments. */
static const double b = 7, g = 3;

static void force_at(const moving_one *o, const double inc[], const double from[], double out[])
{
    fault f = {""};
    model_state *s;
    double v[MOST], a[MOST];
    gsl_test(kinematics_state_alloc(o->m, &s, &f) != STATUS_OK, "%s", f.text);
    for (int c = 0; c < o->all; c++) {
        v[c] = o->v[c] + g * (inc[c] - from[c]);
        a[c] = o->a[c] + b * (inc[c] - from[c]);
    }
    increment_apply(o->m, o->rest, inc, 0, s);
    memset(out, 0, (size_t)o->all * sizeof *out);
    inertia_subtract(o->m, &o->masses, s, v, a, out);
    kinematics_state_free(s);
}

/* Moments in the exponential chart: half of their product with the increment comes on top. */
static void add_chart(const moving_one *o, const double out[], int column, double slope[])
{
    for (int i = 0; i < model_first_release(o->m); i++) {
        const int *at = model_vertex(o->m, i)->coordinate + SCENE_RX;
        if (model_vertex(o->m, i)->body != i)
            continue;
        for (int k = 0; k < 3; k++) {
            if (at[k] != column)
                continue;
            const int j = (k + 1) % 3, l = (k + 2) % 3;
            slope[at[j]] += out[at[l]] / 2; /* (M x e_k)/2 */
            slope[at[l]] -= out[at[j]] / 2;
        }
    }
}

static double entry(const sparse *S, int row, int column)
{
    for (int p = S->column[column]; p < S->column[column + 1]; p++)
        if (S->row[p] == row)
            return S->value[p];
    return 0;
}

static void tangent(const moving_one *o)
{
    const double small = 1e-5;
    const inertia_relation with = {b, g, o->inc};
    const sparse *pattern;
    sparse S;
    fault f = {""};
    double largest = 0, here[MOST];
    run_state run;
    run_state_begin(&run, o->m, 1, NULL);
    const equations eq = {.m = o->m, .run = &run};
    gsl_test(assemble_pattern_in_time(o->m, run.patterns, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &S, &f) != STATUS_OK,
             "%s", f.text);
    inertia_add_tangent(&eq, &o->masses, o->now, o->v, o->a, &with, &S);
    force_at(o, o->inc, o->inc, here);
    for (int c = 0; c < model_unknowns(o->m); c++) {
        double side[2][MOST], slope[MOST];
        for (int k = 0; k < 2; k++) {
            double dx[MOST] = {0}, inc[MOST];
            dx[c] = k ? small : -small;
            memcpy(inc, o->inc, sizeof inc);
            increment_add(o->m, o->now, dx, inc);
            force_at(o, inc, o->inc, side[k]);
        }
        for (int r = 0; r < model_unknowns(o->m); r++)
            slope[r] = (side[1][r] - side[0][r]) / (2 * small);
        add_chart(o, here, c, slope);
        for (int r = 0; r < model_unknowns(o->m); r++)
            largest = worst_of(largest, fabs(entry(&S, r, c) + slope[r]));
    }
    gsl_test(!(largest < 1e-8), "the tangent is the derivative (%g)", largest);
    sparse_free_values(&S);
    run_state_end(&run);
}

int main(void)
{
    static const element_type *const type[] = {&element_collocation, &element_geometrically_exact,
                                               &element_beamw_consistent};
    moving_one o;
    for (int i = 0; i < 3; i++) {
        begin(&o, type[i], 0);
        tangent(&o);
        end(&o);
    }
    return gsl_test_summary();
}
