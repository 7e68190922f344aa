/* Two nodes and one point half way are what the geometrically exact elements measure: D - l0 e_x, D the chord in the axes of
 * the middle, and l0 psi.  On a screw D = (int from -1/2 to 1/2 of exp(x psi~) dx) U, so that with t = |psi|^2
 *   U = D + n(t) psi x (psi x D),  n = (1 - a/sin a)/t,  a = sqrt(t)/2. */
#include "elements/beamw/screw.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { STRAINS = 8, COORDINATES = 14, MEASURED = 6, POWERS = 12 };

/* a/sin a = 1 + sum power[k] t^(k + 1) */
static const double power[POWERS] = {
    0.041666666666666664,   0.0012152777777777778, 3.2035383597883595e-05, 8.202608300264551e-07,
    2.0835982071876168e-08, 5.281609967721337e-10, 1.3380902920268335e-11, 3.389576851489321e-13,
    8.585996549822947e-15,  2.174864550325223e-16, 5.509000201462976e-18,  1.3954463022310702e-19,
};

/* n and its first and second derivative. */
static void screw_factor(double t, double n[3])
{
    if (t < 1) { /* the closed form cancels */
        n[0] = n[1] = n[2] = 0;
        for (int k = POWERS - 1; k >= 0; k--) {
            n[2] = n[2] * t + 2 * n[1];
            n[1] = n[1] * t + n[0];
            n[0] = n[0] * t - power[k];
        }
        return;
    }
    const double a = sqrt(t) / 2, s = sin(a), c = cos(a), p = (s - a * c) / (s * s);
    const double slope = (a * s * s - 2 * c * (s - a * c)) / (s * s * s); /* of p, itself the slope of a/sin a */
    n[0] = (1 - a / s) / t;
    n[1] = -(p / (8 * a) + n[0]) / t;
    n[2] = -((slope - p / a) / (64 * a * a) + 2 * n[1]) / t;
}

/* A screw as measured: D and psi, b = psi x (psi x D). */
typedef struct screw {
    double D[3], psi[3], n[3], b[3];
    double along; /* psi . D */
} screw;

static screw screw_of(double l0, const double measured[MEASURED])
{
    screw w;
    for (int i = 0; i < 3; i++) {
        w.D[i] = measured[i] + (i == 0 ? l0 : 0);
        w.psi[i] = measured[3 + i] / l0;
    }
    const double t = vec3_dot(w.psi, w.psi);
    screw_factor(t, w.n);
    w.along = vec3_dot(w.psi, w.D);
    for (int i = 0; i < 3; i++)
        w.b[i] = w.psi[i] * w.along - t * w.D[i];
    return w;
}

/* T[3 x 6] = dU/d(measured). */
static void translation_gradient(double l0, const screw *w, double T[3 * MEASURED])
{
    const double t = vec3_dot(w->psi, w->psi);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double turn = (i == j ? w->along : 0) + w->psi[i] * w->D[j] - 2 * w->D[i] * w->psi[j];
            T[MEASURED * i + j] = (i == j) + w->n[0] * (w->psi[i] * w->psi[j] - (i == j ? t : 0));
            T[MEASURED * i + 3 + j] = (w->n[0] * turn + 2 * w->n[1] * w->b[i] * w->psi[j]) / l0;
        }
}

/* W[6 x 6] = second derivatives of f . U with respect to what is measured. */
static void translation_second(double l0, const screw *w, const double f[3], double W[MEASURED * MEASURED])
{
    const double t = vec3_dot(w->psi, w->psi), fD = vec3_dot(f, w->D), fp = vec3_dot(f, w->psi), fb = vec3_dot(f, w->b);
    double turn[3];
    for (int i = 0; i < 3; i++)
        turn[i] = f[i] * w->along + w->D[i] * fp - 2 * w->psi[i] * fD;
    memset(W, 0, MEASURED * MEASURED * sizeof *W);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double p = w->psi[i], q = w->psi[j];
            const double bent = w->n[0] * (f[i] * w->D[j] + w->D[i] * f[j] - (i == j ? 2 * fD : 0)) +
                                2 * w->n[1] * (p * turn[j] + turn[i] * q + (i == j ? fb : 0)) + 4 * w->n[2] * fb * p * q;
            const double mixed =
                w->n[0] * (f[i] * q + (i == j ? fp : 0) - 2 * p * f[j]) + 2 * w->n[1] * p * (w->psi[j] * fp - t * f[j]);
            W[MEASURED * (3 + i) + 3 + j] = bent / (l0 * l0);
            W[MEASURED * (3 + i) + j] = W[MEASURED * j + 3 + i] = mixed / l0;
        }
}

/* Rows of e [8 x n] from those of U [3 x n] and of l0 psi and l0^2 a [8 x n, the first three not used]. */
static void arrange(int n, const double U[], const double measured[], double e[])
{
    for (int k = 0; k < n; k++) {
        const double across[2] = {measured[4 * n + k] / 2, measured[5 * n + k] / 2};
        e[k] = U[k];
        e[1 * n + k] = measured[3 * n + k];
        e[2 * n + k] = across[0] - U[2 * n + k];
        e[3 * n + k] = across[0] + U[2 * n + k];
        e[4 * n + k] = across[1] + U[1 * n + k];
        e[5 * n + k] = across[1] - U[1 * n + k];
        e[6 * n + k] = measured[6 * n + k];
        e[7 * n + k] = measured[7 * n + k];
    }
}

void screw_prepare(element_data *d)
{
    const double straight[3] = {0};
    strain_prepare(2, 1, d->l0, straight, MEASURE_ANGLE, &d->line);
}

void screw_strain(const element_data *d, const node_state x[], strain_output *out)
{
    double measured[STRAINS], J[STRAINS * COORDINATES], T[3 * MEASURED], U[3 * COORDINATES];
    strain_of(&d->line, x, &(strain_output){.e = measured, .J = J});
    const screw w = screw_of(d->l0, measured);
    if (out->e != NULL) {
        for (int i = 0; i < 3; i++)
            U[i] = measured[i] + w.n[0] * w.b[i];
        arrange(1, U, measured, out->e);
    }
    if (out->J == NULL && (out->s == NULL || out->H == NULL))
        return;
    translation_gradient(d->l0, &w, T);
    if (out->J != NULL) {
        dense_mul(3, MEASURED, COORDINATES, T, J, U);
        arrange(COORDINATES, U, J, out->J);
    }
    if (out->s == NULL || out->H == NULL)
        return;
    const double *s = out->s, f[3] = {s[0], s[4] - s[5], s[3] - s[2]};
    double dual[STRAINS] = {0, 0, 0, s[1], (s[2] + s[3]) / 2, (s[4] + s[5]) / 2, s[6], s[7]};
    double W[MEASURED * MEASURED], work[MEASURED * COORDINATES];
    dense_add_transpose_mul(MEASURED, 3, 1, T, f, dual);
    strain_of(&d->line, x, &(strain_output){.s = dual, .H = out->H});
    translation_second(d->l0, &w, f, W);
    dense_add_congruence(MEASURED, COORDINATES, J, W, out->H, work);
}
