/* Several elements of one kind at once, one in each lane (elements/math/real.h).
 *
 * A family of elements implements its strains and stresses with node_real, strain_real and
 * stress_real, in headers of static functions. If LANES is 1, these types are those of element.h,
 * and the headers give the functions for a single element. */
#ifndef BEAMWORK_SHARED_LANES_H
#define BEAMWORK_SHARED_LANES_H

#include "elements/element.h"
#include "elements/math/real_dense.h"

enum { LANES_TOGETHER = 4 }; /* value of element_type.lanes */

#if LANES == 1

typedef node_state node_real;
typedef strain_output strain_real;
typedef stress_output stress_real;

#else

/* State of a node (node_state of element.h), in lanes. */
typedef struct node_real {
    real r[3], u[3], R[9], a;
} node_real;
typedef struct strain_real {
    real *e, *J;
    const real *s;
    real *H;
} strain_real;
typedef struct stress_real {
    real *energy, *sigma, *C, *residual, *memory;
    const real *state;
} stress_real;

/* Largest numbers of nodes, strains and inner unknowns, and size of memory, of a type with lanes.
 */
enum {
    LANES_NODES = 3,
    LANES_COORDINATES = NODE_COORDINATES * LANES_NODES,
    LANES_STRAINS = 24,
    LANES_INNER = 24,
    LANES_MEMORY = 600
};

/* Sizes of a family. */
typedef struct lanes_sizes {
    int nodes, strains, inner, memory;
    int relative; /* 1 if the element has two nodes and only the difference of their positions
                     matters; the entries of J and H for the position of one node are then minus
                     those for the other, bit for bit */
} lanes_sizes;

static inline int lanes_run(int count, const element_data *const data[])
{
    int run = 1;
    while (run < count && run < LANES && data[run] == data[0])
        run++;
    return run;
}

/* Copy arrays with one lane each to arrays with all lanes, and back. */
static inline void lanes_gather(int n, const double *const from[LANES], real to[])
{
    for (int i = 0; i < n; i++) {
        real all = real_of(from[0][i]);
        for (int lane = 1; lane < LANES; lane++)
            all[lane] = from[lane][i];
        to[i] = all;
    }
}
static inline void lanes_scatter(int n, const real from[], double *const to[LANES])
{
    for (int i = 0; i < n; i++)
        for (int lane = 0; lane < LANES; lane++)
            to[lane][i] = from[i][lane];
}

typedef void lanes_strain(const element_data *, const node_real x[], strain_real *);
/* Returns the lanes in which the state can be evaluated. */
typedef real_truth lanes_stress(const element_data *, const real e[], const real inner[],
                                stress_real *);

/* Sets the output pointers of the lanes of a run. */
#define LANES_TARGETS(to, run, of, unused)                                                         \
    double *to[LANES];                                                                             \
    for (int lane = 0; lane < LANES; lane++)                                                       \
        to[lane] = (run) ? (of) : (unused);

static inline int lanes_of(int lane, int run)
{
    return lane < run ? lane : run - 1;
}

static inline __attribute__((always_inline)) void
lanes_gather_nodes(int nodes, int run, const node_state x[], node_real at[])
{
    for (int k = 0; k < nodes; k++) {
        const double *from[LANES];
        for (int lane = 0; lane < LANES; lane++)
            from[lane] = (const void *)&x[lanes_of(lane, run) * nodes + k];
        lanes_gather(sizeof(node_real) / sizeof(real), from, (real *)(void *)&at[k]);
    }
}

static inline __attribute__((always_inline)) void
lanes_gather_arrays(int n, int run, const double *const in[], real to[])
{
    const double *from[LANES];
    for (int lane = 0; lane < LANES; lane++)
        from[lane] = in[lanes_of(lane, run)];
    lanes_gather(n, from, to);
}

static inline __attribute__((always_inline)) void
lanes_strain_run(lanes_sizes n, lanes_strain *strain, int run, const element_data *data,
                 const node_state x[], strain_output out[])
{
    enum { S = LANES_STRAINS, X = LANES_COORDINATES };
    const int columns = NODE_COORDINATES * n.nodes;
    double unused[X * X];
    node_real at[LANES_NODES];
    real e[S], J[S * X], s[S], H[X * X];
    lanes_gather_nodes(n.nodes, run, x, at);
    if (out->s != NULL) {
        const double *weights[LANES];
        for (int lane = 0; lane < run; lane++)
            weights[lane] = out[lane].s;
        lanes_gather_arrays(n.strains, run, weights, s);
    }
    strain(data, at,
           &(strain_real){.e = out->e != NULL ? e : NULL,
                          .J = out->J != NULL ? J : NULL,
                          .s = out->s != NULL ? s : NULL,
                          .H = out->s != NULL && out->H != NULL ? H : NULL});
    if (out->e != NULL) {
        LANES_TARGETS(to, lane < run, out[lane].e, unused)
        lanes_scatter(n.strains, e, to);
    }
    if (out->J != NULL) {
        LANES_TARGETS(to, lane < run, out[lane].J, unused)
        lanes_scatter(n.strains * columns, J, to);
    }
    if (out->s != NULL && out->H != NULL) {
        LANES_TARGETS(to, lane < run, out[lane].H, unused)
        lanes_scatter(columns * columns, H, to);
    }
}

