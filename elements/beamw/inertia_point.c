#include "elements/beamw/inertia_point.h"

/* What is not zero in the gradients of the strains: all modes but twist depend on where q is from
 * p, two of four bending modes turn with each node. */
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

/* Of the field k. */
static void rates_at(const beamw_inertia_state *c, int k, beamw_inertia_values *out)
{
    const double *field = out->field[k];
    out->rate[k] = out->curvature[k] = 0;
    for (int i = 0; i < N; i++)
        out->rate[k] += out->gradient[k][i] * c->out->rate[i];
    for (int i = 0; i < 6; i++) /* those of warping are linear */
        out->curvature[k] += field[i] * c->ec[i];
    if (c->out->C != NULL)
        gradient_of(c->slope, field, out->slope[k]);
}

void beamw_inertia_values_at(const beamw_inertia_state *c, const beamw_spread *d, int g,
                             beamw_inertia_values *out)
{
    out->x = d->at[g];
    out->mass = d->share * 2 * d->weight[g];
    out->field = d->field[g];
    for (int k = 0; k < BEAMW_FIELDS; k++) {
        const double *field = d->field[g][k];
        out->value[k] = 0;
        for (int i = 0; i < 8; i++)
            out->value[k] += field[i] * c->e[i];
        gradient_of(c->J, field, out->gradient[k]);
        if (c->in_time)
            rates_at(c, k, out);
    }
}

void beamw_inertia_gradient(const beamw_inertia_state *c, const beamw_inertia_values *at,
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

void beamw_inertia_place(const beamw_inertia_state *c, const beamw_inertia_values *at,
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

/* A += f times row */
static void add_outer(double factor, const double f[3], const double row[N], double A[3 * N])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < N; j++)
            A[N * i + j] += factor * f[i] * row[j];
}

void beamw_inertia_convective(const beamw_inertia_state *c, const beamw_inertia_values *at,
                              const beamw_inertia_vector *y, double fixed[2][3], double y_c[3],
                              double rates[3 * N], double displacement[3 * N])
{
    static const int turns[2] = {TP, TQ};
    for (int node = 0; node < 2; node++)
        moving_fixed(&c->node[node], fixed[node], turns[node], N, y_c, rates, displacement);
    for (int t = 0; t < y->terms; t++) {
        const int k = y->term[t].k, field = y->term[t].field;
        const double sign = y->term[t].sign;
        for (int i = 0; i < 3; i++)
            y_c[i] += sign * (2 * c->mean_rate[k][i] * at->rate[field] +
                              c->mean[k][i] * at->curvature[field]);
        if (rates == NULL)
            continue;
        add_outer(2 * sign, c->mean_rate[k], at->gradient[field], rates);
        add_outer(2 * sign, c->mean[k], at->slope[field], rates);
        for (int node = 0; node < 2; node++) {
            double turned[3];
            for (int i = 0; i < 3; i++)
                turned[i] = sign * at->rate[field] * c->vector[node][k][i];
            moving_rotation_gradient(turned, turns[node], N, rates);
        }
    }
}
