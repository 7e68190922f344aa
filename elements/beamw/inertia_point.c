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
