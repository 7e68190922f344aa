#include <string.h>

#include "elements/beamw/fields.h"
#include "elements/beamw/modes.h"
#include "elements/beamw/variants.h"
#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/shared/masses.h"

/* Vectors from which the consistent mass is integrated, at each quadrature point: the position and
 * the rotated section axes, as functions of the nodal coordinates. */

enum { N = 14, RP = 0, TP = 3, AP = 6, RQ = 7, TQ = 10, AQ = 13 };
enum { NU_Y, NU_Z, CHI_X, CHI_Y, CHI_Z, PSI }; /* PSI: warping amplitude */

/* State of the element, and sums over the points for the second derivatives. */
typedef struct beamw_inertia_state {
    double vector[2][3][3];
    double mean[3][3]; /* m_k */
    double e[8], J[8 * N];
    double s[8];       /* sums of F . m_k times the functionals, conjugate to the strains */
    double turn[6][8]; /* derivatives of F . m_k with respect to the rotations of p and q */
    const node_state *x;
    const element_rotating_frame *frame;
    inertia_output *out;
} beamw_inertia_state;

typedef struct beamw_inertia_values {
    double x, mass;
    const double (*field)[8];
    double value[BEAMW_FIELDS], gradient[BEAMW_FIELDS][N];
} beamw_inertia_values;

enum { POSITION = -1, NOTHING = -2, TERMS = 2 };

/* A vector y = lin(v) + sum of sign m_k (field . e), where v is a vector of the nodes. */
typedef struct beamw_inertia_vector {
    int director; /* index of a unit vector, POSITION, or NOTHING if there is no v */
    int terms;
    struct {
        int k, field;
        double sign;
    } term[TERMS];
} beamw_inertia_vector;

/* Computes the gradient of f . e from the nonzero entries of J. Elongation and bending depend on
 * the position of q relative to p. The rotation of a node affects twist and two of the four bending
 * modes. */
static void gradient_of(const double J[8 * N], const double f[8], double out[N])
{
    for (int i = 0; i < 3; i++) {
        const double *r = J + RQ + i, *p = J + TP + i, *q = J + TQ + i;
        out[RQ + i] =
            f[0] * r[0] + f[2] * r[2 * N] + f[3] * r[3 * N] + f[4] * r[4 * N] + f[5] * r[5 * N];
        out[RP + i] = -out[RQ + i];
        out[TP + i] = f[1] * p[N] + f[2] * p[2 * N] + f[4] * p[4 * N];
        out[TQ + i] = f[1] * q[N] + f[3] * q[3 * N] + f[5] * q[5 * N];
    }
    out[AP] = f[6] * J[6 * N + AP];
    out[AQ] = f[7] * J[7 * N + AQ];
}

/* Returns the number of fields, from the first, on which the inertia depends. */
static int fields_of(const lumped_mass *l)
{
    if (!l->turns)
        return CHI_X + 1;
    return l->warping > 0 ? BEAMW_FIELDS : PSI;
}

static void beamw_inertia_values_at(const beamw_inertia_state *c, const beamw_spread *d, int g,
                                    beamw_inertia_values *out)
{
    const int fields = fields_of(&d->lumped);
    out->x = d->at[g];
    out->mass = d->share * 2 * d->weight[g];
    out->field = d->field[g];
    for (int k = 0; k < fields; k++) {
        const double *field = d->field[g][k];
        out->value[k] = 0;
        for (int i = 0; i < 8; i++)
            out->value[k] += field[i] * c->e[i];
        gradient_of(c->J, field, out->gradient[k]);
    }
}

/* Computes dy/dx without the rotation of vectors fixed to the nodes. */
static void beamw_inertia_gradient(const beamw_inertia_state *c, const beamw_inertia_values *at,
                                   const beamw_inertia_vector *y, double T[3 * N])
{
    static const double none[N] = {0};
    const double *g[TERMS] = {at->gradient[y->term[0].field],
                              y->terms > 1 ? at->gradient[y->term[1].field] : none};
    for (int i = 0; i < 3; i++) {
        const double m[TERMS] = {y->term[0].sign * c->mean[y->term[0].k][i],
                                 y->term[1].sign * c->mean[y->term[1].k][i]};
        const double p = (1 - at->x) + m[0] * g[0][RP + i], q = at->x + m[0] * g[0][RQ + i];
        for (int j = 0; j < N; j++)
            T[N * i + j] = m[0] * g[0][j] + m[1] * g[1][j];
        if (y->director == POSITION) {
            T[N * i + RP + i] = p + m[1] * g[1][RP + i];
            T[N * i + RQ + i] = q + m[1] * g[1][RQ + i];
        }
    }
}

