/* Consistent mass.  The fields are those of J section 3.2 (shear functionals as in stiffness.h), x
 * = s/l, c = x (1 - x), v_s = chord - [(e5+e6)/2 c + l hg_y c (1-2x)],  w_s = chord + [(e3+e4)/2 c
 * - l hg_z c (1-2x)], l phi = l phi_p + e2 x + A c - tw c (1-2x),     v_c = v_s + zs phi,  w_c =
 * w_s - ys phi, theta_z = v_s' - g_y,  theta_y = -(w_s' - g_z),  a = phi' - g_w, written as the
 * nodes' values between p and q plus functionals of the strains: v_c = lin(v) + nu_y . e and so on.
 * In the deformed state the functionals go along the mean m_k of the nodes' unit vectors (ours): r
 * = lin(r) + m_y (nu_y . e) + m_z (nu_z . e),  n_y = lin(n_y) + m_z (chi_x . e) - m_x (chi_z . e),
 * ... and the displacement of warping a m_x, which are linear in e and in vectors fixed to the
 * nodes: their first two derivatives are exact, and so is what derives from the kinetic energy. The
 * error of the centrifugal force in the fields' second order vanishes with the fourth power of l.
 */
#include "elements/beamw/inertia.h"

#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/shared/moving.h"

enum { N = 14, TP = 3, TQ = 10 };
enum { NU_Y, NU_Z, CHI_X, CHI_Y, CHI_Z, PSI }; /* the last: warping amplitude */

static void functionals_at(const section *c, double l, const beamw_stiffness_fields *s, double x,
                           double field[BEAMW_FIELDS][8])
{
    const double e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    const double bend_y[8] = {0, 0, 1 - x, -x},
                 bend_z[8] = {0, 0, 0, 0, 1 - x, -x}; /* slope of the chord less lin(theta) */
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
    d->lumped = lumped_of(c, features, d->l0 / 2);
    static const double share[] = {
        [BEAMW_INERTIA_LUMPED] = 0, [BEAMW_INERTIA_CONSISTENT] = 1, [BEAMW_INERTIA_AVERAGED] = 0.5};
    d->share = share[kind];
    quadrature_points(BEAMW_GAUSS, d->at, d->weight); /* exact for the square of a cubic */
    if (d->share > 0)
        for (int g = 0; g < BEAMW_GAUSS; g++) {
            functionals_at(c, d->l0, fields, d->at[g], d->field[g]);
            if (!(features & FEATURE_WARPING))
                for (int k = 0; k < BEAMW_FIELDS; k++) { /* uniform torsion: e7 and e8 follow e2 */
                    d->field[g][k][1] += d->field[g][k][6] + d->field[g][k][7];
                    d->field[g][k][6] = d->field[g][k][7] = 0;
                }
        }
}

/* The element's state, and what the points gather for the second derivatives of the strains. */
typedef struct configuration {
    double vector[2][3][3]; /* node, direction: unit vectors */
    double mean[3][3];      /* m_k */
    double e[8], J[8 * N], s[8];
    const node_state *x;
    const element_rotating_frame *frame;
    inertia_output *out;
} configuration;

enum { POSITION = -1, NOTHING = -2 };

/* y = lin(a vector of the nodes) + sum_k m_k (along[k] . e). */
typedef struct interpolation {
    double mass, x;
    int director;           /* unit vector, or one of the next */
    const double *along[3]; /* [8] functional, NULL: none */
    double sign[3];
} interpolation;

static void linear_part(const configuration *c, const interpolation *y, moving_vector *v,
                        double T[3 * N], double fixed[2][3])
{
    const double weight[2] = {1 - y->x, y->x};
    for (int node = 0; node < 2; node++)
        for (int i = 0; i < 3; i++) {
            if (y->director >= 0) {
                fixed[node][i] = weight[node] * c->vector[node][y->director][i];
                v->y[i] += fixed[node][i];
            } else if (y->director == POSITION) {
                T[N * i + NODE_COORDINATES * node + i] = weight[node];
                v->y[i] +=
                    weight[node] * (c->x[node].r[i] - (c->frame != NULL ? c->frame->centre[i] : 0));
            }
        }
}

/* N -= h g^T + g h^T with h = d(F . m_k)/dx and g = d(functional . e)/dx; F . m_k is the
 * functional's share of the stress. */
static void add_curvature(configuration *c, const double F[3], int k, double sign,
                          const double functional[8], const double g[N])
{
    const double size = sign * vec3_dot(F, c->mean[k]);
    for (int i = 0; i < 8; i++)
        c->s[i] += size * functional[i];
    for (int node = 0; node < 2; node++) {
        double h[3];
        vec3_cross(c->vector[node][k], F, h);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < N; j++) {
                const int row = NODE_COORDINATES * node + 3 + i;
                c->out->N[N * row + j] -= h[i] / 2 * g[j];
                c->out->N[N * j + row] -= h[i] / 2 * g[j];
            }
    }
}

