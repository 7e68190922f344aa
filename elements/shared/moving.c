#include "elements/shared/moving.h"

#include <string.h>

#include "elements/math/dense.h"

void moving_clear(int n, inertia_output *out)
{
    const size_t square = (size_t)n * (size_t)n;
    double *const matrices[] = {out->M, out->N, out->G};
    for (int k = 0; k < 3; k++)
        if (matrices[k] != NULL)
            memset(matrices[k], 0, square * sizeof(double));
    if (out->force != NULL)
        memset(out->force, 0, (size_t)n * sizeof(double));
    if (out->potential != NULL)
        *out->potential = 0;
}

static void column_of(const moving_vector *v, int j, double t[3])
{
    for (int i = 0; i < 3; i++)
        t[i] = v->T[i * v->columns + j];
}

/* P y = |Omega|^2 y - Omega (Omega . y) = -Omega x (Omega x y). */
static void project(const double omega[3], const double y[3], double Py[3])
{
    double wy[3];
    vec3_cross(omega, y, wy);
    vec3_cross(wy, omega, Py);
}

void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3])
{
    static const double none[3] = {0, 0, 0};
    const double *omega = frame != NULL ? frame->omega : none;
    F[0] = F[1] = F[2] = 0;
    if (frame != NULL)
        project(omega, v->y, F);
    for (int i = 0; i < 3; i++)
        F[i] *= v->mass;
    if (out->potential != NULL && frame != NULL)
        *out->potential -= vec3_dot(F, v->y) / 2;
    for (int j = 0; j < v->columns; j++) {
        double t[3], P[3], coriolis[3];
        column_of(v, j, t);
        if (out->force != NULL)
            out->force[v->at + j] += vec3_dot(F, t);
        project(omega, t, P);
        vec3_cross(omega, t, coriolis);
        for (int i = 0; i < v->columns; i++) {
            const int entry = (v->at + i) * n + v->at + j;
            double s[3];
            column_of(v, i, s);
            if (out->M != NULL)
                out->M[entry] += v->mass * vec3_dot(s, t);
            if (out->N != NULL)
                out->N[entry] -= v->mass * vec3_dot(s, P);
            if (out->G != NULL)
                out->G[entry] += 2 * v->mass * vec3_dot(s, coriolis);
        }
    }
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
