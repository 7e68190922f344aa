/* The masses are at quadrature points, which vectors of the section locate: y = lin(r + R a) + sum
 * m_k (nu_k . e), where a is fixed to the section and m_k is the mean of the unit vectors of the
 * nodes (inertia.c). The acceleration of a mass is
 *   y'' = lin(r'') + sum over nodes A f + sum over k (2 m_k' (nu_k . e)' + m_k (nu_k . e)''),
 *   f = part R a + sum over k (nu_k . e)/2 n_k, A = w'~ + w~ w~, e'' = J x'' + x'.H x',
 * where f is fixed to a node that rotates with the angular velocity w. */
#include "elements/beamw/fields.h"

#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/math/dense.h"

enum { N = MODES_COORDINATES, MODES = BEAMW_FIELD_MODES, NODES = 2, AXES = 3 };
enum { WIDE = 16, PARTS = 4 }; /* rows of N are padded with zeros to SIMD vectors */
typedef double part __attribute__((vector_size(32)));
typedef union row {
    part part[PARTS];
    double of[WIDE];
} row;
/* A row of N of which only the columns of the rotations of the nodes are not zero. */
typedef union turns_row {
    part part[NODES];
    double of[NODES][WIDE / PARTS];
} turns_row;
enum { NU_Y, NU_Z, CHI_X, CHI_Y, CHI_Z }; /* numbered in the order of inertia.c */

static const int turns[NODES] = {MODES_TP, MODES_TQ}, places[NODES] = {MODES_RP, MODES_RQ};

typedef struct moving_line {
    const beamw_spread *d;
    const node_state *x;
    inertia_output *out;
    const double *w[NODES];   /* angular velocities */
    double A[NODES][9];       /* A of the head: f'' = A f for a vector f that is fixed to a node */
    double n[NODES][AXES][3]; /* unit vectors */
    double m[AXES][3], m_rate[AXES][3];
    part mode[MODES]; /* each mode, its first and its second time derivative */
    double J[MODES * N], slope[MODES * N];
    row wide_J[MODES], wide_slope[MODES];
    row M[N], C[N]; /* of M, the upper half */
    turns_row K[N];
    double s[MODES]; /* stresses of the modes */
    double mixed[NODES]
                [3 * MODES]; /* derivatives with respect to the rotation of a node and to a mode */
} moving_line;

static void skew(double size, const double v[3], double A[9])
{
    A[1] -= size * v[2];
    A[2] += size * v[1];
    A[3] += size * v[2];
    A[5] -= size * v[0];
    A[6] -= size * v[1];
    A[7] += size * v[0];
}

static void add_crossed(double size, const double a[3], const double b[3], double A[9])
{
    const double dot = vec3_dot(a, b);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] += size * (b[i] * a[j] - (i == j ? dot : 0));
}

static void add_block(double size, const double B[9], int first, int column, double A[N * N])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[(first + i) * N + column + j] += size * B[3 * i + j];
}

static void set_sums(moving_line *c)
{
    memset(c->s, 0, sizeof c->s);
    memset(c->mixed, 0, sizeof c->mixed);
    if (c->out->M != NULL)
        memset(c->M, 0, sizeof c->M);
    if (c->out->C != NULL)
        memset(c->C, 0, sizeof c->C);
    if (c->out->K != NULL)
        memset(c->K, 0, sizeof c->K);
}

static void set_nodes(moving_line *c)
{
    static const double none[3] = {0, 0, 0};
    for (int node = 0; node < NODES; node++) {
        const double *acceleration = c->out->acceleration;
        c->w[node] = c->out->rate + turns[node];
        memset(c->A[node], 0, sizeof c->A[node]);
        skew(1, acceleration != NULL ? acceleration + turns[node] : none, c->A[node]);
        add_crossed(1, c->w[node], c->w[node], c->A[node]);
        for (int k = 0; k < AXES; k++)
            for (int i = 0; i < 3; i++)
                c->n[node][k][i] = c->x[node].R[3 * i + k];
    }
    for (int k = 0; k < AXES; k++) {
        double p[3], q[3];
        vec3_cross(c->w[0], c->n[0][k], p);
        vec3_cross(c->w[1], c->n[1][k], q);
        for (int i = 0; i < 3; i++) {
            c->m[k][i] = (c->n[0][k][i] + c->n[1][k][i]) / 2;
            c->m_rate[k][i] = (p[i] + q[i]) / 2;
        }
    }
}

