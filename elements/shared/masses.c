#include "elements/shared/masses.h"

#include <assert.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/real.h"
#include "elements/math/scalar.h"
#include "elements/section/section.h"

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

/* Computes P y = |Omega|^2 y - Omega (Omega . y) = -Omega x (Omega x y). */
static void project(const double omega[3], const double y[3], double Py[3])
{
    double wy[3];
    vec3_cross(omega, y, wy);
    vec3_cross(wy, omega, Py);
}

/* Adds factor T^T U to the upper half of A, whose row length is n. T and U are [3 x columns]. */
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

static void add_product(int columns, double factor, const double *T, const double *U, int n,
                        double *A)
{
    if (columns == UPPER_COLUMNS && n == UPPER_COLUMNS)
        REAL_CHOSEN(congruence_add_upper)(3, factor, T, U, A);
    else if (columns == 3)
        add_upper(3, factor, T, U, n, A);
    else
        add_upper(columns, factor, T, U, n, A);
}

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

static void add_vector(lumped_mass *l, double mass, const double a[3])
{
    if (mass != 0) {
        memcpy(l->vector[l->vectors], a, sizeof l->vector[0]);
        l->carried[l->vectors++] = mass;
    }
}

/* Masses of either sign on the vectors e_i and e_i + e_j represent the inertia J about the centre:
 * A = (tr J/2) 1 - J = sum_i (A_ii - sum_(j != i) A_ij) e_i e_i^T + sum_i<j A_ij (e_i + e_j)(e_i +
 * e_j)^T. */
static lumped_mass of_matrices(const section *c, double length)
{
    lumped_mass out = {.mass = c->mass[0] * length, .turns = 1};
    double centre[3], A[9], trace = 0;
    section_matrices_centre(c, centre);
    memcpy(out.vector[0], centre, sizeof centre);
    out.carried[0] = out.mass;
    out.vectors = 1;
    const double square = vec3_dot(centre, centre);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = out.mass * ((i == j ? square : 0) - centre[i] * centre[j]) -
                           length * c->mass[6 * (3 + i) + 3 + j];
    for (int i = 0; i < 3; i++)
        trace -= A[4 * i];
    for (int i = 0; i < 3; i++)
        A[4 * i] += trace / 2;
    for (int i = 0; i < 3; i++) {
        double e[3] = {0, 0, 0};
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        e[i] = 1;
        add_vector(&out, A[4 * i] - A[3 * i + j] - A[3 * i + k], e);
        e[j] = 1;
        add_vector(&out, A[3 * i + j], e);
    }
    return out;
}

lumped_mass lumped_of(const section *c, unsigned features, double length)
{
    if (c->matrices)
        return of_matrices(c, length);
    const double m = c->density * length;
    const int turns = (features & FEATURE_ROTARY_INERTIA) != 0;
    return (lumped_mass){.mass = m * c->A,
                         .rotary = {m * c->Ip, turns ? m * c->Iy : 0, turns ? m * c->Iz : 0},
                         .warping = turns && (features & FEATURE_WARPING) ? m * c->Iw : 0,
                         .turns = turns};
}

void lumped_directors(const double rotary[3], double j[3])
{
    const double half = (rotary[0] + rotary[1] + rotary[2]) / 2;
    for (int k = 0; k < 3; k++)
        j[k] = half - rotary[k];
}

static void add_translation(double mass, const node_state *x, const element_rotating_frame *frame,
                            int at, int n, inertia_output *out)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    moving_vector v = {.mass = mass, .at = at, .columns = 3, .T = identity};
    double F[3];
    if (frame != NULL)
        for (int i = 0; i < 3; i++)
            v.y[i] = x->r[i] - frame->centre[i];
    moving_add(&v, frame, n, out, F);
}

static void add_rotation(const lumped_mass *l, double share, const node_state *x,
                         const element_rotating_frame *frame, int at, int n, inertia_output *out)
{
    double j[3], *const stiffness = moving_stiffness(frame, out);
    lumped_directors(l->rotary, j);
    for (int k = 0; k < 3; k++) {
        double T[9] = {0}, F[3];
        moving_vector v = {.mass = share * j[k],
                           .y = {x->R[k], x->R[3 + k], x->R[6 + k]},
                           .at = at + 3,
                           .columns = 3,
                           .T = T};
        moving_rotation_gradient(v.y, 0, 3, T);
        moving_add(&v, frame, n, out, F);
        if (stiffness != NULL)
            moving_rotation_stiffness(F, v.y, at + 3, n, stiffness);
    }
}

/* Adds the inertia of warping, which moves the section along its normal by -omega a. This inertia
 * is that of a vector a n_X with the mass int rho Iw ds, even in a rotating frame. */
