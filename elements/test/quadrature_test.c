/* Points and weights of Gauss rules must be exact to round-off, also if threads and forked
 * processes request tables simultaneously. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <pthread.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "elements/math/scalar.h"

enum { MOST = QUADRATURE_MAX_POINTS, THREADS = 8 };

typedef struct quadrature_rule {
    double x[MOST], w[MOST];
} quadrature_rule;

/* Checks, in long double, that Newton's correction of the points is zero and that the weights are
 * 2/((1 - z^2) P'^2). */
static void against_polynomial(int n, const quadrature_rule *r)
{
    double apart = 0;
    for (int i = 0; i < n; i++) {
        const long double z = 2 * (long double)r->x[i] - 1;
        long double p = 1, before = 0;
        for (int k = 1; k <= n; k++) {
            const long double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
            before = p;
            p = next;
        }
        const long double slope = n * (z * p - before) / (z * z - 1), step = p / slope,
                          root = z - step, weight = 1 / ((1 - root * root) * slope * slope),
                          change =
                              2 * root / (1 - root * root) * step; /* from Legendre's equation */
        apart = fmax(apart, fabs((double)(step / 2)));
        apart = fmax(apart, fabs((double)(r->w[i] / weight * (1 - 2 * change) - 1)));
    }
    gsl_test(!(apart <= 2 * DBL_EPSILON), "%d points: %.1e from the polynomial's", n, apart);
}

static void monomials(int n, const quadrature_rule *r)
{
    double worst = 0;
    for (int degree = 0; degree < 2 * n; degree++) {
        double sum = 0;
        for (int i = 0; i < n; i++)
            sum += r->w[i] * pow(r->x[i], degree);
        worst = fmax(worst, fabs(sum * (degree + 1) - 1));
    }
    gsl_test(!(worst <= 1e-13), "%d points: %.1e of a monomial", n, worst);
    for (int i = 1; i < n; i++)
        gsl_test(!(r->x[i - 1] < r->x[i]), "%d points: point %d is in order", n, i);
}

static void *ask(void *out)
{
    quadrature_rule *r = out;
    quadrature_points(16, r->x, r->w);
    return NULL;
}

static void at_once(void)
{
    static quadrature_rule r[THREADS + 1], forked;
    pthread_t thread[THREADS];
    int started = 0, apart = 0, ends[2], ended = -1;
    while (started < THREADS && pthread_create(&thread[started], NULL, ask, &r[started]) == 0)
        started++;
    const pid_t child = pipe(ends) == 0 ? fork() : -1;
    if (child == 0) {
        ask(&forked);
        _exit(write(ends[1], &forked, sizeof forked) != (ssize_t)sizeof forked);
    }
    const ssize_t got = child > 0 ? read(ends[0], &forked, sizeof forked) : -1;
    if (child > 0)
        waitpid(child, &ended, 0);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
    ask(&r[THREADS]);
    for (int i = 0; i < started; i++)
        apart += memcmp(&r[i], &r[THREADS], sizeof r[i]) != 0;
    gsl_test(started < THREADS || apart > 0, "%d threads ask at once, %d differ", started, apart);
    gsl_test(ended != 0 || got != (ssize_t)sizeof forked ||
                 memcmp(&forked, &r[THREADS], sizeof forked) != 0,
             "a process forked meanwhile has the same");
}

int main(void)
{
    quadrature_rule r;
    at_once();
    for (int n = 1; n <= QUADRATURE_MAX_POINTS; n++)
        if (quadrature_is_tabulated(n)) {
            quadrature_points(n, r.x, r.w);
            against_polynomial(n, &r);
            monomials(n, &r);
        }
    return gsl_test_summary();
}