static void widen(int rows, const double A[], row out[])
{
    for (int i = 0; i < rows; i++) {
        memcpy(out[i].of, A + N * i, N * sizeof *A);
        out[i].of[N] = out[i].of[N + 1] = 0;
    }
}

static void set_modes(moving_line *c)
{
    double e[MODES], rate[MODES], second[MODES];
    beamw_modes_evaluate(c->d->l0, c->x, &(strain_output){.e = e, .J = c->J});
    beamw_modes_slopes(c->d->l0, c->x, c->J, c->out->rate, c->slope);
    widen(MODES, c->J, c->wide_J);
    widen(MODES, c->slope, c->wide_slope);
    dense_mul_vec(MODES, N, c->J, c->out->rate, rate);
    dense_mul_vec(MODES, N, c->slope, c->out->rate, second);
    for (int j = 0; j < MODES && c->out->acceleration != NULL; j++)
        second[j] += dense_dot(N, c->J + N * j, c->out->acceleration);
    for (int j = 0; j < MODES; j++)
        c->mode[j] = (part){e[j], rate[j], second[j], 0};
}

typedef struct line_point {
    double mass, part[NODES], shift; /* shift is 1 for a position, 0 for a direction */
    int axes, axis[AXES];            /* axes k for which m_k has functionals at the point */
    double nu[AXES][MODES], value[AXES], rate[AXES];
    double f[NODES][3]; /* vectors fixed to the nodes */
    double F[3];        /* mass times acceleration */
} line_point;

/* Sets the functionals of a vector a that is fixed to the section. The functionals of a position
 * also include nu. */
static void set_functionals(const moving_line *c, int g, const double a[3], line_point *p)
{
    static const int other[AXES][2] = {{1, 2}, {2, 0}, {0, 1}},
                     turn[AXES][2] = {{CHI_Z, CHI_Y}, {CHI_X, CHI_Z}, {CHI_Y, CHI_X}};
    const double(*field)[MODES] = c->d->field[g];
    p->axes = 0;
    for (int k = 0; k < AXES; k++) { /* (chi x a)_k */
        const double first = a[other[k][1]], second = a[other[k][0]];
        const double *place = p->shift > 0 && k > 0 ? field[k == 1 ? NU_Y : NU_Z] : NULL;
        if (first == 0 && second == 0 && place == NULL)
            continue;
        double *nu = p->nu[p->axes];
        for (int j = 0; j < MODES; j++)
            nu[j] = first * field[turn[k][1]][j] - second * field[turn[k][0]][j] +
                    (place != NULL ? place[j] : 0);
        p->axis[p->axes++] = k;
    }
}

