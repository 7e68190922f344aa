#include "harness/scheme/massless.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/inertia/inertia.h"
#include "harness/model/model_impl.h"

enum { SIX = 6 };

/* Rank of the leading n x n part of A[6 x 6], positive semidefinite, in which `nothing` is zero;
 * destroys A. */
static int rank_of(int n, double A[SIX * SIX], double nothing)
{
    int rank = 0;
    for (int used[SIX] = {0}, k = 0; k < n; k++) {
        int most = -1;
        for (int i = 0; i < n; i++)
            if (!used[i] && (most < 0 || A[7 * i] > A[7 * most]))
                most = i;
        const double pivot = A[7 * most];
        if (pivot <= nothing)
            return rank;
        used[most] = 1;
        rank++;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n && !used[i]; j++)
                if (!used[j])
                    A[SIX * i + j] -= A[SIX * i + most] * A[SIX * most + j] / pivot;
    }
    return rank;
}

/* Of one frame, in lengths of the model instead of turns. */
static int frame_rank(const model *m, const carried *all, int index, const model_state *s,
                      const double zero[])
{
    const double nothing = 1e-14, unit = 1 / m->size;
    const int *at = m->vertex[all->mass[index].frame].coordinate;
    inertia_parts p;
    double K[SIX * SIX], M[SIX * SIX], largest = 0;
    int of[SIX], n = 0;
    inertia_frame(m, all, index, s, zero, NULL, &p);
    inertia_times(p.acceleration, 1, p.rate, K);
    inertia_rows(p.turn, K);
    for (int i = 0; i < SIX; i++)
        if (at[i] != NONE && at[i] < m->free)
            of[n++] = i;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            M[SIX * i + j] =
                K[SIX * of[i] + of[j]] * (of[i] < 3 ? 1 : unit) * (of[j] < 3 ? 1 : unit);
            largest = fmax(largest, i == j ? M[SIX * i + j] : 0);
        }
    return rank_of(n, M, nothing * fmax(largest, all->mass[index].mass));
}

int massless_count(const model *m, const carried *all, const model_state *s)
{
    double *zero = calloc((size_t)(m->free + m->driven) + 1, sizeof *zero);
    int heavy = 0;
    for (int k = 0; k < all->masses && zero != NULL; k++)
        heavy += frame_rank(m, all, k, s, zero);
    for (int i = 0; i < m->warps; i++)
        heavy += m->warp[i].coordinate < m->free && all->warping[m->warp[i].coordinate] > 0;
    free(zero);
    return m->free - heavy;
}
