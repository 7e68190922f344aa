/* Virtual work of loads on the field, and its derivatives. A vector y of the field is
 *   y = sum part_n v_n + sum m_k (functional . e),
 * which is linear in e and in vectors v fixed to the nodes. */
#include <math.h>
#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/shared/masses.h"

enum {
    MOST = ELEMENT_MAX_COORDINATES,
    TURN = 3, /* index of the first rotation among the coordinates of a node */
    TERMS = 2
};

/* A vector y: the interpolated director or position of the nodes plus the sum of sign m_k
 * functional. */
typedef struct field_vector {
    int director; /* index of the director, or PLACE if y is a position */
    struct {
        int k, functional;
        double sign;
    } term[TERMS];
} field_vector;

enum { PLACE = -1 };
static const field_vector place = {PLACE, {{1, FIELD_NU_Y, 1}, {2, FIELD_NU_Z, 1}}},
                          director[3] = {{0, {{1, FIELD_CHI_Z, 1}, {2, FIELD_CHI_Y, -1}}},
                                         {1, {{0, FIELD_CHI_Z, -1}, {2, FIELD_CHI_X, 1}}},
                                         {2, {{0, FIELD_CHI_Y, 1}, {1, FIELD_CHI_X, -1}}}};

typedef struct pulled {
    const displacement_field *f;
    int n;                                              /* coordinates */
    double vector[ELEMENT_MAX_NODES][3][3], mean[3][3]; /* unit vectors, and their means m_k */
    double e[FIELD_MODES], J[FIELD_MODES * MOST];
    double s[FIELD_MODES]; /* generalised forces conjugate to e */
    /* derivative of s with respect to rotations of p and q, due to forces */
    double turn[2][3][FIELD_MODES];
    double moment_turn[2][3][FIELD_MODES]; /* the same derivative due to moments */
    double *forces, *K;
} pulled;

static double amplitude(const pulled *p, const field_rows *at, int functional)
{
    return dense_dot(FIELD_MODES, at->functional[functional], p->e);
}

/* Computes fixed[node], the part of y that rotates with each node. */
static void fixed_of(const pulled *p, const field_rows *at, const field_vector *y,
                     double fixed[ELEMENT_MAX_NODES][3])
{
    const int of = y->director == PLACE ? 0 : y->director;
    for (int node = 0; node < p->f->nodes; node++) {
        const double part = y->director == PLACE ? at->lean[node] : at->part[node];
        for (int i = 0; i < 3; i++)
            fixed[node][i] = part * p->vector[node][of][i];
    }
    for (int t = 0; t < TERMS && p->f->nodes == 2; t++) {
        const double half = y->term[t].sign / 2 * amplitude(p, at, y->term[t].functional);
        for (int node = 0; node < 2; node++)
            for (int i = 0; i < 3; i++)
                fixed[node][i] += half * p->vector[node][y->term[t].k][i];
    }
}

static void gradient_of(const pulled *p, const field_rows *at, const field_vector *y,
                        double fixed[ELEMENT_MAX_NODES][3], double T[3 * MOST])
{
    memset(T, 0, 3 * (size_t)p->n * sizeof *T);
    for (int node = 0; node < p->f->nodes; node++) {
        for (int i = 0; i < 3 && y->director == PLACE; i++)
            T[i * p->n + NODE_COORDINATES * node + i] = at->part[node];
        moving_rotation_gradient(fixed[node], NODE_COORDINATES * node + TURN, p->n, T);
    }
    for (int t = 0; t < TERMS && p->f->nodes == 2; t++) {
        double row[MOST] = {0};
        dense_add_transpose_mul(p->n, FIELD_MODES, 1, p->J, at->functional[y->term[t].functional],
                                row);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < p->n; j++)
                T[i * p->n + j] += y->term[t].sign * p->mean[y->term[t].k][i] * row[j];
    }
}

/* Adds (n_k x F) functional/2, the change of F . m_k due to the rotation of each node, to
 * turn[node]. */
static void add_mean_turn(const pulled *p, int k, double scale, const double F[3],
                          const double functional[FIELD_MODES], double turn[2][3][FIELD_MODES])
{
    for (int node = 0; node < 2; node++) {
        double arm[3];
        vec3_cross(p->vector[node][k], F, arm);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < FIELD_MODES; j++)
                turn[node][i][j] += scale / 2 * arm[i] * functional[j];
    }
}

static void add_force(pulled *p, const field_rows *at, const field_vector *y,
                      double fixed[ELEMENT_MAX_NODES][3], const double F[3])
{
    for (int node = 0; node < p->f->nodes; node++) {
        double *force = p->forces + NODE_COORDINATES * node, moment[3];
        vec3_cross(fixed[node], F, moment);
        for (int i = 0; i < 3; i++) {
            force[i] += y->director == PLACE ? at->part[node] * F[i] : 0;
            force[TURN + i] += moment[i];
        }
        if (p->K != NULL)
            moving_rotation_stiffness(F, fixed[node], NODE_COORDINATES * node + TURN, p->n, p->K);
    }
    for (int t = 0; t < TERMS && p->f->nodes == 2; t++) {
        const double *functional = at->functional[y->term[t].functional],
                     size = y->term[t].sign * vec3_dot(F, p->mean[y->term[t].k]);
        for (int j = 0; j < FIELD_MODES; j++)
            p->s[j] += size * functional[j];
        if (p->K != NULL)
            add_mean_turn(p, y->term[t].k, y->term[t].sign, F, functional, p->turn);
    }
}