static void set_point(const moving_line *c, int g, double mass, const double a[3], int place,
                      line_point *p)
{
    const double *acceleration = place ? c->out->acceleration : NULL;
    p->mass = 2 * c->d->weight[g] * mass;
    p->part[0] = 1 - c->d->at[g];
    p->part[1] = c->d->at[g];
    p->shift = place;
    set_functionals(c, g, a, p);
    p->F[0] = p->F[1] = p->F[2] = 0;
    for (int node = 0; node < NODES; node++) {
        double turned[3];
        mat3_mul_vec(c->x[node].R, a, turned);
        for (int i = 0; i < 3; i++)
            p->f[node][i] = p->part[node] * turned[i];
    }
    for (int k = 0; k < p->axes; k++) {
        const int axis = p->axis[k];
        part along = {0};
        for (int j = 0; j < MODES; j++)
            along += p->nu[k][j] * c->mode[j];
        const double second = along[2];
        p->value[k] = along[0];
        p->rate[k] = along[1];
        for (int i = 0; i < 3; i++) {
            p->F[i] += p->mass * (2 * c->m_rate[axis][i] * p->rate[k] + c->m[axis][i] * second);
            for (int node = 0; node < NODES; node++)
                p->f[node][i] += p->value[k] / 2 * c->n[node][axis][i];
        }
    }
    for (int node = 0; node < NODES; node++) {
        double turned[3];
        mat3_mul_vec(c->A[node], p->f[node], turned);
        for (int i = 0; i < 3; i++)
            p->F[i] += p->mass * (turned[i] + (acceleration != NULL
                                                   ? p->part[node] * acceleration[places[node] + i]
                                                   : 0));
    }
}

static void add_taken(moving_line *c, const line_point *p)
{
    for (int k = 0; k < p->axes; k++) {
        const double across = vec3_dot(c->m[p->axis[k]], p->F);
        for (int j = 0; j < MODES; j++)
            c->s[j] += across * p->nu[k][j];
    }
    for (int node = 0; node < NODES && c->out->taken != NULL; node++) {
        double moment[3];
        vec3_cross(p->f[node], p->F, moment);
        for (int i = 0; i < 3; i++) {
            c->out->taken[places[node] + i] += p->shift * p->part[node] * p->F[i];
            c->out->taken[turns[node] + i] += moment[i];
        }
    }
}

/* Adds -size v~ to T in the columns of the rotations of a node. */
static void add_turn(double size, const double v[3], int node, row T[3])
{
    double A[9] = {0};
    skew(-size, v, A);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            T[i].of[turns[node] + j] += A[3 * i + j];
}

/* Adds mass T^T U to A from the part of each row that contains its diagonal. */
static void add_upper(double mass, const row T[3], const row U[3], row A[N])
{
    enum { OF_PART = WIDE / PARTS };
    for (int first = 0; first < PARTS; first++)
        for (int i = OF_PART * first; i < N && i < OF_PART * (first + 1); i++) {
            const double a = mass * T[0].of[i], b = mass * T[1].of[i], c = mass * T[2].of[i];
            for (int j = first; j < PARTS; j++)
                A[i].part[j] += a * U[0].part[j] + b * U[1].part[j] + c * U[2].part[j];
        }
}

static void add_product(double mass, const row T[3], const row U[3], row A[N])
{
    for (int i = 0; i < N; i++) {
        const double a = mass * T[0].of[i], b = mass * T[1].of[i], c = mass * T[2].of[i];
        for (int j = 0; j < PARTS; j++)
            A[i].part[j] += a * U[0].part[j] + b * U[1].part[j] + c * U[2].part[j];
    }
}

static void add_turns_product(double mass, const row T[3], const turns_row U[3], turns_row A[N])
{
    for (int i = 0; i < N; i++) {
        const double a = mass * T[0].of[i], b = mass * T[1].of[i], c = mass * T[2].of[i];
        for (int j = 0; j < NODES; j++)
            A[i].part[j] += a * U[0].part[j] + b * U[1].part[j] + c * U[2].part[j];
    }
}

/* Returns the row nu . A, where the rows of A belong to the modes. */
static row along_modes(const double nu[MODES], const row A[MODES])
{
    row out;
    for (int i = 0; i < PARTS; i++)
        out.part[i] = nu[0] * A[0].part[i];
    for (int j = 1; j < MODES; j++)
        for (int i = 0; i < PARTS; i++)
            out.part[i] += nu[j] * A[j].part[i];
    return out;
}

static void narrow(const row A[N], double *out)
{
    for (int i = 0; i < N && out != NULL; i++)
        for (int j = 0; j < N; j++)
            out[N * i + j] += A[i].of[j];
}

