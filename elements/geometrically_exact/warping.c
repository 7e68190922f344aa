#include "elements/geometrically_exact/exact.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

enum {
    STAGES = EXACT_WARPING_MAX_STAGES,
    POLYNOMIALS = 20, /* sufficient up to lambda_short; the error of the energy is the square of
                         that of the amplitude */
    BUBBLES = POLYNOMIALS,
    FUNCTIONS = BUBBLES + 2,
    INTERVALS = 9,
    ORDER = 16,
    POINTS = INTERVALS * ORDER
};
static const double lambda_short = 20; /* value of lambda above which separate functions represent
                                          the layers and few polynomials are needed */

typedef struct basis {
    int bubbles, layers;
    double lambda;
} basis;

/* Both x and `rest`, the distances from the two ends, are given for accuracy near both ends. */
static void functions_at(const basis *b, double x, double rest, double value[], double slope[])
{
    value[0] = rest;
    value[1] = x;
    slope[0] = -1;
    slope[1] = 1;
    /* integrated Legendre polynomials (P_(j+1) - P_(j-1))/(2 (2 j + 1)), which are zero at both
     * ends */
    double before = 1, now = x - rest;
    for (int j = 1; j <= b->bubbles - 2 * b->layers; j++) {
        const double next = ((2 * j + 1) * (x - rest) * now - j * before) / (j + 1);
        value[j + 1] = (next - before) / (2 * (2 * j + 1));
        slope[j + 1] = now;
        before = now;
        now = next;
    }
    if (!b->layers)
        return;
    const double l = b->lambda, far = exp(-l), p = exp(-l * x), q = exp(-l * rest);
    const int k = b->bubbles;
    value[k] = p - rest - far * x;
    slope[k] = -l * p + 1 - far;
    value[k + 1] = q - x - far * rest;
    slope[k + 1] = l * q - 1 + far;
}

/* Computes quadrature points for smooth functions and for layers of thickness 1/lambda at both
 * ends. `rest` contains 1 - x. */
static void graded_points(double lambda, double x[], double rest[], double w[])
{
    const double step[] = {0, 1, 4, 12, 40}, thickness = fmin(1 / lambda, 0.01);
    double at[INTERVALS + 1], gauss[ORDER], weight[ORDER];
    for (int i = 0; i <= INTERVALS / 2; i++) {
        at[i] = step[i] * thickness;
        at[INTERVALS - i] = at[i];
    }
    quadrature_points(ORDER, gauss, weight);
    for (int i = 0; i < INTERVALS; i++)
        for (int g = 0; g < ORDER; g++) {
            const int k = i * ORDER + g, middle = INTERVALS / 2, from_q = i > middle;
            const double length = i == middle ? 1 - 2 * at[i] : fabs(at[i + 1] - at[i]);
            const double near = from_q ? at[i + 1] + gauss[g] * length : at[i] + gauss[g] * length;
            w[k] = weight[g] * length;
            x[k] = from_q ? 1 - near : near;
            rest[k] = from_q ? near : 1 - near;
        }
}

/* Computes mean[stages][functions], the value of P of each function at the Gauss points. Computes
 * K, twice the energy of the slopes and of the parts of the functions that P does not represent. */
static void integrate(const beam_constants *c, const basis *b, int stages, const double x[],
                      const double w[], double mean[STAGES * FUNCTIONS],
                      double K[FUNCTIONS * FUNCTIONS])
{
    const int n = b->bubbles + 2;
    double at[POINTS], rest[POINTS], weight[POINTS], value[POINTS][FUNCTIONS],
        slope[POINTS][FUNCTIONS], L[POINTS][STAGES];
    memset(mean, 0, (size_t)(stages * n) * sizeof *mean);
    memset(K, 0, (size_t)(n * n) * sizeof *K);
    graded_points(fmax(b->lambda, 1), at, rest, weight);
    for (int k = 0; k < POINTS; k++) {
        functions_at(b, at[k], rest[k], value[k], slope[k]);
        lagrange_at(stages, x, at[k], L[k], NULL);
        for (int i = 0; i < stages; i++) {
            const double share = weight[k] * L[k][i] / w[i];
            for (int j = 0; j < n; j++)
                mean[i * n + j] += share * value[k][j];
        }
    }
    for (int k = 0; k < POINTS; k++) {
        for (int i = 0; i < stages; i++)
            for (int j = 0; j < n; j++)
                value[k][j] -= L[k][i] * mean[i * n + j];
        for (int i = 0; i < n; i++) {
            const double by_slope = weight[k] * c->EIw * slope[k][i],
                         by_value = weight[k] * c->GJ * value[k][i];
            for (int j = 0; j <= i; j++)
                K[i * n + j] += by_slope * slope[k][j] + by_value * value[k][j];
        }
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            K[j * n + i] = K[i * n + j];
}

void exact_warping_energy(const beam_constants *c, int stages, const double x[], const double w[],
                          double S[EXACT_WARPING_MAX * EXACT_WARPING_MAX])
{
    enum { SIZE = BUBBLES + STAGES };
    const double lambda = sqrt(c->GJ / c->EIw);
    const int layers = lambda > lambda_short;
    const basis b = {.layers = layers, .bubbles = layers ? stages + 3 : BUBBLES, .lambda = lambda};
    const int n = b.bubbles + 2, m = stages + 2, size = b.bubbles + stages;
    double mean[STAGES * FUNCTIONS], K[FUNCTIONS * FUNCTIONS],
        A[SIZE * SIZE] = {0}, X[SIZE * EXACT_WARPING_MAX] = {0};
    int pivot[SIZE];
    integrate(c, &b, stages, x, w, mean, K);
    /* The unknowns are the bubble functions and w T, where T is the warping torque at the Gauss
     * points. The energy is 1/2 a K a + T w (kappa - P a) - 1/2 flexibility w T^2. */
    for (int i = 0; i < b.bubbles; i++) {
        for (int j = 0; j < b.bubbles; j++)
            A[i * size + j] = K[(i + 2) * n + j + 2];
        for (int j = 0; j < 2; j++)
            X[i * m + stages + j] = -K[(i + 2) * n + j];
        for (int k = 0; k < stages; k++)
            A[i * size + b.bubbles + k] = A[(b.bubbles + k) * size + i] = -mean[k * n + i + 2];
    }
    for (int k = 0; k < stages; k++) {
        const int row = b.bubbles + k;
        A[row * size + row] = -c->F[8] / w[k];
        X[row * m + k] = -1;
        for (int j = 0; j < 2; j++)
            X[row * m + stages + j] = mean[k * n + j];
    }
    dense_lu(size, A, pivot); /* not singular: K is positive definite on the bubble functions, which
                                 outnumber the Gauss points */
    dense_lu_solve(size, m, A, pivot, X);
    memset(S, 0, EXACT_WARPING_MAX * EXACT_WARPING_MAX * sizeof *S);
    for (int j = 0; j < m; j++) {
        for (int i = 0; i < stages; i++)
            S[i * m + j] = X[(b.bubbles + i) * m + j];
        for (int i = 0; i < 2; i++) {
            double sum = j >= stages ? K[i * n + j - stages] : 0;
            for (int k = 0; k < b.bubbles; k++)
                sum += K[i * n + k + 2] * X[k * m + j];
            for (int k = 0; k < stages; k++)
                sum -= mean[k * n + i] * X[(b.bubbles + k) * m + j];
            S[(stages + i) * m + j] = sum;
        }
    }
    for (int i = 0; i < m; i++)
        for (int j = 0; j < i; j++)
            S[i * m + j] = S[j * m + i] = (S[i * m + j] + S[j * m + i]) / 2;
}
