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
#include "harness/model/release.h"

enum { SUPPORTS_N = 6 };

const double supports_loose = 1e-14;

int supports_root(const int part[], int vertex)
{
    while (part[vertex] != vertex)
        vertex = part[vertex];
    return vertex;
}

int supports_mover(const model *m, int vertex, int apart)
{
    return apart && release_of(m, vertex) != NULL ? vertex : m->mesh.vertex[vertex].body;
}

static void join_element(const model *m, const mesh_element *el, int apart, int part[])
{
    for (int k = 1; k < el->nodes; k++) {
        const int a = supports_root(part, supports_mover(m, el->vertex[0], apart)),
                  b = supports_root(part, supports_mover(m, el->vertex[k], apart));
        part[a > b ? a : b] = a > b ? b : a;
    }
}

void supports_join(const model *m, int apart, int part[])
{
    for (int i = 0; i < m->mesh.vertices; i++)
        part[i] = i;
    for (int i = 0; i < m->mesh.elements; i++)
        join_element(m, &m->mesh.element[i], apart, part);
    for (int i = 0; i < m->mesh.discretes; i++)
        join_element(m, &m->mesh.discrete[i].el, apart, part);
}

void supports_rigid(const double position[3], double length, double G[SUPPORTS_N * SUPPORTS_N])
{
    memset(G, 0, SUPPORTS_N * SUPPORTS_N * sizeof *G);
    for (int j = 0; j < 3; j++) {
        double unit[3] = {0}, moved[3];
        unit[j] = 1 / length;
        vec3_cross(unit, position, moved);
        G[SUPPORTS_N * j + j] = 1;
        G[SUPPORTS_N * (3 + j) + 3 + j] = unit[j];
        for (int i = 0; i < 3; i++)
            G[SUPPORTS_N * i + 3 + j] = moved[i];
    }
}

/* What the supports leave to a node by itself. */
static void free_motions(const model *m, int node, movable *out)
{
    int index[SUPPORTS_N], columns = 0;
    double T[SUPPORTS_N * SUPPORTS_N], of_free[SUPPORTS_N * SUPPORTS_N];
    const int all = kinematics_node_jacobian(m, m->rest, node, SUPPORTS_N, index, T);
    for (int k = 0; k < all; k++)
        columns += index[k] < m->mesh.free;
    for (int k = 0, to = 0; k < all; k++)
        if (index[k] < m->mesh.free) {
            for (int i = 0; i < SUPPORTS_N; i++)
                of_free[i * columns + to] = T[i * all + k];
            to++;
        }
    movable_of(columns, of_free, m->size, out);
}

void supports_prevented(const model *m, int node, const double origin[3],
                        double out[SUPPORTS_N * SUPPORTS_N])
{
    double at[3], G[SUPPORTS_N * SUPPORTS_N], along[SUPPORTS_N * SUPPORTS_N];
    movable v;
    free_motions(m, node, &v);
    for (int i = 0; i < 3; i++)
        at[i] = m->mesh.vertex[node].position[i] - origin[i];
    supports_rigid(at, m->size, G);
    dense_mul(v.count, SUPPORTS_N, SUPPORTS_N, v.dual, G, along);
    dense_mul(SUPPORTS_N, v.count, SUPPORTS_N, v.span, along, out);
    for (int i = 0; i < SUPPORTS_N * SUPPORTS_N; i++)
        out[i] = (G[i] - out[i]) * (i / SUPPORTS_N < 3 ? 1 : m->size);
}

/* sum += their squares. */
static void add_supports(const model *m, int node, const double origin[3],
                         double sum[SUPPORTS_N * SUPPORTS_N])
{
    double prevented[SUPPORTS_N * SUPPORTS_N];
    supports_prevented(m, node, origin, prevented);
    dense_add_transpose_mul(SUPPORTS_N, SUPPORTS_N, SUPPORTS_N, prevented, prevented, sum);
}

void supports_add_springs(const model *m, const int part[], int root, const double origin[3],
                          double sum[SUPPORTS_N * SUPPORTS_N])
{
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        const double *K = d->spring->stiffness;
        const int node = d->el.vertex[0];
        double at[3], G[SUPPORTS_N * SUPPORTS_N], prevented[SUPPORTS_N * SUPPORTS_N];
        if (d->el.nodes == 2 || supports_root(part, m->mesh.vertex[node].body) != root)
            continue;
        for (int k = 0; k < 3; k++)
            at[k] = m->mesh.vertex[node].position[k] - origin[k];
        supports_rigid(at, m->size, G);
        double unit[SUPPORTS_N * SUPPORTS_N] = {0}, work[SUPPORTS_N * SUPPORTS_N];
        for (int k = 0; k < SUPPORTS_N; k++)
            for (int j = 0; j < SUPPORTS_N; j++)
                if (K[(SUPPORTS_N + 1) * k] > 0 && K[(SUPPORTS_N + 1) * j] > 0)
                    unit[SUPPORTS_N * k + j] =
                        K[SUPPORTS_N * k + j] /
                        sqrt(K[(SUPPORTS_N + 1) * k] * K[(SUPPORTS_N + 1) * j]) *
                        (k < 3 ? 1 : m->size) * (j < 3 ? 1 : m->size);
        memset(prevented, 0, sizeof prevented);
        dense_add_congruence(SUPPORTS_N, SUPPORTS_N, G, unit, prevented, work);
        for (int k = 0; k < SUPPORTS_N * SUPPORTS_N; k++)
            sum[k] += prevented[k];
    }
}

static int has_elements(const model *m, const int part[], int root)
{
    for (int i = 0; i < m->mesh.elements; i++)
        if (supports_root(part, m->mesh.vertex[m->mesh.element[i].vertex[0]].body) == root)
            return 1;
    return 0;
}

int supports_loose_part(const model *m, int *node, double motion[6])
{
    int *part = malloc((size_t)m->mesh.vertices * sizeof *part), found = 0;
    if (part == NULL)
        return 0;
    supports_join(m, 0, part);
    for (int i = 0; i < m->scene->nodes && !found; i++) {
        if (supports_root(part, i) != i || m->mesh.vertex[i].body != i)
            continue;
        double sum[SUPPORTS_N * SUPPORTS_N] = {0}, size[SUPPORTS_N];
        for (int k = 0; k < m->scene->nodes; k++)
            if (m->mesh.vertex[k].body == k && supports_root(part, k) == i)
                add_supports(m, k, m->mesh.vertex[i].position, sum);
        supports_add_springs(m, part, i, m->mesh.vertex[i].position, sum);
        found = has_elements(m, part, i) &&
                LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', SUPPORTS_N, sum, SUPPORTS_N, size) == 0 &&
                !(size[0] > supports_loose * size[SUPPORTS_N - 1]);
        if (found)
            for (int k = 0; k < SUPPORTS_N; k++)
                motion[k] = sum[SUPPORTS_N * k] / (k < 3 ? 1 : m->size);
        *node = i;
    }
    free(part);
    return found;
}