/* Computes r = y, for a position relative to the centre of the rotating frame, and fixed[node], the
 * part of y that rotates with each node. */
static void beamw_inertia_place(const beamw_inertia_state *c, const beamw_inertia_values *at,
                                const beamw_inertia_vector *y, double r[3], double fixed[2][3])
{
    const double weight[2] = {1 - at->x, at->x};
    for (int i = 0; i < 3; i++) {
        r[i] = 0;
        for (int node = 0; node < 2; node++) {
            fixed[node][i] = 0;
            if (y->director >= 0) {
                fixed[node][i] = weight[node] * c->vector[node][y->director][i];
                r[i] += fixed[node][i];
            } else if (y->director == POSITION && c->frame != NULL) {
                r[i] += weight[node] * (c->x[node].r[i] - c->frame->centre[i]);
            }
        }
        for (int k = 0; k < y->terms; k++) {
            const double amplitude = y->term[k].sign * at->value[y->term[k].field];
            r[i] += c->mean[y->term[k].k][i] * amplitude;
            for (int node = 0; node < 2; node++)
                fixed[node][i] += amplitude / 2 * c->vector[node][y->term[k].k][i];
        }
    }
}

enum { BEAMW_CUBIC_POINTS = 4 };

static void functionals_at(const section *c, double l, const beamw_stiffness_fields *s, double x,
                           double field[BEAMW_FIELDS][8])
{
    const double e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    const double bend_y[8] = {0, 0, 1 - x, -x},
                 bend_z[8] = {0, 0, 0, 0, 1 - x, -x}; /* slope of the chord minus lin(theta) */
    const double b = x * (1 - x), cubic = b * (1 - 2 * x), db = 1 - 2 * x, dcubic = 1 - 6 * b;
    for (int k = 0; k < 8; k++) {
        const double chi_x = (b * s->A[k] - cubic * s->tw[k]) / l;
        field[CHI_X][k] = chi_x;
        field[NU_Y][k] = c->zs * chi_x - b / 2 * sum_z[k] - l * cubic * s->hg[0][k];
        field[NU_Z][k] = -c->ys * chi_x + b / 2 * sum_y[k] - l * cubic * s->hg[1][k];
        field[CHI_Z][k] = (bend_z[k] - db / 2 * sum_z[k]) / l - c->zs * e2[k] / (l * l) -
                          dcubic * s->hg[0][k] - s->g[0][k];
        field[CHI_Y][k] = (bend_y[k] - db / 2 * sum_y[k]) / l - c->ys * e2[k] / (l * l) +
                          dcubic * s->hg[1][k] + s->g[1][k];
        field[PSI][k] = (e2[k] + db * s->A[k] - dcubic * s->tw[k]) / (l * l) - s->g[2][k];
    }
}

void beamw_inertia_prepare(const section *c, unsigned features, beamw_inertia_kind kind,
                           const beamw_stiffness_fields *fields, element_data *d)
{
    beamw_spread *s = &d->spread;
    s->lumped = lumped_of(c, features, d->l0 / 2);
    static const double share[] = {
        [BEAMW_INERTIA_LUMPED] = 0, [BEAMW_INERTIA_CONSISTENT] = 1, [BEAMW_INERTIA_AVERAGED] = 0.5};
    s->share = share[kind];
    quadrature_points(BEAMW_CUBIC_POINTS, s->at, s->weight); /* exact for the square of a cubic */
    s->l0 = d->l0;
    s->points = BEAMW_CUBIC_POINTS;
    if (s->share > 0)
        for (int g = 0; g < s->points; g++) {
            functionals_at(c, d->l0, fields, s->at[g], s->field[g]);
            if (!(features & FEATURE_WARPING))
                for (int k = 0; k < BEAMW_FIELDS;
                     k++) { /* uniform torsion, where e7 and e8 equal e2 */
                    s->field[g][k][1] += s->field[g][k][6] + s->field[g][k][7];
                    s->field[g][k][6] = s->field[g][k][7] = 0;
                }
        }
}