/* Evaluates the stresses of a run, with e[run] and inner[run]. Elements that cannot be evaluated
 * write nothing, and their outcome is `failure`. */
static inline __attribute__((always_inline)) void
lanes_stress_run(lanes_sizes n, lanes_stress *stress, status failure, int run,
                 const element_data *data, const double *const e[], const double *const inner[],
                 stress_output out[], status outcome[])
{
    enum { S = LANES_STRAINS };
    double unused[LANES_MEMORY];
    const double *of_state[LANES];
    real at[S], state[S], inside[LANES_INNER], energy, sigma[S], C[S * S], residual,
        memory[LANES_MEMORY];
    lanes_gather_arrays(n.strains, run, e, at);
    for (int lane = 0; lane < run; lane++)
        of_state[lane] = out[lane].state;
    if (out->state != NULL)
        lanes_gather_arrays(n.strains, run, of_state, state);
    if (n.inner > 0)
        lanes_gather_arrays(n.inner, run, inner, inside);
    const real_truth good =
        stress(data, at, inside,
               &(stress_real){.energy = out->energy != NULL ? &energy : NULL,
                              .sigma = out->sigma != NULL ? sigma : NULL,
                              .C = out->C != NULL ? C : NULL,
                              .residual = out->residual != NULL ? &residual : NULL,
                              .memory = out->memory != NULL ? memory : NULL,
                              .state = out->state != NULL ? state : NULL});
    int written[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        written[lane] = lane < run && real_holds(good, lane);
        if (lane < run)
            outcome[lane] = written[lane] ? STATUS_OK : failure;
    }
    if (out->energy != NULL) {
        LANES_TARGETS(to, written[lane], out[lane].energy, unused)
        lanes_scatter(1, &energy, to);
    }
    if (out->sigma != NULL) {
        LANES_TARGETS(to, written[lane], out[lane].sigma, unused)
        lanes_scatter(n.strains, sigma, to);
    }
    if (out->C != NULL) {
        LANES_TARGETS(to, written[lane], out[lane].C, unused)
        lanes_scatter(n.strains * n.strains, C, to);
    }
    if (out->residual != NULL) {
        LANES_TARGETS(to, written[lane], out[lane].residual, unused)
        lanes_scatter(1, &residual, to);
    }
    if (out->memory != NULL && n.memory > 0) {
        LANES_TARGETS(to, written[lane], out[lane].memory, unused)
        lanes_scatter(n.memory, memory, to);
    }
}

/* Implements element_type.strain_many. */
static inline __attribute__((always_inline)) void
lanes_strain_many(lanes_sizes n, lanes_strain *strain, int count, const element_data *const data[],
                  const node_state x[], strain_output out[])
{
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        lanes_strain_run(n, strain, run, data[i], x + i * n.nodes, out + i);
    }
}
/* Implements element_type.stress_many. */
static inline __attribute__((always_inline)) void
lanes_stress_many(lanes_sizes n, lanes_stress *stress, status failure, int count,
                  const element_data *const data[], const double *const e[],
                  const double *const inner[], stress_output out[], status outcome[])
{
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        lanes_stress_run(n, stress, failure, run, data[i], e + i, inner + i, out + i, outcome + i);
    }
}

/* Mixed equations of several elements of one kind at once, computed from strains and stresses in
 * lanes. */

typedef struct lanes_equations {
    real J[LANES_STRAINS * LANES_COORDINATES], SJ[LANES_STRAINS * LANES_COORDINATES],
        C[LANES_STRAINS * LANES_STRAINS], K[LANES_COORDINATES * LANES_COORDINATES];
    real e[LANES_STRAINS], s[LANES_STRAINS], sigma[LANES_STRAINS], incompatibility[LANES_STRAINS];
    real force[LANES_COORDINATES], present[LANES_COORDINATES];
    real inner[LANES_INNER], memory[LANES_MEMORY];
} lanes_equations;

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

/* Computes out = J^T s. */
static inline __attribute__((always_inline)) void
lanes_equations_force(int strains, int columns, const real J[], const real s[], real out[])
{
    for (int j = 0; j < columns; j++)
        out[j] = real_of(0);
    for (int i = 0; i < strains; i++)
        for (int j = 0; j < columns; j++)
            out[j] += s[i] * J[i * columns + j];
}

/* Adds J^T C J to K. If only the difference of the positions of two nodes matters, the entries for
 * the first position are set to minus those for the second. The sign of their common block is
 * unchanged, so K is as symmetric as H. */
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
    node_real at[LANES_NODES];
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

/* Implements element_type.equations_many. */
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

#endif
