/* The mixed equations of several elements of one kind at once, from strains and stresses that stay
 * in their lanes; the sums of harness/newton in their order. */
#ifndef BEAMWORK_LANES_EQUATIONS_H
#define BEAMWORK_LANES_EQUATIONS_H

#include "elements/shared/lanes.h"

/* All that is computed in lanes. */
typedef struct lanes_equations {
    real J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
        SJ[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
        C[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS],
        K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    real e[ELEMENT_MAX_STRAINS], s[ELEMENT_MAX_STRAINS], sigma[ELEMENT_MAX_STRAINS],
        incompatibility[ELEMENT_MAX_STRAINS];
    real force[ELEMENT_MAX_COORDINATES], present[ELEMENT_MAX_COORDINATES];
    real inner[LANES_INNER], memory[LANES_MEMORY];
} lanes_equations;

/* sigma of stress(e) += C (D(x) - e). */
static inline __attribute__((always_inline)) void lanes_equations_mix(int strains,
                                                                      lanes_equations *q)
{
    for (int i = 0; i < strains; i++) {
        real more = real_of(0);
        for (int j = 0; j < strains; j++)
            more += q->C[i * strains + j] * q->incompatibility[j];
        q->sigma[i] += more;
    }
}

/* out = J^T s. */
static inline __attribute__((always_inline)) void
lanes_equations_force(int strains, int columns, const real J[], const real s[], real out[])
{
    for (int j = 0; j < columns; j++)
        out[j] = real_of(0);
    for (int i = 0; i < strains; i++)
        for (int j = 0; j < columns; j++)
            out[j] += s[i] * J[i * columns + j];
}

/* K += J^T C J.  Of two nodes that count by their difference, the coordinates of the places of the
 * first one have minus the entries of the second, but for the block of both: it is as symmetric as
 * H is. */
static inline __attribute__((always_inline)) void lanes_equations_stiffness(lanes_sizes n,
                                                                            lanes_equations *q)
{
    enum { N = NODE_COORDINATES, TWO = 2 * N, OWN = TWO - 3 };
    real *K = q->K;
    if (!n.relative) {
        real_add_congruence(n.strains, N * n.nodes, 0, N, q->J, q->C, q->SJ, K);
        return;
    }
    real_add_congruence(n.strains, TWO, 3, OWN, q->J, q->C, q->SJ, K);
    for (int i = 0; i < n.strains; i++)
        for (int k = 0; k < 3; k++)
            q->SJ[TWO * i + k] = -q->SJ[TWO * i + N + k];
    for (int k = 0; k < 3; k++) {
        real_add_row(n.strains, 3, q->J + N + k, TWO, q->SJ, TWO, K + TWO * (N + k));
        real_add_row(n.strains, 3, q->J + k, TWO, q->SJ + N, TWO, K + TWO * k + N);
        for (int j = 3; j < TWO; j++)
            if (j < N || j > N + 2) {
                K[TWO * j + k] = -K[TWO * j + N + k];
                K[TWO * k + j] = -K[TWO * (N + k) + j];
            }
        for (int j = 0; j < 3; j++)
            K[TWO * k + j] = K[TWO * (N + k) + N + j];
    }
}

static inline __attribute__((always_inline)) void
lanes_equations_run(lanes_sizes n, lanes_strain *strain, lanes_stress *stress, status failure,
                    int run, const element_data *data, const node_state x[],
                    const double *const e[], const double *const inner[], const double *const s[],
                    equations_output out[], status outcome[])
{
    const int columns = NODE_COORDINATES * n.nodes;
    double unused[LANES_MEMORY];
    node_real at[ELEMENT_MAX_NODES];
    lanes_equations q;
    const int tangent = out->K != NULL;
    lanes_gather_nodes(n.nodes, run, x, at);
    lanes_gather_arrays(n.strains, run, e, q.e);
    lanes_gather_arrays(n.strains, run, s, q.s);
    if (n.inner > 0)
        lanes_gather_arrays(n.inner, run, inner, q.inner);
    strain(data, at,
           &(strain_real){.e = q.incompatibility,
                          .J = q.J,
                          .s = tangent ? q.s : NULL,
                          .H = tangent ? q.K : NULL});
    const real_truth good = stress(
        data, q.e, q.inner,
        &(stress_real){.sigma = q.sigma, .C = q.C, .memory = n.memory > 0 ? q.memory : NULL});
    for (int i = 0; i < n.strains; i++)
        q.incompatibility[i] -= q.e[i];
    lanes_equations_mix(n.strains, &q);
    lanes_equations_force(n.strains, columns, q.J, q.sigma, q.force);
    lanes_equations_force(n.strains, columns, q.J, q.s, q.present);
    if (tangent)
        lanes_equations_stiffness(n, &q);
    int written[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        written[lane] = lane < run && real_holds(good, lane);
        if (lane < run)
            outcome[lane] = written[lane] ? STATUS_OK : failure;
    }
    const struct {
        const real *from;
        size_t to;
        int count;
    } result[] = {{q.J, offsetof(equations_output, J), n.strains * columns},
                  {q.C, offsetof(equations_output, C), n.strains * n.strains},
                  {q.incompatibility, offsetof(equations_output, incompatibility), n.strains},
                  {q.sigma, offsetof(equations_output, sigma), n.strains},
                  {q.force, offsetof(equations_output, force), columns},
                  {q.present, offsetof(equations_output, present), columns},
                  {q.memory, offsetof(equations_output, memory), n.memory},
                  {q.K, offsetof(equations_output, K), tangent ? columns * columns : 0}};
    for (size_t k = 0; k < sizeof result / sizeof result[0]; k++) {
        if (result[k].count == 0)
            continue;
        LANES_TARGETS(to, written[lane], *(double **)(void *)((char *)&out[lane] + result[k].to),
                      unused)
        lanes_scatter(result[k].count, result[k].from, to);
    }
}

/* As element_type.equations_many. */
static inline __attribute__((always_inline)) void
lanes_equations_many(lanes_sizes n, lanes_strain *strain, lanes_stress *stress, status failure,
                     int count, const element_data *const data[], const node_state x[],
                     const double *const e[], const double *const inner[], const double *const s[],
                     equations_output out[], status outcome[])
{
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        lanes_equations_run(n, strain, stress, failure, run, data[i], x + i * n.nodes, e + i,
                            inner + i, s + i, out + i, outcome + i);
    }
}

#endif
