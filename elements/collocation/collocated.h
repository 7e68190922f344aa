/* The variables of a collocation element in the order of collocation.h: the unknowns F and x of the
 * inner nodes, then the strains v, 2 X, a_p, a_q. */
#ifndef BEAMWORK_COLLOCATION_COLLOCATED_H
#define BEAMWORK_COLLOCATION_COLLOCATED_H

#include <math.h>

#include "elements/collocation/collocation.h"
#include "elements/collocation/sums.h"

enum { EXACT_VARIABLES_BLOCKS = EXACT_BLOCKS_MAX * (EXACT_BLOCKS_MAX + 1) / 2 };

/* Returns the index of the block of sums.h that contains variable i, with the position in the block
 * in `component`. The constant 1 follows the last variable, and three parameters of a load follow
 * the constant. */
static inline int exact_variables_block(int stages, int i, int *component)
{
    const int outer = i - 3 * stages;
    *component = i % 3;
    if (outer < 0)
        return i < 3 ? stages - 1 : i / 3 - 1;
    *component = outer % 3;
    if (outer < 6)
        return outer < 3 ? stages + 1 : stages;
    return stages + outer / 3;
}

/* Computes the symmetric matrix [n x n] of the first n variables from the blocks A. */
void exact_variables_matrix(int stages, double A[][9], int n, double matrix[]);

/* Eliminates the unknowns with row exchange, for matrices for which the elimination of sums.h would
 * lose digits. S contains the blocks of the strains, of the constant 1 and of the columns after the
 * constant (`columns` columns in total). X [unknowns/3][9] contains the solution for each of these
 * block columns. Returns 0, or the number of the pivot that fails. */
int exact_variables_eliminate(int stages, int columns, double A[][9], double S[][9],
                              double X[][EXACT_STAGES_MAX][9]);

/* Computes the change of x and x' at point i due to a change of all variables. */
void exact_variables_change(const exact_stages *s, int i, const double change[], double x[3],
                            double slope[3]);

/* Blocks before elimination (A) and after it (V, with the pivots d), and the solution columns X for
 * the blocks 2 X, v and (a_p, a_q, 1) and for the rotation of loads along the element. */
typedef struct exact_collocated {
    real A[EXACT_VARIABLES_BLOCKS][9], V[EXACT_VARIABLES_BLOCKS][9], d[EXACT_STAGES_UNKNOWNS],
        X[4][EXACT_STAGES_MAX][9];
} exact_collocated;

/* Loads along the element (collocation.h): the contribution to F at the points, the derivative of
 * this contribution with respect to three parameters, and, as output, the derivative of the energy
 * with respect to the contribution. */
typedef struct exact_collocated_load {
    real force[EXACT_STAGES_MAX][3], column[EXACT_STAGES_MAX][9], moved[EXACT_STAGES_MAX][3];
} exact_collocated_load;

/* Evaluates the equations. e [8] and inner [unknowns] are dimensionless. `load` is NULL if there is
 * no load. */