/* Consistent mass. The fields are those of J section 3.2, with the shear functionals of fields.h:
 *
 *   x = s/l, c = x (1 - x),
 *   v_s = chord - [(e5+e6)/2 c + l hg_y c (1-2x)],
 *   w_s = chord + [(e3+e4)/2 c - l hg_z c (1-2x)],
 *   l phi = l phi_p + e2 x + A c - tw c (1-2x),
 *   v_c = v_s + zs phi, w_c = w_s - ys phi,
 *   theta_z = v_s' - g_y, theta_y = -(w_s' - g_z), a = phi' - g_w,
 *
 * The code writes each field as interpolated nodal values plus functionals of the strains, such as
 * v_c = lin(v) + nu_y . e. In the deformed state, the functionals act along m_k, the mean of the
 * unit vectors of the nodes (derived here):
 *
 *   r = lin(r) + m_y (nu_y . e) + m_z (nu_z . e),
 *   n_y = lin(n_y) + m_z (chi_x . e) - m_x (chi_z . e), ...
 *
 * The warping displacement is along m_x, with the amplitude a. These vectors are linear in e and in
 * vectors fixed to the nodes. Therefore their first and second derivatives are exact. Second-order
 * terms of the fields, which are neglected, cause an error of the centrifugal force of order
 * l^4. */

static const beamw_inertia_vector position = {POSITION, 2, {{1, NU_Y, 1}, {2, NU_Z, 1}}},
                                  director[3] = {{0, 2, {{1, CHI_Z, 1}, {2, CHI_Y, -1}}},
                                                 {1, 2, {{0, CHI_Z, -1}, {2, CHI_X, 1}}},
                                                 {2, 2, {{0, CHI_Y, 1}, {1, CHI_X, -1}}}},
                                  warping = {NOTHING, 1, {{0, PSI, 1}}};

static void gather_curvature(beamw_inertia_state *c, const double F[3],
                             const beamw_inertia_values *at, const beamw_inertia_vector *y)
{
    for (int k = 0; k < y->terms; k++) {
        const double *field = at->field[y->term[k].field],
                     size = y->term[k].sign * vec3_dot(F, c->mean[y->term[k].k]);
        double h[6];
        for (int node = 0; node < 2; node++)
            vec3_cross(c->vector[node][y->term[k].k], F, h + 3 * node);
        for (int j = 0; j < 8; j++) {
            c->s[j] += size * field[j];
            for (int i = 0; i < 6; i++)
                c->turn[i][j] += y->term[k].sign / 2 * h[i] * field[j];
        }
    }
}

static void add_interpolated(beamw_inertia_state *c, const beamw_inertia_values *at,
                             const beamw_inertia_vector *y, double mass)
{
    double T[3 * N], fixed[2][3], F[3], *const stiffness = moving_stiffness(c->frame, c->out);
    moving_vector v = {.mass = mass, .at = 0, .columns = N, .T = T};
    beamw_inertia_place(c, at, y, v.y, fixed);
    beamw_inertia_gradient(c, at, y, T);
    moving_rotation_gradient(fixed[0], TP, N, T);
    moving_rotation_gradient(fixed[1], TQ, N, T);
    moving_add(&v, c->frame, N, c->out, F);
    if (stiffness == NULL)
        return;
    moving_rotation_stiffness(F, fixed[0], TP, N, stiffness);
    moving_rotation_stiffness(F, fixed[1], TQ, N, stiffness);
    gather_curvature(c, F, at, y);
}

/* Adds the inertia of the twist rate about the axis. A rotating frame does not affect this
 * inertia. */
static void add_twist(const beamw_inertia_state *c, const beamw_inertia_values *at, double mass)
{
    double row[N], scaled[N];
    if (c->out->M == NULL)
        return;
    memcpy(row, at->gradient[CHI_X], sizeof row);
    for (int i = 0; i < 3; i++) {
        row[TP + i] += (1 - at->x) * c->vector[0][0][i];
        row[TQ + i] += at->x * c->vector[1][0][i];
    }
    for (int i = 0; i < N; i++)
        scaled[i] = mass * row[i];
    REAL_CHOSEN(congruence_add_upper)(1, 1, scaled, row, c->out->M);
}

/* Adds size times a vector of the field to y and size times its gradient to T. */
static void add_part(const beamw_inertia_state *c, const beamw_inertia_values *at,
                     const beamw_inertia_vector *part, double size, moving_vector *y,
                     double T[3 * N], double fixed[2][3])
{
    double own[3 * N], r[3], turned[2][3];
    beamw_inertia_place(c, at, part, r, turned);
    beamw_inertia_gradient(c, at, part, own);
    moving_rotation_gradient(turned[0], TP, N, own);
    moving_rotation_gradient(turned[1], TQ, N, own);
    for (int i = 0; i < 3 * N; i++)
        T[i] += size * own[i];
    for (int i = 0; i < 3; i++) {
        y->y[i] += size * r[i];
        fixed[0][i] += size * turned[0][i];
        fixed[1][i] += size * turned[1][i];
    }
}

/* Adds the vectors of a section given by matrices: the position of the centre of mass, and
 * directions in the section. */
