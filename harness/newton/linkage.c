#include "harness/newton/linkage.h"

#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"

enum { N = 6 };

/* Rigid parts that released ends join. */
typedef struct linkage {
    const model *m;
    int *part, *number; /* [vertices]: root; index of a root's part, NONE: it has no element */
    int count;
    double *S; /* [6 count x 6 count]: squares of what joints, supports and springs prevent */
} linkage;

static void count_part(linkage *l, int mover)
{
    const int root = supports_root(l->part, mover);
    if (l->number[root] == NONE)
        l->number[root] = l->count++;
}

/* S[a, b] += sign C^T C */
static void add_block(linkage *l, int a, int b, double sign, const double C[N * N])
{
    double block[N * N] = {0};
    dense_add_transpose_mul(N, N, N, C, C, block);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            l->S[(size_t)(N * a + i) * (size_t)(N * l->count) + (size_t)(N * b + j)] +=
                sign * block[N * i + j];
}

/* Rows of one kind of motion, less their parts along the unit vectors that are at right angles. */
static void leave_out(int count, const double along[3][3], double rows[3 * N])
{
    for (int k = 0; k < count; k++)
        for (int j = 0; j < N; j++) {
            const double part =
                along[k][0] * rows[j] + along[k][1] * rows[N + j] + along[k][2] * rows[2 * N + j];
            for (int i = 0; i < 3; i++)
                rows[N * i + j] -= part * along[k][i];
        }
}

static void add_joint(linkage *l, int vertex)
{
    const model *m = l->m;
    const mesh_release *r = release_of(m, vertex);
    const int a = l->number[supports_root(l->part, vertex)],
              b = l->number[supports_root(l->part, model_vertex(m, vertex)->body)];
    double at[3], C[N * N];
    for (int i = 0; i < 3; i++)
        at[i] = model_vertex(m, vertex)->position[i] - model_vertex(m, 0)->position[i];
    supports_rigid(at, model_length(m), C);
    for (int i = 3 * N; i < N * N; i++)
        C[i] *= model_length(m);
    leave_out(r->slides, r->slide, C);
    leave_out(r->turns, r->turn, C + 3 * N);
    add_block(l, a, a, 1, C);
    add_block(l, b, b, 1, C);
    add_block(l, a, b, -1, C);
    add_block(l, b, a, -1, C);
}

static void add_holds(linkage *l, int node)
{
    const double *origin = model_vertex(l->m, 0)->position;
    const int root = supports_root(l->part, node), part = l->number[root];
    double C[N * N], sum[N * N] = {0};
    if (part == NONE)
        return;
    supports_prevented(l->m, node, origin, C);
    add_block(l, part, part, 1, C);
    if (root == node)
        supports_add_springs(l->m, l->part, root, origin, sum);
    for (int i = 0; i < N * N; i++)
        l->S[(size_t)(N * part + i / N) * (size_t)(N * l->count) + (size_t)(N * part + i % N)] +=
            sum[i];
}

/* Motion of a point that moves with a part, in the eigenvector of the least value: [6: m, rad]; its
 * size [m]. */
static double motion_of(const linkage *l, int part, const double position[3], double motion[N])
{
    double at[3], G[N * N], of_part[N];
    for (int i = 0; i < 3; i++)
        at[i] = position[i] - model_vertex(l->m, 0)->position[i];
    for (int i = 0; i < N; i++)
        of_part[i] = l->S[(size_t)(N * part + i) * (size_t)(N * l->count)];
    supports_rigid(at, model_length(l->m), G);
    dense_mul_vec(N, N, G, of_part, motion);
    return vec3_norm(motion) + model_length(l->m) * vec3_norm(motion + 3);
}

/* The node that moves most, or the member where all nodes stay. */
static void name_what_moves(const linkage *l, int *node, int *member, double motion[N])
{
    const model *m = l->m;
    double largest = 0, moved[N];
    *node = *member = NONE;
    for (int i = 0; i < model_elements(m); i++) {
        const int vertex = model_element(m, i)->vertex[0];
        const int part = l->number[supports_root(l->part, supports_mover(m, vertex, 1))];
        const double size = motion_of(l, part, model_vertex(m, vertex)->position, moved);
        if (size > largest) {
            largest = size;
            *member = model_element(m, i)->member;
            memcpy(motion, moved, sizeof moved);
        }
    }
    double most = 1e-6 * largest;
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        const int part = l->number[supports_root(l->part, model_vertex(m, i)->body)];
        const double size =
            part != NONE ? motion_of(l, part, model_vertex(m, i)->position, moved) : 0;
        if (size > most) {
            most = size * (1 + 1e-9); /* of equals the first */
            *node = i;
            memcpy(motion, moved, sizeof moved);
        }
    }
}

/* S of all parts; 1: there is a motion that nothing prevents. */
static int is_loose(linkage *l)
{
    const int n = N * l->count;
    double *value = malloc(((size_t)n + 1) * sizeof *value);
    l->S = calloc((size_t)n * (size_t)n + 1, sizeof *l->S);
    if (value == NULL || l->S == NULL) {
        free(value);
        return 0;
    }
    for (int i = model_first_release(l->m); i < model_vertices(l->m); i++)
        add_joint(l, i);
    for (int i = 0; i < model_scene(l->m)->nodes; i++)
        if (model_vertex(l->m, i)->body == i)
            add_holds(l, i);
    const int found = LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', n, l->S, n, value) == 0 &&
                      !(value[0] > supports_loose * value[n - 1]);
    free(value);
    return found;
}

int linkage_mechanism(const model *m, int *node, int *member, double motion[6])
{
    enum { MOST_PARTS = 200 };
    linkage l = {.m = m, .part = malloc((size_t)model_vertices(m) * sizeof *l.part)};
    int found = 0;
    l.number = malloc((size_t)model_vertices(m) * sizeof *l.number);
    if (model_releases(m) > 0 && l.part != NULL && l.number != NULL) {
        supports_join(m, 1, l.part);
        for (int i = 0; i < model_vertices(m); i++)
            l.number[i] = NONE;
        for (int i = 0; i < model_elements(m); i++)
            count_part(&l, supports_mover(m, model_element(m, i)->vertex[0], 1));
        for (int i = model_first_release(m); i < model_vertices(m); i++)
            count_part(&l, model_vertex(m, i)->body);
        found = l.count <= MOST_PARTS && is_loose(&l);
        if (found)
            name_what_moves(&l, node, member, motion);
    }
    free(l.part);
    free(l.number);
    free(l.S);
    return found;
}
