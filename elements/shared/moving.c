#include "elements/shared/moving.h"

#include <string.h>

#include "elements/math/dense.h"

enum { MOST = 14 };

void moving_clear(int n, inertia_output *out)
{
    const size_t square = (size_t)n * (size_t)n;
    double *const matrices[] = {out->M, out->N, out->G, out->C, out->K}, *const vectors[] = {
                                                                             out->force,
                                                                             out->taken};
    for (int k = 0; k < 5; k++)
        if (matrices[k] != NULL)
            memset(matrices[k], 0, square * sizeof(double));
    for (int k = 0; k < 2; k++)
        if (vectors[k] != NULL)
            memset(vectors[k], 0, (size_t)n * sizeof(double));
    if (out->potential != NULL)
        *out->potential = 0;
}

/* P y = |Omega|^2 y - Omega (Omega . y) = -Omega x (Omega x y). */
static void project(const double omega[3], const double y[3], double Py[3])
{
    double wy[3];
    vec3_cross(omega, y, wy);
    vec3_cross(wy, omega, Py);
}

/* A += factor T^T U, T and U [3 x columns], A in rows of n: the upper half. */
static inline __attribute__((always_inline)) void add_upper(int columns, double factor,
                                                            const double *restrict T,
                                                            const double *restrict U, int n,
                                                            double *restrict A)
{
    for (int i = 0; i < columns; i++) {
        const double a = T[i], b = T[columns + i], c = T[2 * columns + i];
        for (int j = i; j < columns; j++)
            A[i * n + j] += factor * (a * U[j] + b * U[columns + j] + c * U[2 * columns + j]);
    }
}

/* The same: sizes of those that are many are known. */
static void add_product(int columns, double factor, const double *T, const double *U, int n,
                        double *A)
{
    if (columns == MOST && n == MOST)
        add_upper(MOST, factor, T, U, MOST, A);
    else if (columns == 3)
        add_upper(3, factor, T, U, n, A);
    else
        add_upper(columns, factor, T, U, n, A);
}

/* What the frame does to the columns of T: P of each, and Omega x each. */
static void turn_columns(const moving_vector *v, const double omega[3], double P[3 * MOST],
                         double coriolis[3 * MOST])
{
    const int n = v->columns;
    for (int j = 0; j < n; j++) {
        const double t[3] = {v->T[j], v->T[n + j], v->T[2 * n + j]};
        double Pt[3], wt[3];
        vec3_cross(omega, t, wt);
        vec3_cross(wt, omega, Pt);
        for (int i = 0; i < 3; i++) {
            P[i * n + j] = Pt[i];
            coriolis[i * n + j] = wt[i];
        }
    }
}

static void add_in_frame(const moving_vector *v, const element_rotating_frame *frame, int n,
                         inertia_output *out, double F[3])
{
    double P[3 * MOST], coriolis[3 * MOST];
    const int first = v->at * n + v->at;
    project(frame->omega, v->y, F);
    for (int i = 0; i < 3; i++)
        F[i] *= v->mass;
    if (out->potential != NULL)
        *out->potential -= vec3_dot(F, v->y) / 2;
    if (out->force != NULL)
        for (int j = 0; j < v->columns; j++)
            out->force[v->at + j] +=
                F[0] * v->T[j] + F[1] * v->T[v->columns + j] + F[2] * v->T[2 * v->columns + j];
    if (out->N == NULL && out->G == NULL)
        return;
    turn_columns(v, frame->omega, P, coriolis);
    if (out->N != NULL)
        add_product(v->columns, -v->mass, v->T, P, n, out->N + first);
    if (out->G != NULL)
        add_product(v->columns, 2 * v->mass, v->T, coriolis, n, out->G + first);
}

void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3])
{
    F[0] = F[1] = F[2] = 0;
    if (out->M != NULL)
        add_product(v->columns, v->mass, v->T, v->T, n, out->M + v->at * n + v->at);
    if (frame != NULL)
        add_in_frame(v, frame, n, out, F);
}

/* The lower half is that above, times sign. */
static void mirror(int n, double sign, double *A)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            A[i * n + j] = sign * A[j * n + i];
}

void moving_complete(int n, inertia_output *out)
{
    if (out->M != NULL)
        mirror(n, 1, out->M);
    if (out->N != NULL)
        mirror(n, 1, out->N);
    if (out->G != NULL)
        mirror(n, -1, out->G);
}

void moving_rotation_stiffness(const double F[3], const double v[3], int at, int n, double N[])
{
    const double dot = vec3_dot(F, v);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            N[(at + i) * n + at + j] -= (F[i] * v[j] + v[i] * F[j]) / 2 - (i == j ? dot : 0);
}

void moving_rotation_gradient(const double v[3], int at, int columns, double T[])
{
    const double turned[9] = {0, v[2], -v[1], -v[2], 0, v[0], v[1], -v[0], 0}; /* -v~ */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            T[i * columns + at + j] += turned[3 * i + j];
}