static void add_vectors(beamw_inertia_state *c, const beamw_spread *d,
                        const beamw_inertia_values *at)
{
    double *const stiffness = moving_stiffness(c->frame, c->out);
    for (int n = 0; n < d->lumped.vectors; n++) {
        const double *of = d->lumped.vector[n];
        double T[3 * N] = {0}, fixed[2][3] = {{0}}, F[3];
        moving_vector v = {.mass = at->mass * d->lumped.carried[n], .columns = N, .T = T};
        if (n == 0)
            add_part(c, at, &position, 1, &v, T, fixed);
        for (int k = 0; k < 3; k++)
            add_part(c, at, &director[k], of[k], &v, T, fixed);
        moving_add(&v, c->frame, N, c->out, F);
        if (stiffness == NULL)
            continue;
        moving_rotation_stiffness(F, fixed[0], TP, N, stiffness);
        moving_rotation_stiffness(F, fixed[1], TQ, N, stiffness);
        if (n == 0)
            gather_curvature(c, F, at, &position);
        for (int k = 0; k < 3; k++) {
            const double share[3] = {of[k] * F[0], of[k] * F[1], of[k] * F[2]};
            gather_curvature(c, share, at, &director[k]);
        }
    }
}

static void add_point(beamw_inertia_state *c, const beamw_spread *d, int g)
{
    beamw_inertia_values at;
    double j[3];
    beamw_inertia_values_at(c, d, g, &at);
    const double weight = at.mass;
    if (d->lumped.vectors > 0) {
        add_vectors(c, d, &at);
        return;
    }
    add_interpolated(c, &at, &position, weight * d->lumped.mass);
    if (!d->lumped.turns) {
        add_twist(c, &at, weight * d->lumped.rotary[0]);
        return;
    }
    lumped_directors(d->lumped.rotary, j);
    for (int k = 0; k < 3; k++)
        add_interpolated(c, &at, &director[k], weight * j[k]);
    if (d->lumped.warping > 0)
        add_interpolated(c, &at, &warping, weight * d->lumped.warping);
}

/* Subtracts the sum of F . d2y/dx2 from N. The sum contains products of rotations with gradients of
 * the strains, and second derivatives of the strains. */
static void add_curvature(const beamw_spread *d, const beamw_inertia_state *c)
{
    static const int row[6] = {TP, TP + 1, TP + 2, TQ, TQ + 1, TQ + 2};
    double H[N * N], *const out = moving_stiffness(c->frame, c->out);
    for (int i = 0; i < 6; i++) {
        double product[N] = {0};
        dense_add_transpose_mul(N, 8, 1, c->J, c->turn[i], product);
        for (int j = 0; j < N; j++) {
            out[N * row[i] + j] -= product[j];
            out[N * j + row[i]] -= product[j];
        }
    }
    beamw_modes_evaluate(d->l0, c->x, &(strain_output){.s = c->s, .H = H});
    for (int i = 0; i < N * N; i++)
        out[i] -= H[i];
}

static void add_consistent(const beamw_spread *d, const node_state x[2],
                           const element_rotating_frame *frame, inertia_output *out)
{
    beamw_inertia_state c = {.x = x, .frame = frame, .out = out};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            for (int node = 0; node < 2; node++)
                c.vector[node][k][i] = x[node].R[3 * i + k];
            c.mean[k][i] = (c.vector[0][k][i] + c.vector[1][k][i]) / 2;
        }
    beamw_modes_evaluate(d->l0, x, &(strain_output){.e = c.e, .J = c.J});
    for (int g = 0; g < d->points; g++)
        add_point(&c, d, g);
    if (frame != NULL && out->N != NULL)
        add_curvature(d, &c);
}

status beamw_spread_inertia(const beamw_spread *d, const node_state x[2],
                            const element_rotating_frame *frame, inertia_output *out)
{
    moving_clear(N, out);
    if (frame == NULL && out->rate != NULL) {
        REAL_CHOSEN(beamw_in_time)(d, x, out);
        moving_complete(N, out);
        return STATUS_OK;
    }
    if (d->share < 1)
        for (int node = 0; node < 2; node++)
            lumped_add(&d->lumped, 1 - d->share, &x[node], frame, NODE_COORDINATES * node, N, out);
    if (d->share > 0)
        add_consistent(d, x, frame, out);
    moving_complete(N, out);
    return STATUS_OK;
}

status beamw_inertia_of(const element_data *d, const node_state x[],
                        const element_rotating_frame *frame, inertia_output *out)
{
    return beamw_spread_inertia(&d->spread, x, frame, out);
}
