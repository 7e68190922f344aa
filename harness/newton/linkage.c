#include "harness/newton/newton_impl.h"

#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"

/* With fewer elements per thread, additional threads do not save time (measured for spherical_joint
 * and hexapod). */
enum { ELEMENTS_OF_A_THREAD = 32 };

status linear_memory_alloc(const model *m, linear_memory *out, fault *f)
{
    out->slot =
        malloc(((size_t)model_elements(m) * (size_t)model_work_size(m) + 1) * sizeof *out->slot);
    return out->slot != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%d elements require more memory than is available; use fewer elements",
                           model_elements(m));
}

void linear_memory_free(linear_memory *memory)
{
    free(memory->slot);
    memory->slot = NULL;
}

static status begin(run_state *run, const model *m, int threads, fault *f)
{
    const int most = model_sizes(m).elements / ELEMENTS_OF_A_THREAD;
    TRY(assemble_patterns_alloc(&run->patterns, f));
    TRY(linear_memory_alloc(m, &run->memory, f));
    TRY(free_strain_begin(m, &run->free_strain, f));
    return thread_pool_alloc(threads < most ? threads : most, &run->pool, f);
}

status run_state_begin(run_state *run, const model *m, int threads, fault *f)
{
    memset(run, 0, sizeof *run);
    const status outcome = begin(run, m, threads, f);
    if (outcome != STATUS_OK)
        run_state_end(run);
    return outcome;
}

void run_state_end(run_state *run)
{
    free(run->feedback);
    free(run->undeformed.of);
    free(run->undeformed.value);
    free(run->ahead);
    free(run->part);
    free_strain_end(run->free_strain);
    thread_pool_free(run->pool);
    assemble_patterns_free(run->patterns);
    linear_memory_free(&run->memory);
    memset(run, 0, sizeof *run);
}

element_rotating_frame loading_frame(const loading *l, double path)
{
    element_rotating_frame frame = l->frame;
    if (l->rotation_follows_path)
        for (int i = 0; i < 3; i++)
            frame.omega[i] *= path;
    return frame;
}

enum { N = 6 };

typedef struct linkage {
    const model *m;
    /* [vertices] root of each vertex; [vertices] index of the part of a root (NONE: the part has no
     * element) */
    int *part, *number;
    int count;
    /* [6 count x 6 count] matrix of a quadratic form in the motions of the parts: the sum of
     * squares of the motions that joints, constraints, supports and springs prevent */
    double *S;
} linkage;

static void count_part(linkage *l, int mover)
{
    const int root = supports_root(l->part, mover);
    if (l->number[root] == NONE)
        l->number[root] = l->count++;
}

static void add_block(linkage *l, int a, int b, double sign, const double C[N * N])
{
    double block[N * N] = {0};
    dense_add_transpose_mul(N, N, N, C, C, block);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            l->S[(size_t)(N * a + i) * (size_t)(N * l->count) + (size_t)(N * b + j)] +=
                sign * block[N * i + j];
}

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

/* Computes the motion of a coordinate of a node with its part: row[6], to be multiplied by the
 * motions of the part. Returns the part. */
static int coordinate_row(const linkage *l, int node, int coordinate, double row[N])
{
    const model *m = l->m;
    const mesh_vertex *v = model_vertex(m, node);
    double at[3], C[N * N], axis[3], b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int turns = coordinate >= SCENE_RX;
    if (turns && v->angles > 0)
        kinematics_axes(m, kinematics_rest(m), node, b);
    for (int i = 0; i < 3; i++) {
        at[i] = v->position[i] - model_vertex(m, 0)->position[i];
        axis[i] = turns ? b[coordinate - SCENE_RX][i]
                        : (v->turned ? v->along[3 * i + coordinate] : i == coordinate);
    }
    supports_rigid(at, model_length(m), C);
    const double scale = (turns ? model_length(m) : 1) / vec3_dot(axis, axis);
    for (int j = 0; j < N; j++) {
        row[j] = 0;
        for (int i = 0; i < 3; i++)
            row[j] += scale * axis[i] * C[N * (turns ? 3 + i : i) + j];
    }
    if (v->led && !turns) {
        double moved[3];
        vec3_cross(v->axis[0], v->arm, moved);
        for (int j = 0; j < N; j++)
            for (int i = 0; i < 3; i++)
                row[j] -= scale * vec3_dot(axis, moved) * v->axis[0][i] * C[N * (3 + i) + j];
    }
    return l->number[supports_root(l->part, node)];
}

static void add_tie(linkage *l, int node, int coordinate)
{
    const scene_tie *tie = model_tie(l->m, node, coordinate);
    const mesh_vertex *v = model_vertex(l->m, node);
    double row[2][N];
    if (tie == NULL || (tie->node == node && tie->coordinate == coordinate))
        return;
    const int part[2] = {
        coordinate_row(l, node, coordinate >= SCENE_RX && v->angles > 0 ? SCENE_RX : coordinate,
                       row[0]),
        coordinate_row(l, tie->node, tie->coordinate, row[1])};
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            for (int i = 0; i < N * N && part[a] != NONE && part[b] != NONE; i++)
                l->S[(size_t)(N * part[a] + i / N) * (size_t)(N * l->count) +
                     (size_t)(N * part[b] + i % N)] +=
                    (a == b ? 1 : -1) * row[a][i / N] * row[b][i % N];
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

/* Computes the motion of a point of a part in the eigenvector of the smallest eigenvalue: [6], in m
 * and rad. Returns |translation| + |rotation| times the length of the model [m]. */
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
            most = size * (1 + 1e-9);
            *node = i;
            memcpy(motion, moved, sizeof moved);
        }
    }
}

/* Assembles S for all parts. Returns 1 if a motion is not prevented. */
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
    for (int i = 0; i < SCENE_RZ + 1; i++)
        for (int node = 0; node < model_scene(l->m)->nodes; node++)
            add_tie(l, node, i);
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
    if ((model_releases(m) > 0 || model_mesh_of(m)->tie != NULL) && l.part != NULL &&
        l.number != NULL) {
        supports_join(m, 1, l.part);
        for (int i = 0; i < model_vertices(m); i++)
            l.number[i] = NONE;
        for (int i = 0; i < model_elements(m); i++)
            count_part(&l, supports_mover(m, model_element(m, i)->vertex[0], 1));
        for (int i = model_first_release(m); i < model_vertices(m); i++)
            count_part(&l, model_vertex(m, i)->body);
        for (int i = 0; i < 6 * model_scene(m)->nodes; i++)
            if (model_tie(m, i / 6, i % 6) != NULL)
                count_part(&l, i / 6);
        found = l.count <= MOST_PARTS && is_loose(&l);
        if (found)
            name_what_moves(&l, node, member, motion);
    }
    free(l.part);
    free(l.number);
    free(l.S);
    return found;
}
