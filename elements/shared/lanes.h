/* Several elements of one kind at once, one in each lane (elements/math/real.h).
 *
 * A family writes its strains and stresses on node_real, strain_real and stress_real, in headers of
 * static functions. With LANES 1 these are the types of element.h: strain and stress of one element
 * include the headers so. A file lanes.c defines LANES as LANES_TOGETHER before it includes them,
 * and gives strain_many and stress_many by the functions below; the Makefile compiles it twice. */
#ifndef BEAMWORK_LANES_H
#define BEAMWORK_LANES_H

#include "elements/element.h"
#include "elements/math/real_dense.h"

enum { LANES_TOGETHER = 4 }; /* of element_type.lanes */

#if LANES == 1

typedef node_state node_real;
typedef strain_output strain_real;
typedef stress_output stress_real;

#else

/* As in element.h. */
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
} stress_real;

/* Most inner unknowns and memory of a type with lanes. */
enum { LANES_INNER = 24, LANES_MEMORY = 600 };

/* Sizes of a family. */
typedef struct lanes_sizes {
    int nodes, strains, inner, memory;
    int relative; /* 1: of two nodes, whose places enter by their difference only: J and H of the
                     one are minus those of the other, to the bit */
} lanes_sizes;

/* Those of one kind that follow each other, at most LANES. */
static inline int lanes_run(int count, const element_data *const data[])
{
    int run = 1;
    while (run < count && run < LANES && data[run] == data[0])
        run++;
    return run;
}

/* Arrays of one lane each into lanes, and back. */
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
/* Returns where the state can be evaluated. */
typedef real_truth lanes_stress(const element_data *, const real e[], const real inner[],
                                stress_real *);

/* Output pointers of the lanes of a run: the arrays `of` its outputs; lanes without an element
 * write to `unused`. */
#define LANES_TARGETS(to, run, of, unused)                                                         \
    double *to[LANES];                                                                             \
    for (int lane = 0; lane < LANES; lane++)                                                       \
        to[lane] = (run) ? (of) : (unused);

/* The last element of a run is also in the lanes that are left. */
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
        lanes_gather(sizeof(node_state) / sizeof(double), from, (real *)(void *)&at[k]);
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

/* A run of one kind. */
static inline __attribute__((always_inline)) void
lanes_strain_run(lanes_sizes n, lanes_strain *strain, int run, const element_data *data,
                 const node_state x[], strain_output out[])
{
    enum { S = ELEMENT_MAX_STRAINS, X = ELEMENT_MAX_COORDINATES };
    const int columns = NODE_COORDINATES * n.nodes;
    double unused[X * X];
    node_real at[ELEMENT_MAX_NODES];
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

/* The same of stresses, with e[run] and inner[run].  What cannot be evaluated writes nothing and
 * ends as `failure`. */
static inline __attribute__((always_inline)) void
lanes_stress_run(lanes_sizes n, lanes_stress *stress, status failure, int run,
                 const element_data *data, const double *const e[], const double *const inner[],
                 stress_output out[], status outcome[])
{
    enum { S = ELEMENT_MAX_STRAINS };
    double unused[LANES_MEMORY];
    real at[S], inside[LANES_INNER], energy, sigma[S], C[S * S], residual, memory[LANES_MEMORY];
    lanes_gather_arrays(n.strains, run, e, at);
    if (n.inner > 0)
        lanes_gather_arrays(n.inner, run, inner, inside);
    const real_truth good =
        stress(data, at, inside,
               &(stress_real){.energy = out->energy != NULL ? &energy : NULL,
                              .sigma = out->sigma != NULL ? sigma : NULL,
                              .C = out->C != NULL ? C : NULL,
                              .residual = out->residual != NULL ? &residual : NULL,
                              .memory = out->memory != NULL ? memory : NULL});
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

/* As element_type.strain_many. */
static inline __attribute__((always_inline)) void
lanes_strain_many(lanes_sizes n, lanes_strain *strain, int count, const element_data *const data[],
                  const node_state x[], strain_output out[])
{
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        lanes_strain_run(n, strain, run, data[i], x + i * n.nodes, out + i);
    }
}
/* As element_type.stress_many. */
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

#endif
#endif