static inline __attribute__((always_inline)) void
exact_collocated_evaluate(int stages, const exact_stages *s, const real e[], const real inner[],
                          exact_collocated_load *load, real A[][9])
{
    const int F = stages - 1, v = stages + 1, last = stages + 2;
    real at[EXACT_STAGES_MAX][3], Sz[EXACT_WARPING_MAX], gap[3];
    exact_stage p[EXACT_STAGES_MAX];
    exact_stage_terms t[EXACT_STAGES_MAX];
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k < stages - 1; k++)
            at[k][j] = inner[3 * (k + 1) + j];
        at[stages - 1][j] = s->line.rest[0][3 + j] + e[3 + j];
        gap[j] = s->rest_v[j] + e[j];
    }
    real twice = 2 * vec3_dot(inner, gap); /* the energy */
    exact_sums_geometry(stages, s, at, inner, p);
    for (int i = 0; i < stages && load != NULL; i++) {
        for (int j = 0; j < 3; j++)
            load->force[i][j] += inner[j];
        exact_milenkovic_vector(&p[i].orientation, p[i].x, load->force[i], p[i].N);
    }
    if (s->warps)
        twice += exact_sums_warping(stages, s, p, &e[6], Sz);
    for (int i = 0; i < stages; i++) {
        exact_stage_material m;
        exact_stage_energy(&s->c, p[i].kappa, p[i].N, s->warps ? Sz[i] / s->w[i] : real_of(0), &m);
        twice += (2 * s->w[i]) * m.energy;
        exact_stage_terms_of(&s->c, &p[i], load != NULL ? load->force[i] : inner, &m, s->w[i],
                             &t[i]);
        for (int j = 0; j < 3 && load != NULL; j++)
            load->moved[i][j] = t[i].gradient[EXACT_STAGE_FORCE + j];
    }
    if (load != NULL)
        exact_sums_load(stages, s, t, load->column, A);
    exact_sums_gather(stages, s, t, A);
    for (int j = 0; j < 3; j++) {
        A[exact_blocks_at(F, last)][3 * j + 2] += gap[j];
        A[exact_blocks_at(v, last)][3 * j + 2] = inner[j];
    }
    real *E = A[exact_blocks_at(last, last)];
    for (int i = 0; i < 2; i++) {
        if (s->warps)
            E[3 * i + 2] = Sz[stages + i];
        else if (s->c.warping) {
            E[3 * i + 2] = s->c.GJ * e[6 + i];
            twice += E[3 * i + 2] * e[6 + i];
        }
    }
    E[8] = twice;
}

/* Eliminates the unknowns with row exchange for one lane. `columns` is the number of columns for
 * the strains, the constant 1 and the parameters after the constant. Returns 0, or the number of
 * the pivot that fails. */
static inline int exact_collocated_exchange(int stages, int columns, int lane, exact_collocated *w)
{
    const int outer = (columns + 2) / 3, blocks = exact_blocks_at(0, stages + outer);
    double A[EXACT_VARIABLES_BLOCKS][9], S[EXACT_VARIABLES_BLOCKS][9], X[4][EXACT_STAGES_MAX][9];
    for (int i = 0; i < blocks; i++)
        for (int j = 0; j < 9; j++)
            A[i][j] = real_lane(&w->A[i][j], lane);
    const int failed = exact_variables_eliminate(stages, columns, A, S, X);
    if (failed != 0)
        return failed;
    for (int J = 0; J < outer; J++) {
        for (int I = 0; I <= J; I++)
            for (int j = 0; j < 9; j++) {
                const int at = exact_blocks_at(stages + I, stages + J);
                real_put(&w->V[at][j], lane, S[at][j]);
            }
        for (int i = 0; i < stages; i++)
            for (int j = 0; j < 9; j++)
                real_put(&w->X[J][i][j], lane, X[J][i][j]);
    }
    return 0;
}

/* Returns the entry for the strains i and j after elimination. Index 8 stands for the constant 1,
 * and indices 9 to 11 for the rotation of loads along the element. */
static inline double exact_collocated_entry(int stages, exact_collocated *w, int i, int j, int lane)
{
    int row, column;
    const int I = exact_variables_block(stages, 3 * stages + i, &row),
              J = exact_variables_block(stages, 3 * stages + j, &column);
    if (I < J || (I == J && row <= column))
        return real_lane(&w->V[exact_blocks_at(I, J)][3 * row + column], lane);
    return real_lane(&w->V[exact_blocks_at(J, I)][3 * column + row], lane);
}

