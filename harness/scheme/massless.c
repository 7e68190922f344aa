#include "harness/scheme/massless.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/inertia/inertia.h"
#include "harness/inertia/released.h"
#include "harness/model/model_impl.h"

/* Coordinates of a body with those of the ends that are released from it. */
typedef struct group {
    int count;
    int *index; /* [count] */
    double *M;  /* [count x count] */
} group;

/* Rank of A[n x n], positive semidefinite, in which `nothing` is zero; destroys A. */
static int rank_of(int n, double A[], int used[], double nothing)
{
    int rank = 0;
    for (int k = 0; k < n; k++) {
        int most = -1;
        for (int i = 0; i < n; i++)
            if (!used[i] && (most < 0 || A[(n + 1) * i] > A[(n + 1) * most]))
                most = i;
        const double pivot = A[(n + 1) * most];
        if (pivot <= nothing)
            return rank;
        used[most] = 1;
        rank++;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n && !used[i]; j++)
                if (!used[j])
                    A[n * i + j] -= A[n * i + most] * A[n * most + j] / pivot;
    }
    return rank;
}

static int place_in(const group *g, int coordinate)
{
    for (int k = 0; k < g->count; k++)
        if (g->index[k] == coordinate)
            return k;
    return NONE;
}

static void take_vertex(const model *m, int vertex, group *g)
{
    for (int c = 0; c < 6; c++) {
        const int at = m->vertex[vertex].coordinate[c];
        if (at != NONE && at < m->free && place_in(g, at) == NONE)
            g->index[g->count++] = at;
    }
}

/* Lengths of the model instead of turns: the same measure for all. */
static double unit_of(const model *m, int body, int vertex, int c)
{
    for (int k = SCENE_RX; k <= SCENE_RZ; k++)
        if (m->vertex[body].coordinate[k] == c || m->vertex[vertex].coordinate[k] == c)
            return 1 / m->size;
    return 1;
}

static double add_mass(const model *m, const carried *all, int index, const model_state *s,
                       const double zero[], const group *g)
{
    const int vertex = all->mass[index].frame, body = m->vertex[vertex].body;
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    inertia_parts p;
    released of;
    double motion[6 * KINEMATICS_MOST], K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
    inertia_frame(m, all, index, s, zero, NULL, &p);
    released_columns(m, s, vertex, &of);
    released_motion(&of, 1, one, one, motion);
    released_project(&of, p.acceleration, motion, K);
    for (int i = 0; i < of.count; i++)
        for (int j = 0; j < of.count; j++) {
            const int row = place_in(g, of.index[i]), column = place_in(g, of.index[j]);
            if (row != NONE && column != NONE)
                g->M[g->count * row + column] += K[of.count * i + j] *
                                                 unit_of(m, body, vertex, of.index[i]) *
                                                 unit_of(m, body, vertex, of.index[j]);
        }
    return all->mass[index].mass;
}

/* Of one body and all ends that are released from it. */
static int body_rank(const model *m, const carried *all, int body, const model_state *s,
                     const double zero[], group *g, int used[])
{
    const double nothing = 1e-14;
    double largest = 0;
    g->count = 0;
    take_vertex(m, body, g);
    for (int i = m->first_release; i < m->vertices; i++)
        if (m->vertex[i].body == body)
            take_vertex(m, i, g);
    memset(g->M, 0, (size_t)(g->count * g->count) * sizeof *g->M);
    memset(used, 0, (size_t)g->count * sizeof *used);
    for (int k = 0; k < all->masses; k++)
        if (m->vertex[all->mass[k].frame].body == body)
            largest = fmax(largest, add_mass(m, all, k, s, zero, g));
    return rank_of(g->count, g->M, used, nothing * largest);
}

/* Most ends that are released from one body. */
static int most_ends(const model *m, int ends[])
{
    int most = 0;
    for (int i = m->first_release; i < m->vertices; i++)
        if (++ends[m->vertex[i].body] > most)
            most = ends[m->vertex[i].body];
    return most;
}

status massless_count(const model *m, const carried *all, const model_state *s, int *out, fault *f)
{
    int *room = calloc(2 * (size_t)m->vertices + 1, sizeof *room), heavy = 0;
    const size_t n = room == NULL ? 0 : 6 + SCENE_RELEASED * (size_t)most_ends(m, room);
    double *zero = calloc((size_t)(m->free + m->driven) + 1, sizeof *zero);
    group g = {0, calloc(2 * n, sizeof(int)), calloc(n * n, sizeof(double))};
    const int known = room != NULL && zero != NULL && g.index != NULL && g.M != NULL;
    for (int i = 0; i < m->first_release && known; i++)
        if (m->vertex[i].body == i)
            heavy += body_rank(m, all, i, s, zero, &g, g.index + n);
    for (int i = 0; i < m->warps; i++)
        heavy += m->warp[i].coordinate < m->free && all->warping[m->warp[i].coordinate] > 0;
    free(room);
    free(zero);
    free(g.index);
    free(g.M);
    *out = m->free - heavy;
    return known ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory for masses");
}
