#include "harness/algebra/gyroscopic_index.h"

#include <math.h>
#include <stddef.h>

/* x^H (K + omega^2 M) x = c^H c + (omega^2 - shift) c^H Mp c, beside c^H c = 1. */
static double energy(const ritz *r, const subspace *b, double shift, int i)
{
    const double complex *c = r->c + (size_t)i * (size_t)b->room;
    const double omega = cimag(r->lambda[i]);
    double unit = 0, mass = 0;
    for (int j = 0; j < r->size; j++) {
        double complex sum = 0;
        for (int k = 0; k < r->size; k++)
            sum += b->Mp[j * b->room + k] * c[k];
        unit += creal(conj(c[j]) * c[j]);
        mass += creal(conj(c[j]) * sum);
    }
    return unit + (omega * omega - shift) * mass;
}

/* Energies below this part are neither: two frequencies that meet. */
static const double no_energy = 1e-7;

gyroscopic_index gyroscopic_index_of(const ritz *r, const subspace *b, double shift, int count)
{
    gyroscopic_index out = {0, 0};
    for (int i = 0; i < count; i++) {
        const double complex lambda = r->lambda[i];
        const double tiny = ritz_imaginary * cabs(lambda);
        if (fabs(creal(lambda)) > tiny) {
            out.negative += fabs(cimag(lambda)) > tiny ? 2 : 1;
            continue;
        }
        const double e = energy(r, b, shift, i);
        out.negative += e < -no_energy ? 2 : 0;
        out.crossed += (e > no_energy) - (e < -no_energy);
    }
    return out;
}