static inline void exact_collocated_write(int stages, const exact_stages *s, exact_collocated *w,
                                          int lane, stress_output *out)
{
    enum { OUTER = EXACT_STAGES_OUTER };
    const double unit = s->c.energy, l0 = s->line.l0;
    if (out->sigma != NULL)
        for (int i = 0; i < OUTER; i++)
            out->sigma[i] = unit / l0 * exact_collocated_entry(stages, w, i, OUTER, lane);
    if (out->C != NULL)
        for (int i = 0; i < OUTER; i++)
            for (int j = i; j < OUTER; j++)
                out->C[i * OUTER + j] = out->C[j * OUTER + i] =
                    unit / (l0 * l0) * exact_collocated_entry(stages, w, i, j, lane);
    if (out->energy != NULL)
        *out->energy = unit * exact_collocated_entry(stages, w, OUTER, OUTER, lane) / 2;
    if (out->residual != NULL) {
        *out->residual = 0;
        for (int i = 0; i < stages; i++)
            for (int r = 0; r < 3; r++)
                *out->residual =
                    fmax(*out->residual,
                         fabs(real_lane(&w->A[exact_blocks_at(i, stages + 2)][3 * r + 2], lane)));
    }
    if (out->memory != NULL)
        for (int i = 0; i < stages; i++) {
            double *rows = &out->memory[(i < stages - 1 ? i + 1 : 0) * 3 * (OUTER + 1)];
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) {
                    double *row = &rows[r * (OUTER + 1) + c];
                    row[0] = real_lane(&w->X[1][i][3 * r + c], lane);
                    row[3] = real_lane(&w->X[0][i][3 * r + c], lane);
                    row[6] = real_lane(&w->X[2][i][3 * r + c], lane);
                }
        }
}

static inline __attribute__((always_inline)) void
exact_collocated_run(int stages, const exact_stages *s, int run, const double *const e[],
                     const double *const inner[], stress_output out[], status outcome[])
{
    real scaled[EXACT_STAGES_OUTER], unknown[EXACT_STAGES_UNKNOWNS];
    exact_collocated w;
    for (int lane = 0; lane < LANES; lane++) {
        const int of = lane < run ? lane : run - 1;
        for (int i = 0; i < EXACT_STAGES_OUTER; i++)
            real_put(&scaled[i], lane, e[of][i] / s->line.l0);
        for (int i = 0; i < 3 * stages; i++)
            real_put(&unknown[i], lane, inner[of][i]);
    }
    exact_collocated_evaluate(stages, s, scaled, unknown, NULL, w.A);
    exact_blocks_eliminate(stages, stages + 3, stages + 1, w.A, w.V, w.d);
    if (out[0].memory != NULL)
        for (int J = 0; J < 3; J++)
            exact_blocks_solve(stages, stages + 1, stages + J, w.V, w.X[J]);
    for (int lane = 0; lane < run; lane++) {
        if (!exact_blocks_definite(stages, w.A, w.d, lane) &&
            exact_collocated_exchange(stages, EXACT_STAGES_OUTER + 1, lane, &w) != 0) {
            outcome[lane] = STATUS_SINGULAR;
            continue;
        }
        exact_collocated_write(stages, s, &w, lane, &out[lane]);
        const double energy = real_lane(&w.A[exact_blocks_at(stages + 2, stages + 2)][8], lane);
        outcome[lane] = isfinite(energy) ? STATUS_OK : STATUS_NOT_CONVERGED;
    }
}

/* Computes the outputs of element_type.stress_many for `run` elements of one kind, at most
 * LANES. */
static inline void exact_collocated_stress(const exact_stages *s, int run, const double *const e[],
                                           const double *const inner[], stress_output out[],
                                           status outcome[])
{
    enum { USUAL = 5 };
    if (s->stages == USUAL)
        exact_collocated_run(USUAL, s, run, e, inner, out, outcome);
    else
        exact_collocated_run(s->stages, s, run, e, inner, out, outcome);
}