typedef struct unit {
    const field_vector *of;
    double fixed[ELEMENT_MAX_NODES][3], v[3], length;
} unit;

static void unit_of(const pulled *p, const field_rows *at, int k, unit *out)
{
    out->of = &director[k];
    fixed_of(p, at, out->of, out->fixed);
    for (int i = 0; i < 3; i++) {
        out->v[i] = 0;
        for (int node = 0; node < p->f->nodes; node++)
            out->v[i] += out->fixed[node][i];
    }
    out->length = vec3_norm(out->v);
    for (int i = 0; i < 3; i++)
        out->v[i] /= out->length;
}

static void unit_gradient(const pulled *p, const field_rows *at, unit *u, double T[3 * MOST])
{
    gradient_of(p, at, u->of, u->fixed, T);
    for (int j = 0; j < p->n; j++) {
        double along = 0;
        for (int i = 0; i < 3; i++)
            along += u->v[i] * T[i * p->n + j];
        for (int i = 0; i < 3; i++)
            T[i * p->n + j] = (T[i * p->n + j] - along * u->v[i]) / u->length;
    }
}

/* Adds a force F on size times a unit vector. With the director n, v = n/|n| and P = 1 - v v^T,
 *   F . d2v = (P F/|n|) . d2n
 *     - (1/|n|^2) [(v . dn)(P F . dn) + (P F . dn)(v . dn) + (F . v) dn . P dn]. */
static void add_force_on_unit(pulled *p, const field_rows *at, unit *u, double size,
                              const double F[3])
{
    const double along = size * vec3_dot(F, u->v);
    double across[3], T[3 * MOST];
    for (int i = 0; i < 3; i++)
        across[i] = (size * F[i] - along * u->v[i]) / u->length;
    add_force(p, at, u->of, u->fixed, across);
    if (p->K == NULL)
        return;
    gradient_of(p, at, u->of, u->fixed, T);
    double v_T[MOST] = {0}, F_T[MOST] = {0};
    dense_add_transpose_mul(p->n, 3, 1, T, u->v, v_T);
    dense_add_transpose_mul(p->n, 3, 1, T, across, F_T);
    for (int i = 0; i < p->n; i++)
        for (int j = 0; j < p->n; j++) {
            double same = -v_T[i] * v_T[j];
            for (int k = 0; k < 3; k++)
                same += T[k * p->n + i] * T[k * p->n + j];
            p->K[i * p->n + j] += (v_T[i] * F_T[j] + F_T[i] * v_T[j]) / u->length +
                                  along * same / (u->length * u->length);
        }
}

static void rotation_gradient_of(const pulled *p, const field_rows *at, double T[3 * MOST])
{
    static const int functional[3] = {FIELD_CHI_X, FIELD_CHI_Y, FIELD_CHI_Z};
    memset(T, 0, 3 * (size_t)p->n * sizeof *T);
    for (int node = 0; node < p->f->nodes; node++)
        for (int i = 0; i < 3; i++)
            T[i * p->n + NODE_COORDINATES * node + TURN + i] = at->part[node];
    for (int k = 0; k < 3 && p->f->nodes == 2; k++) {
        double row[MOST] = {0};
        dense_add_transpose_mul(p->n, FIELD_MODES, 1, p->J, at->functional[functional[k]], row);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < p->n; j++)
                T[i * p->n + j] += p->mean[k][i] * row[j];
    }
}

/* Adds a moment M in global axes: the shares of the nodes, which have no potential, and the
 * contribution of the functionals to the rotation of the section. */
static void add_moment(pulled *p, const field_rows *at, const double M[3])
{
    static const int functional[3] = {FIELD_CHI_X, FIELD_CHI_Y, FIELD_CHI_Z};
    for (int node = 0; node < p->f->nodes; node++) {
        const int first = NODE_COORDINATES * node + TURN;
        const double half[3] = {at->part[node] * M[0] / 2, at->part[node] * M[1] / 2,
                                at->part[node] * M[2] / 2};
        for (int i = 0; i < 3; i++)
            p->forces[first + i] += at->part[node] * M[i];
        for (int i = 0; i < 3 && p->K != NULL; i++) { /* K_ij -= dF_i/dphi_j = M . (e_j x e_i)/2 */
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            p->K[(first + i) * p->n + first + j] += half[k];
            p->K[(first + j) * p->n + first + i] -= half[k];
        }
    }
    for (int k = 0; k < 3 && p->f->nodes == 2; k++) {
        const double *row = at->functional[functional[k]], size = vec3_dot(M, p->mean[k]);
        for (int j = 0; j < FIELD_MODES; j++)
            p->s[j] += size * row[j];
        if (p->K != NULL)
            add_mean_turn(p, k, 1, M, row, p->moment_turn);
    }
}

