/* What runs between two instants comes to both of them: places, shifts, angles, warping, rates and
 * accelerations, of bodies, sequences of angles and released ends, turned by half a radian. */
#include "harness/model/model.h"
#include "harness/time/time.h"

#include "elements/test/worst.h"
#include "harness/time/test/masses.h"

static void rates_of(const moving_one *o, uint64_t seed, instant *at)
{
    some(o->all, 1, &seed, at->v);
    some(o->all, 3, &seed, at->a);
}

static double apart(size_t count, const double a[], const double b[])
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = worst_of(largest, fabs(a[i] - b[i]));
    return largest;
}

/* Ends that turn freely have no rates inside a step. */
static double rates_apart(const model *m, const double a[], const double b[])
{
    double largest = 0;
    for (int i = 0; i < model_vertices(m); i++)
        for (int k = 0; k < 6; k++) {
            const int c = model_vertex(m, i)->coordinate[k];
            const int ball = i >= model_first_release(m) && forms_of(m, i) == FORM_BODY;
            if (c != NONE && (model_vertex(m, i)->body == i ||
                              (i >= model_first_release(m) && !(ball && k > 2))))
                largest = worst_of(largest, fabs(a[c] - b[c]));
        }
    for (int i = 0; i < model_warps(m); i++)
        largest = worst_of(largest, fabs(a[model_warp(m, i)] - b[model_warp(m, i)]));
    return largest;
}

static double places_apart(const model *m, const model_state *a, const model_state *b)
{
    const size_t n = (size_t)model_vertices(m);
    double largest = apart(3 * n, a->u, b->u);
    largest = worst_of(largest, apart(3 * n, a->angle, b->angle));
    largest = worst_of(largest, apart(3 * (size_t)model_releases(m), a->shift, b->shift));
    largest = worst_of(largest, apart((size_t)model_warps(m), a->warp, b->warp));
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (int k = 0; k < 4; k++)
            sum += a->q[4 * i + (size_t)k] * b->q[4 * i + (size_t)k];
        largest = worst_of(largest, sqrt(fmax(0, 1 - sum * sum)) < 2e-8 ? 0 : 1);
    }
    return largest;
}

static void run(const moving_one *o, between_degree degree)
{
    const double h = 0.3;
    instant from, to, at;
    step_between inside;
    run_state loaded;
    fault f = {""};
    uint64_t seed = 31;
    double inc[MOST];
    run_state_begin(&loaded, o->m, 1, NULL);
    const equations eq = {.m = o->m, .run = &loaded};
    gsl_test(instant_alloc(o->m, &from, &f) != STATUS_OK ||
                 instant_alloc(o->m, &to, &f) != STATUS_OK ||
                 instant_alloc(o->m, &at, &f) != STATUS_OK ||
                 between_alloc(&eq, &inside, &f) != STATUS_OK,
             "%s", f.text);
    kinematics_state_copy(o->m, o->now, from.state);
    some(o->all, 0.4, &seed, inc);
    kinematics_state_copy(o->m, o->now, to.state);
    increment_apply(o->m, o->now, inc, 0, to.state);
    from.time = 1;
    to.time = 1 + h;
    rates_of(o, 5, &from);
    rates_of(o, 6, &to);
    between_take(&inside, degree, &from, &to);
    for (int k = 0; k < 2; k++) {
        const instant *expected = k ? &to : &from;
        between_at(&inside, expected->time, &at);
        const double places = places_apart(o->m, at.state, expected->state),
                     rates = rates_apart(o->m, at.v, expected->v),
                     second = rates_apart(o->m, at.a, expected->a);
        gsl_test(!(places < 1e-13), "%s: places at end %d (%g)", model_type(o->m)->name, k, places);
        gsl_test(!(rates < 1e-12), "%s: rates at end %d (%g)", model_type(o->m)->name, k, rates);
        gsl_test(!(second < 1e-10), "%s: accelerations at end %d (%g)", model_type(o->m)->name, k,
                 second);
    }
    between_at(&inside, 1 + h / 2, &at);
    gsl_test(!(places_apart(o->m, at.state, from.state) > 0.01), "%s: half of the way",
             model_type(o->m)->name);
    between_free(&inside);
    run_state_end(&loaded);
    instant_free(&from);
    instant_free(&to);
    instant_free(&at);
}

int main(void)
{
    static const element_type *const type[] = {&element_collocation, &element_beamw_consistent};
    moving_one o;
    for (int i = 0; i < 4; i++) {
        begin(&o, type[i % 2], i / 2);
        run(&o, BETWEEN_CUBIC);
        run(&o, BETWEEN_QUINTIC);
        end(&o);
    }
    return gsl_test_summary();
}