static inline void exact_loaded_write(int stages, const exact_stages *s, const exact_along *a,
                                      const exact_along_frame *at, exact_collocated *w,
                                      const exact_collocated_load *load, int lane,
                                      along_output *out)
{
    enum { OUTER = EXACT_STAGES_OUTER, TURN = OUTER + 1 };
    const double unit = s->c.energy, l0 = s->line.l0;
    double moved[EXACT_STAGES_MAX][3];
    exact_collocated_write(
        stages, s, w, lane,
        &(stress_output){.sigma = out->sigma, .C = out->C, .memory = out->memory});
    for (int k = 0; k < stages; k++)
        for (int i = 0; i < 3; i++)
            moved[k][i] = real_lane(&load->moved[k][i], lane);
    for (int j = 0; j < 3; j++) {
        out->moment[j] = unit * exact_collocated_entry(stages, w, OUTER, TURN + j, lane);
        for (int i = 0; i < OUTER; i++)
            out->mixed[3 * i + j] =
                unit / l0 * exact_collocated_entry(stages, w, i, TURN + j, lane);
        for (int i = 0; i < 3; i++)
            out->second[3 * i + j] =
                unit * exact_collocated_entry(stages, w, TURN + i, TURN + j, lane);
    }
    for (int i = 0; i < stages && out->followed != NULL; i++) {
        double *rows = &out->followed[(i < stages - 1 ? i + 1 : 0) * 9];
        for (int j = 0; j < 9; j++)
            rows[j] = -real_lane(&w->X[3][i][j], lane);
    }
    exact_along_finish(s, a, at, moved, out);
}

static inline __attribute__((always_inline)) void
exact_loaded_run(int stages, const exact_stages *s, const exact_along *a, int run,
                 const node_state x[], along_output out[], status outcome[])
{
    real scaled[EXACT_STAGES_OUTER], unknown[EXACT_STAGES_UNKNOWNS];
    exact_along_frame at[LANES];
    exact_collocated_load load;
    exact_collocated w;
    for (int lane = 0; lane < LANES; lane++) {
        const int of = lane < run ? lane : run - 1;
        for (int i = 0; i < EXACT_STAGES_OUTER; i++)
            real_put(&scaled[i], lane, out[of].e[i] / s->line.l0);
        for (int i = 0; i < 3 * stages; i++)
            real_put(&unknown[i], lane, out[of].inner[i]);
        if (lane < run)
            exact_along_frame_of(s, a, x + 2 * of, out[of].force, &at[of]);
        for (int k = 0; k < stages; k++) {
            double column[9];
            exact_along_column(at[of].xi[k], column);
            for (int i = 0; i < 3; i++)
                real_put(&load.force[k][i], lane, at[of].xi[k][i]);
            for (int i = 0; i < 9; i++)
                real_put(&load.column[k][i], lane, column[i]);
        }
    }
    exact_collocated_evaluate(stages, s, scaled, unknown, &load, w.A);
    exact_blocks_eliminate(stages, stages + 4, stages + 1, w.A, w.V, w.d);
    if (out[0].memory != NULL)
        for (int J = 0; J < 4; J++)
            exact_blocks_solve(stages, stages + 1, stages + J, w.V, w.X[J]);
    for (int lane = 0; lane < run; lane++) {
        if (!exact_blocks_definite(stages, w.A, w.d, lane) &&
            exact_collocated_exchange(stages, EXACT_STAGES_OUTER + 4, lane, &w) != 0) {
            outcome[lane] = STATUS_SINGULAR;
            continue;
        }
        exact_loaded_write(stages, s, a, &at[lane], &w, &load, lane, &out[lane]);
        const double energy = real_lane(&w.A[exact_blocks_at(stages + 2, stages + 2)][8], lane);
        outcome[lane] = isfinite(energy) ? STATUS_OK : STATUS_NOT_CONVERGED;
    }
}

/* Computes the outputs of element_type.along for `run` elements of one kind, at most LANES. */
static inline void exact_loaded_along(const exact_stages *s, const exact_along *a, int run,
                                      const node_state x[], along_output out[], status outcome[])
{
    enum { USUAL = 5 };
    if (s->stages == USUAL)
        exact_loaded_run(USUAL, s, a, run, x, out, outcome);
    else
        exact_loaded_run(s->stages, s, a, run, x, out, outcome);
}

#endif
