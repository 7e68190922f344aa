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

/* A += factor T^T U, all of it. */
static void add_whole(int columns, double factor, const double *T, const double *U, int n,
                      double *A)
{
    for (int i = 0; i < columns; i++) {
        const double a = factor * T[i], b = factor * T[columns + i],
                     c = factor * T[2 * columns + i];
        for (int j = 0; j < columns; j++)
            A[i * n + j] += a * U[j] + b * U[columns + j] + c * U[2 * columns + j];
    }
}

static void add_in_time(const moving_vector *v, int n, inertia_output *out, double F[3])
{
    const int first = v->at * n + v->at;
    for (int i = 0; i < 3; i++) {
        double gained = v->convective[i];
        for (int j = 0; j < v->columns && out->acceleration != NULL; j++)
            gained += v->T[v->columns * i + j] * out->acceleration[v->at + j];
        F[i] = -v->mass * gained;
    }
    for (int j = 0; j < v->columns && out->taken != NULL; j++)
        out->taken[v->at + j] -=
            F[0] * v->T[j] + F[1] * v->T[v->columns + j] + F[2] * v->T[2 * v->columns + j];
    if (out->C != NULL && v->rates != NULL)
        add_whole(v->columns, v->mass, v->T, v->rates, n, out->C + first);
    if (out->K != NULL && v->displacement != NULL)
        add_whole(v->columns, v->mass, v->T, v->displacement, n, out->K + first);
}

void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3])
{
    F[0] = F[1] = F[2] = 0;
    if (out->M != NULL)
        add_product(v->columns, v->mass, v->T, v->T, n, out->M + v->at * n + v->at);
    if (frame != NULL)
        add_in_frame(v, frame, n, out, F);
    else if (out->rate != NULL)
        add_in_time(v, n, out, F);
}

void moving_add_twist(const moving_twist *t, int n, inertia_output *out)
{
    double gained = t->curvature, across[MOST] = {0}, spin = 0;
    for (int i = 0; i < n; i++) {
        spin += t->row[i] * out->rate[i];
        gained += out->acceleration != NULL ? t->row[i] * out->acceleration[i] : 0;
    }
    for (int k = 0; k < t->nodes; k++) {
        double turned[3];
        vec3_cross(out->rate + t->at[k], t->axis[k], turned);
        for (int i = 0; i < 3; i++)
            across[t->at[k] + i] = t->weight[k] * turned[i];
    }
    for (int i = 0; i < n && out->taken != NULL; i++)
        out->taken[i] += t->mass * (t->row[i] * gained + spin * across[i]);
    for (int i = 0; i < n && out->C != NULL; i++)
        for (int j = 0; j < n; j++)
            out->C[i * n + j] += t->mass * (across[i] * t->row[j] +
                                            2 * t->row[i] * (t->slope != NULL ? t->slope[j] : 0));
    for (int k = 0; k < t->nodes && out->C != NULL; k++) {
        double T[9] = {0};
        moving_rotation_gradient(t->axis[k], 0, 3, T);
        for (int i = 0; i < 9; i++)
            out->C[(t->at[k] + i / 3) * n + t->at[k] + i % 3] +=
                t->mass * spin * t->weight[k] * T[i];
    }
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

void moving_turn_of(const inertia_output *out, int at, moving_turn *turn)
{
    for (int i = 0; i < 3; i++) {
        turn->w[i] = out->rate[at + i];
        turn->wd[i] = out->acceleration != NULL ? out->acceleration[at + i] : 0;
    }
}

void moving_fixed(const moving_turn *turn, const double f[3], int at, int columns,
                  double convective[3], double rates[], double displacement[])
{
    double wf[3], wwf[3];
    vec3_cross(turn->w, f, wf);
    vec3_cross(turn->w, wf, wwf);
    for (int i = 0; i < 3; i++)
        convective[i] += wwf[i];
    for (int j = 0; j < 3 && (rates != NULL || displacement != NULL); j++) {
        double one[3] = {0, 0, 0}, turned[3], first[3], second[3], twice[3];
        one[j] = 1;
        vec3_cross(one, f, turned);
        vec3_cross(one, wf, first);
        vec3_cross(turn->w, turned, second);
        for (int i = 0; i < 3 && rates != NULL; i++)
            rates[columns * i + at + j] += first[i] + second[i];
        if (displacement == NULL)
            continue;
        vec3_cross(turn->wd, turned, first);
        vec3_cross(turn->w, second, twice);
        for (int i = 0; i < 3; i++)
            displacement[columns * i + at + j] += first[i] + twice[i];
    }
}
