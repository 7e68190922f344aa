#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

enum { MOST = 2 * MEANS_NODES - 1 };

/* Abscissas of Lobatto's rule with five points in [-1, 1], exact for polynomials of degree
 * seven. */
static const double node_of[MEANS_NODES] = {-1, -0.65465367070797714380, 0, 0.65465367070797714380,
                                            1},
                    weight_of[MEANS_NODES] = {1.0 / 10, 49.0 / 90, 32.0 / 45, 49.0 / 90, 1.0 / 10};

double means_node(double a, double b, int i)
{
    return i == 0 ? a : i == MEANS_NODES - 1 ? b : (a + b) / 2 + (b - a) / 2 * node_of[i];
}

double observer_value(observers *s, const observer *one, double time)
{
    return one->by_probe ? probe_steps_reading(&s->probe_steps, one->q, time)
                         : dense_output_reading(&s->inside, one->q, time, &s->at);
}

status observer_disagreement(observers *s, const observer *one, const motion_state *from,
                             double time, double *out, fault *f)
{
    const double here = observer_value(s, one, time);
    *out = 0;
    if (one->by_probe || reading_is_slope(one->q) || time <= from->time ||
        time >= s->inside.to->time)
        return STATUS_OK;
    const status outcome = probe_step(s->c, s->scheme, from, time, &s->at, f);
    if (outcome == STATUS_OK)
        *out = fabs(reading_of(s->c->model, one->q, s->at.state, s->at.v, s->at.a) - here);
    return outcome == STATUS_FAULT ? outcome : STATUS_OK;
}

static int is_square(const observer *one)
{
    return one->q->reduction == SCENE_RMS;
}

/* Returns the value to integrate. Squares are relative to the largest value so far, so they do not
 * overflow. */
static double integrand(const observer *one, double value)
{
    if (!is_square(one))
        return value;
    return one->largest > 0 ? pow(value / one->largest, 2) : 0;
}

static void rescale(observer *one, double value)
{
    if (!is_square(one) || !(fabs(value) > one->largest))
        return;
    const double times = pow(one->largest / fabs(value), 2);
    one->sum *= times;
    one->add_error *= times;
    one->worst *= times;
    one->largest = fabs(value);
}

/* Adds the integral from a to b by six-point Gauss quadrature, which is exact for squares of
 * fifth-degree polynomials. */
static void add_inside(observers *s, observer *one, double a, double b)
{
    static const double x[] = {0.23861918608319690863, 0.66120938646626451366,
                               0.93246951420315202781},
                        w[] = {0.46791393457269104739, 0.36076157304813860757,
                               0.17132449237917034504};
    const double half = (b - a) / 2, middle = (a + b) / 2;
    for (int i = 0; i < 3; i++)
        for (int side = -1; side <= 1; side += 2) {
            const double value = observer_value(s, one, middle + side * half * x[i]);
            rescale(one, value);
            one->sum += half * w[i] * integrand(one, value);
        }
}

static status check_inside(observers *s, observer *one, const motion_state *from, double a,
                           double b, fault *f)
{
    double error = 0;
    if (one->parts++ % 8 != 0)
        return STATUS_OK;
    TRY(observer_disagreement(s, one, from, (a + b) / 2, &error, f));
    one->apart = fmax(one->apart, error);
    return STATUS_OK;
}

static double lobatto(const observer *one, const means_part *p)
{
    double sum = 0;
    for (int i = 0; i < MEANS_NODES; i++)
        sum += weight_of[i] * integrand(one, p->value[i]);
    return sum * (p->time[MEANS_NODES - 1] - p->time[0]) / 2;
}

