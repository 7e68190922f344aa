/* Spectra of time histories. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "elements/math/scalar.h"

/* Work space of a discrete Fourier transform of `whole` values. */
typedef struct fourier {
    size_t whole;
    double complex *unit; /* [whole] exp(-2 pi i n/whole) */
    double complex *room; /* [whole] */
} fourier;

static size_t least_factor(size_t n)
{
    for (size_t p = 2; p * p <= n; p++)
        if (n % p == 0)
            return p;
    return n;
}

/* Computes the transform out[n] of x[0], x[stride], ..., by combining the transforms of its
 * interleaved parts. */
static void transform(const fourier *t, size_t n, size_t stride, const double complex x[],
                      double complex out[])
{
    if (n == 1) {
        out[0] = x[0];
        return;
    }
    const size_t p = least_factor(n), part = n / p, step = t->whole / n;
    for (size_t j = 0; j < p; j++)
        transform(t, part, stride * p, x + j * stride, out + j * part);
    for (size_t k = 0; k < n; k++) {
        t->room[k] = 0;
        for (size_t j = 0; j < p; j++)
            t->room[k] += out[j * part + k % part] * t->unit[j * k % n * step];
    }
    for (size_t k = 0; k < n; k++)
        out[k] = t->room[k];
}

static double weight_of(const scene_quantity *q, int i, int count)
{
    const double s = sin(PI * i / count);
    return q->passing.taper == SCENE_TAPER_HANN ? s * s : 1;
}

static void put(const scene_quantity *q, int count, double step, const double complex x[],
                quantity_result *r)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        sum += weight_of(q, i, count);
        squares += weight_of(q, i, count) * weight_of(q, i, count);
    }
    for (int k = 0; k <= count / 2; k++) {
        const double sides = k == 0 || 2 * k == count ? 1 : 2, size = cabs(x[k]);
        r->curve.x[k] = quantity_abscissa(q, k / (count * step));
        r->curve.value[k] =
            q->transform == SCENE_PSD ? sides * step * size * size / squares : sides * size / sum;
    }
    r->value = r->curve.value[count / 2];
}

void spectrum_take(const scene_quantity *q, int count, double step, const double value[],
                   quantity_result *r)
{
    const size_t n = (size_t)count;
    double complex *all = calloc(4 * n + 1, sizeof *all);
    const fourier t = {n, all, all + n};
    double complex *x = t.room + n, *out = x + n;
    if (all == NULL)
        quantity_no_value(r, STATUS_FAULT, "out of memory for a spectrum");
    if (all != NULL && quantity_curve(r, count / 2 + 1)) {
        for (size_t i = 0; i < n; i++) {
            t.unit[i] = cexp(-2 * PI * I * (double)i / (double)n);
            x[i] = weight_of(q, (int)i, count) * value[i];
        }
        transform(&t, n, 1, x, out);
        put(q, count, step, out, r);
    }
    free(all);
}