static void add_warping(double mass, const node_state *x, const element_rotating_frame *frame,
                        int at, int n, inertia_output *out)
{
    enum { COLUMNS = 4, A = 3 };
    const double normal[3] = {x->R[0], x->R[3], x->R[6]};
    double T[3 * COLUMNS] = {0}, F[3], mixed[3], *const stiffness = moving_stiffness(frame, out);
    moving_vector v = {.mass = mass, .at = at + 3, .columns = COLUMNS, .T = T};
    for (int i = 0; i < 3; i++) {
        v.y[i] = x->a * normal[i];
        T[COLUMNS * i + A] = normal[i];
    }
    moving_rotation_gradient(v.y, 0, COLUMNS, T);
    moving_add(&v, frame, n, out, F);
    if (stiffness == NULL)
        return;
    moving_rotation_stiffness(F, v.y, at + 3, n, stiffness);
    vec3_cross(normal, F, mixed);
    for (int i = 0; i < 3; i++) {
        stiffness[(at + 3 + i) * n + at + 6] -= mixed[i];
        stiffness[(at + 6) * n + at + 3 + i] -= mixed[i];
    }
}

/* Adds the inertia of the rotation about n_X. It is the only rotational inertia if rotary inertia
 * is not requested. */
static void add_twist(double mass, const node_state *x, int at, int n, inertia_output *out)
{
    for (int i = 0; i < 3 && out->M != NULL; i++)
        for (int k = 0; k < 3; k++)
            out->M[(at + 3 + i) * n + at + 3 + k] += mass * x->R[3 * i] * x->R[3 * k];
}

/* Adds the inertia of the masses at r + R vector[0], and of those on the other vectors, which R
 * rotates. */
static void add_vectors(const lumped_mass *l, double share, const node_state *x,
                        const element_rotating_frame *frame, int at, int n, inertia_output *out)
{
    enum { COLUMNS = 6, TURN = 3 };
    for (int k = 0; k < l->vectors; k++) {
        double T[3 * COLUMNS] = {0}, F[3],
                     turned[3], *const stiffness = moving_stiffness(frame, out);
        moving_vector v = {.mass = share * l->carried[k], .at = at, .columns = COLUMNS, .T = T};
        mat3_mul_vec(x->R, l->vector[k], turned);
        memcpy(v.y, turned, sizeof turned);
        for (int i = 0; i < 3 && k == 0; i++) {
            T[COLUMNS * i + i] = 1;
            v.y[i] += x->r[i] - (frame != NULL ? frame->centre[i] : 0);
        }
        moving_rotation_gradient(turned, TURN, COLUMNS, T);
        moving_add(&v, frame, n, out, F);
        if (stiffness != NULL)
            moving_rotation_stiffness(F, turned, at + TURN, n, stiffness);
    }
}

void lumped_add(const lumped_mass *l, double share, const node_state *x,
                const element_rotating_frame *frame, int at, int n, inertia_output *out)
{
    if (l->vectors > 0) {
        add_vectors(l, share, x, frame, at, n, out);
        return;
    }
    add_translation(share * l->mass, x, frame, at, n, out);
    if (l->turns)
        add_rotation(l, share, x, frame, at, n, out);
    if (l->warping > 0)
        add_warping(share * l->warping, x, frame, at, n, out);
    if (!l->turns)
        add_twist(share * l->rotary[0], x, at, n, out);
}

void lumped_shares(int nodes, const double place[], double share[])
{
    static const double two[] = {0.5, 0.5}, three[] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
    double x[ELEMENT_MAX_NODES], weight[ELEMENT_MAX_NODES], L[ELEMENT_MAX_NODES];
    if (nodes == 2 || (nodes == 3 && place[1] == 0.5)) {
        memcpy(share, nodes == 2 ? two : three, (size_t)nodes * sizeof *share);
        return;
    }
    memset(share, 0, (size_t)nodes * sizeof *share);
    quadrature_points(nodes, x, weight);
    for (int g = 0; g < nodes; g++) {
        lagrange_at(nodes, place, x[g], L, NULL);
        for (int k = 0; k < nodes; k++)
            share[k] += weight[g] * L[k];
    }
}

status lumped_element(const lumped_mass *whole, int nodes, const double share[],
                      const node_state x[], const element_rotating_frame *frame,
                      inertia_output *out)
{
    const int n = NODE_COORDINATES * nodes;
    moving_clear(n, out);
    for (int k = 0; k < nodes; k++)
        lumped_add(whole, share[k], &x[k], frame, NODE_COORDINATES * k, n, out);
    moving_complete(n, out);
    return STATUS_OK;
}

void inertia_widen(int n, int wide, inertia_output *out)
{
    double *const matrix[] = {out->M, out->N, out->G, out->C, out->K}, *const vector[] = {
                                                                           out->force, out->taken};
    for (size_t k = 0; k < sizeof matrix / sizeof matrix[0] && wide > n; k++)
        if (matrix[k] != NULL)
            dense_widen(n, wide, matrix[k]);
    for (size_t k = 0; k < sizeof vector / sizeof vector[0]; k++)
        for (int i = n; i < wide && vector[k] != NULL; i++)
            vector[k][i] = 0;
}