static void narrow_turns(const turns_row A[N], double *out)
{
    for (int i = 0; i < N && out != NULL; i++)
        for (int node = 0; node < NODES; node++)
            for (int j = 0; j < 3; j++)
                out[N * i + turns[node] + j] += A[i].of[node][j];
}

/* With T = dy/dx, adds mass T^T T to M, mass T^T dy''/dx' to C, and mass T^T times the part of
 * dy''/dx due to vectors fixed to the nodes to K. */
static void add_gradients(moving_line *c, const line_point *p)
{
    const inertia_output *out = c->out;
    row T[3] = {0}, rates[3] = {0};
    turns_row places_of[3] = {0};
    for (int k = 0; k < p->axes; k++) {
        const double *m = c->m[p->axis[k]], *m_rate = c->m_rate[p->axis[k]];
        const row gradient = along_modes(p->nu[k], c->wide_J),
                  slope = along_modes(p->nu[k], c->wide_slope);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < PARTS; j++) {
                T[i].part[j] += m[i] * gradient.part[j];
                rates[i].part[j] += 2 * m_rate[i] * gradient.part[j] + 2 * m[i] * slope.part[j];
            }
        for (int node = 0; node < NODES; node++)
            add_turn(p->rate[k], c->n[node][p->axis[k]], node, rates);
    }
    for (int node = 0; node < NODES; node++) {
        double turned[3], W[9] = {0}, Wf[9], B[9] = {0}, f[9] = {0}, Af[9];
        for (int i = 0; i < 3; i++)
            T[i].of[places[node] + i] += p->shift * p->part[node];
        add_turn(1, p->f[node], node, T);
        vec3_cross(c->w[node], p->f[node], turned);
        skew(1, c->w[node], W);
        skew(1, p->f[node], f);
        mat3_mul(W, f, Wf);
        mat3_mul(c->A[node], f, Af);
        skew(1, turned, B);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                rates[i].of[turns[node] + j] -= B[3 * i + j] + Wf[3 * i + j];
                places_of[i].of[node][j] -= Af[3 * i + j];
            }
    }
    if (out->M != NULL)
        add_upper(p->mass, T, T, c->M);
    if (out->C != NULL)
        add_product(p->mass, T, rates, c->C);
    if (out->K != NULL)
        add_turns_product(p->mass, T, places_of, c->K);
}

/* Adds the second derivative of F . f with respect to the rotation of a node in the exponential
 * chart, where f is fixed to that node. */
static void add_chart(const double F[3], const double f[3], double B[9])
{
    add_crossed(0.5, F, f, B);
    add_crossed(0.5, f, F, B);
}

/* Collects the second derivatives of F . y due to the rotations of fixed vectors, and due to
 * products of rotations and modes. */
static void gather_curvature(moving_line *c, const line_point *p)
{
    for (int node = 0; node < NODES; node++) {
        double B[9] = {0};
        add_chart(p->F, p->f[node], B);
        add_block(1, B, turns[node], turns[node], c->out->K);
        for (int k = 0; k < p->axes; k++) {
            double turned[3];
            vec3_cross(c->n[node][p->axis[k]], p->F, turned);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < MODES; j++)
                    c->mixed[node][MODES * i + j] += turned[i] / 2 * p->nu[k][j];
        }
    }
}

static void add_curvature(moving_line *c)
{
    double H[N * N];
    for (int node = 0; node < NODES; node++)
        for (int i = 0; i < 3; i++) {
            const row product = along_modes(c->mixed[node] + MODES * i, c->wide_J);
            for (int j = 0; j < N; j++) {
                c->out->K[(turns[node] + i) * N + j] += product.of[j];
                c->out->K[j * N + turns[node] + i] += product.of[j];
            }
        }
    beamw_modes_evaluate(c->d->l0, c->x, &(strain_output){.s = c->s, .H = H});
    for (int i = 0; i < N * N; i++)
        c->out->K[i] += H[i];
}

