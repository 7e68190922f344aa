#include "harness/numerics/gyroscopic_index.h"

#include <math.h>
#include <stddef.h>

/* x^H (K + |lambda|^2 M) x, in parts of the sizes of its terms; c^H c = 1 is x^H (K + shift M) x.
 */
static double index_energy(const ritz *r, const subspace *b, double shift, int i)
{
    const double complex *c = r->c + (size_t)i * (size_t)b->room;
    const double size = cabs(r->lambda[i]);
    double unit = 0, mass = 0;
    for (int j = 0; j < r->size; j++) {
        double complex sum = 0;
        for (int k = 0; k < r->size; k++)
            sum += b->Mp[j * b->room + k] * c[k];
        unit += creal(conj(c[j]) * c[j]);
        mass += creal(conj(c[j]) * sum);
    }
    const double potential = unit - shift * mass, kinetic = size * size * mass;
    return (potential + kinetic) / (fabs(potential) + kinetic);
}

/* Energies below this part are none. */
static const double no_energy = 1e-6;
/* Real parts of this part of lambda are growth, whatever rounding does. */
static const double clear_growth = 1e-3;

int gyroscopic_index_grows(const ritz *r, const subspace *b, double shift, int i)
{
    const double part = fabs(creal(r->lambda[i])) / cabs(r->lambda[i]);
    return part > clear_growth ||
           (part > ritz_imaginary && fabs(index_energy(r, b, shift, i)) <= no_energy);
}

gyroscopic_index gyroscopic_index_of(const ritz *r, const subspace *b, double shift, int count)
{
    gyroscopic_index out = {0, 0};
    for (int i = 0; i < count; i++) {
        const double complex lambda = r->lambda[i];
        if (gyroscopic_index_grows(r, b, shift, i)) {
            out.negative += fabs(cimag(lambda)) > ritz_imaginary * cabs(lambda) ? 2 : 1;
            continue;
        }
        const double e = index_energy(r, b, shift, i);
        out.negative += e < -no_energy ? 2 : 0;
        out.crossed += (e > no_energy) - (e < -no_energy);
    }
    return out;
}