static void add_interpolated(configuration *c, const interpolation *y)
{
    double T[3 * N] = {0}, gradient[3][N] = {{0}}, fixed[2][3] = {{0}}, F[3];
    moving_vector v = {.mass = y->mass, .at = 0, .columns = N, .T = T};
    linear_part(c, y, &v, T, fixed);
    for (int k = 0; k < 3; k++) {
        if (y->along[k] == NULL)
            continue;
        double amplitude = 0;
        for (int i = 0; i < 8; i++)
            amplitude += y->sign[k] * y->along[k][i] * c->e[i];
        dense_add_transpose_mul(N, 8, 1, c->J, y->along[k], gradient[k]);
        for (int i = 0; i < 3; i++) {
            v.y[i] += c->mean[k][i] * amplitude;
            for (int node = 0; node < 2; node++)
                fixed[node][i] += amplitude / 2 * c->vector[node][k][i];
        }
        for (int j = 0; j < N; j++) {
            gradient[k][j] *= y->sign[k];
            for (int i = 0; i < 3; i++)
                T[N * i + j] += c->mean[k][i] * gradient[k][j];
        }
    }
    moving_rotation_gradient(fixed[0], TP, N, T);
    moving_rotation_gradient(fixed[1], TQ, N, T);
    moving_add(&v, c->frame, N, c->out, F);
    if (c->out->N == NULL)
        return;
    moving_rotation_stiffness(F, fixed[0], TP, N, c->out->N);
    moving_rotation_stiffness(F, fixed[1], TQ, N, c->out->N);
    for (int k = 0; k < 3; k++)
        if (y->along[k] != NULL)
            add_curvature(c, F, k, y->sign[k], y->along[k], gradient[k]);
}

/* A twist whose rate has a mass and which no rotating frame acts on. */
static void add_scalar(const configuration *c, double mass, const double row[N])
{
    if (c->out->M != NULL)
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                c->out->M[N * i + j] += mass * row[i] * row[j];
}

static void add_point(configuration *c, const element_data *d, int g)
{
    const double weight = d->share * 2 * d->weight[g], x = d->at[g];
    const double *const chi_x = d->field[g][CHI_X], *const chi_y = d->field[g][CHI_Y],
                        *const chi_z = d->field[g][CHI_Z];
    double row[N] = {0}, j[3];
    add_interpolated(c, &(interpolation){.mass = weight * d->lumped.mass,
                                         .x = x,
                                         .director = POSITION,
                                         .along = {NULL, d->field[g][NU_Y], d->field[g][NU_Z]},
                                         .sign = {0, 1, 1}});
    if (!d->lumped.turns) { /* the twist alone */
        for (int node = 0; node < 2; node++)
            for (int i = 0; i < 3; i++)
                row[NODE_COORDINATES * node + 3 + i] =
                    (node == 0 ? 1 - x : x) * c->vector[node][0][i];
        dense_add_transpose_mul(N, 8, 1, c->J, chi_x, row);
        add_scalar(c, weight * d->lumped.rotary[0], row);
        return;
    }
    const interpolation director[3] = {{.along = {NULL, chi_z, chi_y}, .sign = {0, 1, -1}},
                                       {.along = {chi_z, NULL, chi_x}, .sign = {-1, 0, 1}},
                                       {.along = {chi_y, chi_x, NULL}, .sign = {1, -1, 0}}};
    lumped_directors(d->lumped.rotary, j);
    for (int k = 0; k < 3; k++) {
        interpolation y = director[k];
        y.mass = weight * j[k];
        y.x = x;
        y.director = k;
        add_interpolated(c, &y);
    }
    if (d->lumped.warping > 0)
        add_interpolated(c, &(interpolation){.mass = weight * d->lumped.warping,
                                             .x = x,
                                             .director = NOTHING,
                                             .along = {d->field[g][PSI], NULL, NULL},
                                             .sign = {1, 0, 0}});
}

static void add_consistent(const element_data *d, const node_state x[2],
                           const element_rotating_frame *frame, inertia_output *out)
{
    configuration c = {.x = x, .frame = frame, .out = out};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            for (int node = 0; node < 2; node++)
                c.vector[node][k][i] = x[node].R[3 * i + k];
            c.mean[k][i] = (c.vector[0][k][i] + c.vector[1][k][i]) / 2;
        }
    beamw_modes_strain(d->l0, x, &(strain_output){.e = c.e, .J = c.J});
    for (int g = 0; g < BEAMW_GAUSS; g++)
        add_point(&c, d, g);
    if (out->N == NULL || frame == NULL)
        return;
    double H[N * N];
    beamw_modes_strain(d->l0, x, &(strain_output){.s = c.s, .H = H});
    for (int i = 0; i < N * N; i++)
        out->N[i] -= H[i];
}

status beamw_inertia_of(const element_data *d, const node_state x[],
                        const element_rotating_frame *frame, inertia_output *out)
{
    moving_clear(N, out);
    if (d->share < 1)
        for (int node = 0; node < 2; node++)
            lumped_add(&d->lumped, 1 - d->share, &x[node], frame, NODE_COORDINATES * node, N, out);
    if (d->share > 0)
        add_consistent(d, x, frame, out);
    return STATUS_OK;
}
