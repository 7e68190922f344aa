/* Stresses of collocation elements under loads along them (along.h).  In lanes (real.h). */
#ifndef BEAMWORK_EXACT_LOADED_H
#define BEAMWORK_EXACT_LOADED_H

#include "elements/collocation/along.h"
#include "elements/collocation/collocated.h"

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
    for (int i = 0; i < stages && out->followed != NULL; i++) { /* F, the last block, comes first */
        double *rows = &out->followed[(i < stages - 1 ? i + 1 : 0) * 9];
        for (int j = 0; j < 9; j++)
            rows[j] = -real_lane(&w->X[3][i][j], lane);
    }
    exact_along_finish(s, a, at, moved, out);
}

/* Evaluates with `stages` points. */
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

/* Evaluates `run` elements of one kind, at most LANES; as element_type.along. */
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