static void add_twist(moving_line *c, double polar)
{
    inertia_output *out = c->out;
    const double *rate = out->rate, *acceleration = out->acceleration;
    double axis[NODES][3], across[NODES][3], spin[NODES], gained[NODES];
    for (int node = 0; node < NODES; node++) {
        for (int i = 0; i < 3; i++)
            axis[node][i] = c->x[node].R[3 * i];
        spin[node] = vec3_dot(c->w[node], axis[node]);
        gained[node] = acceleration != NULL ? vec3_dot(acceleration + turns[node], axis[node]) : 0;
        vec3_cross(rate + turns[node], axis[node], across[node]);
    }
    for (int a = 0; a < NODES; a++)
        for (int b = 0; b < NODES; b++) {
            const double size = polar * (a == b ? 1 / 3.0 : 1 / 6.0);
            double B[9] = {0};
            for (int i = 0; i < 3; i++) {
                if (out->taken != NULL)
                    out->taken[turns[a] + i] +=
                        size * (axis[a][i] * gained[b] + across[a][i] * spin[b]);
                for (int j = 0; j < 3; j++) {
                    const int at = (turns[a] + i) * N + turns[b] + j;
                    if (out->M != NULL)
                        out->M[at] += size * axis[a][i] * axis[b][j];
                    if (out->C != NULL)
                        out->C[at] += size * across[a][i] * axis[b][j];
                }
            }
            if (out->C != NULL) {
                skew(-size * spin[b], axis[a], B);
                add_block(1, B, turns[a], turns[a], out->C);
            }
        }
}

static void add_mass(moving_line *c, double mass, const double a[3], int place)
{
    for (int g = 0; g < c->d->points && mass != 0; g++) {
        line_point p;
        set_point(c, g, mass, a, place, &p);
        add_taken(c, &p);
        if (c->out->M != NULL || c->out->C != NULL || c->out->K != NULL)
            add_gradients(c, &p);
        if (c->out->K != NULL)
            gather_curvature(c, &p);
    }
}

static void add_rotary(moving_line *c)
{
    static const double unit[AXES][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const lumped_mass *l = &c->d->lumped;
    double j[3];
    lumped_directors(l->rotary, j);
    for (int k = 1; k < l->vectors; k++)
        add_mass(c, l->carried[k], l->vector[k], 0);
    for (int k = 0; k < AXES && l->vectors == 0 && l->turns; k++)
        add_mass(c, j[k], unit[k], 0);
    if (l->vectors == 0 && !l->turns)
        add_twist(c, 2 * l->rotary[0]);
}

static void add_warping(const inertia_output *out, double mass)
{
    static const int at[NODES] = {MODES_AP, MODES_AQ};
    for (int node = 0; node < NODES; node++) {
        if (out->M != NULL)
            out->M[(N + 1) * at[node]] += mass;
        if (out->taken != NULL && out->acceleration != NULL)
            out->taken[at[node]] += mass * out->acceleration[at[node]];
    }
}

void REAL_NAMED(beamw_in_time)(const beamw_spread *d, const node_state x[2], inertia_output *out)
{
    static const double none[3] = {0, 0, 0};
    moving_line c;
    c.d = d;
    c.x = x;
    c.out = out;
    set_sums(&c);
    set_nodes(&c);
    set_modes(&c);
    add_mass(&c, d->lumped.mass, d->lumped.vectors > 0 ? d->lumped.vector[0] : none, 1);
    add_rotary(&c);
    narrow(c.M, out->M);
    narrow(c.C, out->C);
    narrow_turns(c.K, out->K);
    if (out->taken != NULL)
        dense_add_transpose_mul(N, MODES, 1, c.J, c.s, out->taken);
    if (out->K != NULL)
        add_curvature(&c);
    add_warping(out, d->lumped.warping);
}
