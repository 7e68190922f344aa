#include "harness/formulations/stencil.h"

#include <string.h>

/* out += weight (f at the place). */
static int add(stencil_function *f, const void *context, int count, int i, double si, int j,
               double sj, double weight, double out[])
{
    double values[STENCIL_MOST];
    const int outcome = f(context, i, si, j, sj, values);
    for (int k = 0; k < count && outcome == 0; k++)
        out[k] += weight * values[k];
    return outcome;
}

int stencil_first(stencil_function *f, const void *context, int count, int i, double out[])
{
    static const double weight[] = {45. / 60, -9. / 60, 1. / 60};
    int outcome = 0;
    memset(out, 0, (size_t)count * sizeof *out);
    for (int k = 0; k < 3 && outcome == 0; k++) {
        const double h = (k + 1) * stencil_first_step, w = weight[k] / stencil_first_step;
        outcome = add(f, context, count, i, h, i, 0, w, out);
        if (outcome == 0)
            outcome = add(f, context, count, i, -h, i, 0, -w, out);
    }
    return outcome;
}

int stencil_second(stencil_function *f, const void *context, int count, int i, int j, double out[])
{
    /* of differences with steps h, 2 h and 3 h, whose errors go with even powers of h */
    static const double weight[] = {3. / 2, -3. / 5, 1. / 10};
    int outcome = 0;
    memset(out, 0, (size_t)count * sizeof *out);
    for (int k = 0; k < 3; k++)
        for (int sign = 0; sign < 4 && outcome == 0; sign++) {
            const double h = (k + 1) * stencil_second_step / (i == j ? 2 : 1);
            const double si = sign & 1 ? -h : h, sj = sign & 2 ? -h : h;
            const double w = weight[k] / (4 * h * h) * (si * sj > 0 ? 1 : -1);
            outcome = add(f, context, count, i, si, j, sj, w, out);
        }
    return outcome;
}