/* Returns the integral of the polynomial through all points, by five-point Gauss quadrature. */
static double whole_of(int points, const double t[], const double value[])
{
    static const double x[] = {-0.90617984593866399280, -0.53846931010568309104, 0,
                               0.53846931010568309104, 0.90617984593866399280},
                        w[] = {0.23692688505618908751, 0.47862867049936646804,
                               0.56888888888888888889, 0.47862867049936646804,
                               0.23692688505618908751};
    const double half = (t[points - 1] - t[0]) / 2, middle = (t[points - 1] + t[0]) / 2;
    double sum = 0, p[MOST];
    for (int g = 0; g < 5; g++) {
        const double at = middle + half * x[g];
        memcpy(p, value, (size_t)points * sizeof *p);
        for (int k = 1; k < points; k++)
            for (int i = 0; i + k < points; i++)
                p[i] = ((t[i + k] - at) * p[i] + (at - t[i]) * p[i + 1]) / (t[i + k] - t[i]);
        sum += half * w[g] * p[0];
    }
    return sum;
}

/* Returns 1 if part b starts at the end of part a, without a jump. */
static int continues(const means_part *a, const means_part *b)
{
    const double from = a->value[MEANS_NODES - 1], to = b->value[0];
    return a->time[MEANS_NODES - 1] == b->time[0] &&
           fabs(to - from) <= 1e-6 * fmax(fabs(from), fabs(to));
}

/* Returns the integral by Lobatto's rule minus the integral by Simpson's rule. */
static double apart_from_simpson(const observer *one, const means_part *p)
{
    const double simpson =
        integrand(one, p->value[0]) + 4 * integrand(one, p->value[2]) + integrand(one, p->value[4]);
    return lobatto(one, p) - simpson * (p->time[MEANS_NODES - 1] - p->time[0]) / 6;
}

/* Returns the difference of two integrals over two steps: that of the polynomial through all points
 * except the middle of each step, and that by Lobatto's rule. */
static double apart_from_both(const observer *one, const means_part *a, const means_part *b)
{
    double t[MOST], value[MOST];
    int points = 0;
    for (int i = 0; i < MOST; i++) {
        const means_part *from = i < MEANS_NODES ? a : b;
        const int k = i < MEANS_NODES ? i : i - MEANS_NODES + 1;
        if (k == MEANS_NODES / 2)
            continue;
        t[points] = from->time[k];
        value[points++] = integrand(one, from->value[k]);
    }
    return whole_of(points, t, value) - lobatto(one, a) - lobatto(one, b);
}

static void add_error(observer *one, const means_part *now)
{
    const int pairs = one->holds && continues(&one->past, now);
    if (pairs)
        one->add_error += apart_from_both(one, &one->past, now);
    one->worst = fmax(pairs && one->parts == 1 ? 0 : one->worst, fabs(one->add_error));
    if (one->parts == 0)
        one->worst = fabs(apart_from_simpson(one, now));
    one->parts = pairs ? 2 : one->parts > 0 ? one->parts : 1;
    one->past = *now;
    one->holds = !pairs;
}

static void add_from_probes(observers *s, observer *one, double a, double b)
{
    means_part now;
    for (int i = 0; i < MEANS_NODES; i++) {
        now.time[i] = means_node(a, b, i);
        now.value[i] = observer_value(s, one, now.time[i]);
        if (isnan(now.value[i])) {
            one->sum = NAN;
            return;
        }
        rescale(one, now.value[i]);
    }
    one->sum += lobatto(one, &now);
    add_error(one, &now);
}

status means_add(observers *s, observer *one, const motion_state *from, double a, double b,
                 fault *f)
{
    if (one->by_probe)
        add_from_probes(s, one, a, b);
    else {
        add_inside(s, one, a, b);
        TRY(check_inside(s, one, from, a, b, f));
    }
    one->span += b - a;
    one->blurred += one->blur * (b - a);
    const double mean = one->sum / one->span, error = one->worst / one->span,
                 apart = fmax(one->apart, one->blurred / one->span);
    *one->out = (outcome_passing){1, mean, b, fmax(error, apart)};
    if (is_square(one)) {
        const double root = sqrt(fmax(mean, 0));
        one->out->value = one->largest * root;
        one->out->error = fmax(apart, one->largest * (sqrt(fmax(mean, 0) + error) - root));
    }
    return STATUS_OK;
}