/* Subtracts T^T Q from K for loads that rotate with the section. */
static void subtract_following(pulled *p, const double T[3 * MOST], const double Q[3 * MOST])
{
    for (int i = 0; i < p->n; i++)
        for (int j = 0; j < p->n; j++)
            for (int k = 0; k < 3; k++)
                p->K[i * p->n + j] -= T[k * p->n + i] * Q[k * p->n + j];
}

/* Transforms a vector v from the axes of the section at the point to global axes and stores it in
 * `out`. Computes Q = dv/dx, the gradient of the result. */
static void follow(const pulled *p, const field_rows *at, unit axis[3], const double v[3],
                   double out[3], double Q[3 * MOST])
{
    double T[3 * MOST];
    memset(Q, 0, 3 * (size_t)p->n * sizeof *Q);
    for (int i = 0; i < 3; i++)
        out[i] = v[0] * axis[0].v[i] + v[1] * axis[1].v[i] + v[2] * axis[2].v[i];
    for (int k = 0; k < 3 && p->K != NULL; k++) {
        if (v[k] == 0)
            continue;
        unit_gradient(p, at, &axis[k], T);
        for (int i = 0; i < 3 * p->n; i++)
            Q[i] += v[k] * T[i];
    }
}

static void add_one(pulled *p, const field_rows *at, const field_load *load)
{
    const int levered = vec3_norm(load->arm) > 0;
    double fixed[ELEMENT_MAX_NODES][3], F[3], M[3], Q[3 * MOST], T[3 * MOST];
    unit axis[3];
    for (int k = 0; k < 3 && (levered || load->follower); k++)
        unit_of(p, at, k, &axis[k]);
    fixed_of(p, at, &place, fixed);
    memcpy(F, load->force, sizeof F);
    memcpy(M, load->moment, sizeof M);
    if (load->follower) {
        follow(p, at, axis, load->moment, M, Q);
        if (p->K != NULL && vec3_norm(M) > 0) {
            rotation_gradient_of(p, at, T);
            subtract_following(p, T, Q);
        }
        follow(p, at, axis, load->force, F, Q);
        if (p->K != NULL) {
            gradient_of(p, at, &place, fixed, T);
            for (int k = 0; k < 3; k++) {
                double turned[3 * MOST];
                if (load->arm[k] == 0)
                    continue;
                unit_gradient(p, at, &axis[k], turned);
                for (int i = 0; i < 3 * p->n; i++)
                    T[i] += load->arm[k] * turned[i];
            }
            subtract_following(p, T, Q);
        }
    }
    if (vec3_norm(M) > 0)
        add_moment(p, at, M);
    add_force(p, at, &place, fixed, F);
    for (int k = 0; k < 3; k++)
        if (load->arm[k] != 0)
            add_force_on_unit(p, at, &axis[k], load->arm[k], F);
}

static void add_functionals(pulled *p, const node_state x[])
{
    double H[2 * NODE_COORDINATES * 2 * NODE_COORDINATES];
    dense_add_transpose_mul(p->n, FIELD_MODES, 1, p->J, p->s, p->forces);
    if (p->K == NULL)
        return;
    for (int node = 0; node < 2; node++)
        for (int i = 0; i < 3; i++) {
            const int row = NODE_COORDINATES * node + TURN + i;
            double both[MOST] = {0}, one[MOST] = {0};
            dense_add_transpose_mul(p->n, FIELD_MODES, 1, p->J, p->turn[node][i], both);
            dense_add_transpose_mul(p->n, FIELD_MODES, 1, p->J, p->moment_turn[node][i], one);
            for (int j = 0; j < p->n; j++) {
                p->K[row * p->n + j] -= both[j];
                p->K[j * p->n + row] -= both[j] + one[j];
            }
        }
    beamw_modes_evaluate(p->f->l0, x, &(strain_output){.s = p->s, .H = H});
    for (int i = 0; i < p->n * p->n; i++)
        p->K[i] -= H[i];
}

void field_add_loads(const displacement_field *f, const node_state x[], int count,
                     const field_rows rows[], const field_load load[], double forces[], double K[])
{
    pulled p = {.f = f, .n = NODE_COORDINATES * f->nodes, .forces = forces, .K = K};
    for (int node = 0; node < f->nodes; node++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                p.vector[node][k][i] = x[node].R[3 * i + k];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            p.mean[k][i] = (p.vector[0][k][i] + p.vector[1][k][i]) / 2;
    if (f->nodes == 2)
        beamw_modes_evaluate(f->l0, x, &(strain_output){.e = p.e, .J = p.J});
    for (int i = 0; i < count; i++)
        add_one(&p, &rows[i], &load[i]);
    if (f->nodes == 2)
        add_functionals(&p, x);
}
