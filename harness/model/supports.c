/* Which parts of the structure its supports leave loose: rigid motions of what is joined together,
 * found from the supports alone and so whatever the stiffness. */
#include "harness/model/supports.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"
#include "harness/model/movable.h"

enum { N = 6 };

/* Least eigenvalue of the supports' squares beside the largest: held points closer to each other
 * than its root times the length count as one. */
static const double loose = 1e-14;

static int root_of(const int part[], int vertex)
{
    while (part[vertex] != vertex)
        vertex = part[vertex];
    return vertex;
}

static void join_element(const model *m, const mesh_element *el, int part[])
{
    for (int k = 1; k < el->nodes; k++) {
        const int a = root_of(part, m->vertex[el->vertex[0]].body),
                  b = root_of(part, m->vertex[el->vertex[k]].body);
        part[a > b ? a : b] = a > b ? b : a;
    }
}

/* part[vertices]: the same root for all that elements, springs and bodies join. */
static void join(const model *m, int part[])
{
    for (int i = 0; i < m->vertices; i++)
        part[i] = i;
    for (int i = 0; i < m->elements; i++)
        join_element(m, &m->element[i], part);
    for (int i = 0; i < m->discretes; i++)
        join_element(m, &m->discrete[i].el, part);
}

/* G[6 x 6]: motion of a node for a rigid motion (displacement of the origin, turn times length). */
static void rigid(const double position[3], double length, double G[N * N])
{
    memset(G, 0, N * N * sizeof *G);
    for (int j = 0; j < 3; j++) {
        double unit[3] = {0}, moved[3];
        unit[j] = 1 / length;
        vec3_cross(unit, position, moved);
        G[N * j + j] = 1;
        G[N * (3 + j) + 3 + j] = unit[j];
        for (int i = 0; i < 3; i++)
            G[N * i + 3 + j] = moved[i];
    }
}

/* What the supports leave to a node by itself. */
static void free_motions(const model *m, int node, movable *out)
{
    int index[N], columns = 0;
    double T[N * N], of_free[N * N];
    const int all = kinematics_node_jacobian(m, m->rest, node, N, index, T);
    for (int k = 0; k < all; k++)
        columns += index[k] < m->free;
    for (int k = 0, to = 0; k < all; k++)
        if (index[k] < m->free) {
            for (int i = 0; i < N; i++)
                of_free[i * columns + to] = T[i * all + k];
            to++;
        }
    movable_of(columns, of_free, m->size, out);
}

/* sum += squares of what a node's supports prevent of rigid motions, turns in units of 1/length. */
static void add_supports(const model *m, int node, const double origin[3], double sum[N * N])
{
    double at[3], G[N * N], prevented[N * N], along[N * N];
    movable v;
    free_motions(m, node, &v);
    for (int i = 0; i < 3; i++)
        at[i] = m->vertex[node].position[i] - origin[i];
    rigid(at, m->size, G);
    dense_mul(v.count, N, N, v.dual, G, along);
    dense_mul(N, v.count, N, v.span, along, prevented);
    for (int i = 0; i < N * N; i++)
        prevented[i] = (G[i] - prevented[i]) * (i / N < 3 ? 1 : m->size);
    dense_add_transpose_mul(N, N, N, prevented, prevented, sum);
}

/* sum += what springs between the part and the ground prevent, whatever their stiffness. */
static void add_springs(const model *m, const int part[], int root, double sum[N * N])
{
    for (int i = m->discretes - m->springs; i < m->discretes; i++) {
        const mesh_discrete *d = &m->discrete[i];
        const double *K = d->spring->stiffness;
        const int node = d->el.vertex[0];
        double at[3], G[N * N], prevented[N * N];
        if (d->el.nodes == 2 || root_of(part, m->vertex[node].body) != root)
            continue;
        for (int k = 0; k < 3; k++)
            at[k] = m->vertex[node].position[k] - m->vertex[root].position[k];
        rigid(at, m->size, G);
        double unit[N * N] = {0}, work[N * N];
        for (int k = 0; k < N; k++)
            for (int j = 0; j < N; j++)
                if (K[(N + 1) * k] > 0 && K[(N + 1) * j] > 0)
                    unit[N * k + j] = K[N * k + j] / sqrt(K[(N + 1) * k] * K[(N + 1) * j]) *
                                      (k < 3 ? 1 : m->size) * (j < 3 ? 1 : m->size);
        memset(prevented, 0, sizeof prevented);
        dense_add_congruence(N, N, G, unit, prevented, work);
        for (int k = 0; k < N * N; k++)
            sum[k] += prevented[k];
    }
}

static int has_elements(const model *m, const int part[], int root)
{
    for (int i = 0; i < m->elements; i++)
        if (root_of(part, m->vertex[m->element[i].vertex[0]].body) == root)
            return 1;
    return 0;
}

int supports_loose_part(const model *m, int *node, double motion[6])
{
    int *part = malloc((size_t)m->vertices * sizeof *part), found = 0;
    if (part == NULL)
        return 0;
    join(m, part);
    for (int i = 0; i < m->scene->nodes && !found; i++) {
        if (root_of(part, i) != i || m->vertex[i].body != i)
            continue;
        double sum[N * N] = {0}, size[N];
        for (int k = 0; k < m->scene->nodes; k++)
            if (m->vertex[k].body == k && root_of(part, k) == i)
                add_supports(m, k, m->vertex[i].position, sum);
        add_springs(m, part, i, sum);
        found = has_elements(m, part, i) &&
                LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', N, sum, N, size) == 0 &&
                !(size[0] > loose * size[N - 1]);
        if (found)
            for (int k = 0; k < N; k++)
                motion[k] = sum[N * k] / (k < 3 ? 1 : m->size);
        *node = i;
    }
    free(part);
    return found;
}
