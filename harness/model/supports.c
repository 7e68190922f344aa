#include "harness/model/model_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

enum { N = 6, ALL = 0x3f };

/* Rotation axes have a rounding error of a few eps. Columns of unit length whose remaining part is
 * smaller than this are treated as dependent. */
static const double round_off = 1e-12;

/* Removes the component along the `count` orthonormal vectors from the column. */
static void deflate(int n, int count, double (*basis)[N], double column[])
{
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < count; k++) {
            const double part = dense_dot(n, basis[k], column);
            for (int i = 0; i < n; i++)
                column[i] -= part * basis[k][i];
        }
}

/* Finds orthonormal vectors that span `count` columns of unit length, by Gram-Schmidt
 * orthogonalisation with pivoting. Returns the rank. */
static int orthonormal(int n, int count, double (*column)[N], double (*basis)[N])
{
    int rank = 0;
    for (; rank < n; rank++) {
        int longest = -1;
        double size = round_off;
        for (int k = 0; k < count; k++) {
            const double length = sqrt(dense_dot(n, column[k], column[k]));
            if (length > size) {
                size = length;
                longest = k;
            }
        }
        if (longest < 0)
            break;
        for (int i = 0; i < n; i++)
            basis[rank][i] = column[longest][i] / size;
        for (int k = 0; k < count; k++)
            deflate(n, rank + 1, basis, column[k]);
    }
    return rank;
}

/* Scales the columns of T to unit length, with displacements in units of `length`. Omits columns
 * that are rounding errors. Returns the number of the remaining columns. */
static int unit_columns(int columns, const double *T, double length, double (*column)[N])
{
    int count = 0;
    for (int k = 0; k < columns; k++) {
        double *c = column[count], size = 0;
        for (int i = 0; i < N; i++) {
            const double part = T[i * columns + k];
            size = fmax(size, fabs(part) / (i < 3 ? fmax(1, length) : 1));
            c[i] = i < 3 ? part / length : part;
        }
        const double norm = sqrt(dense_dot(N, c, c));
        for (int i = 0; i < N; i++)
            c[i] /= norm > 0 ? norm : 1;
        count += size > round_off;
    }
    return count;
}

static unsigned components_of(int rank, double (*basis)[N])
{
    unsigned components = 0;
    for (int i = 0; i < N; i++) {
        double square = 0;
        for (int k = 0; k < rank; k++)
            square += basis[k][i] * basis[k][i];
        components |= (unsigned)(sqrt(square) > round_off) << i;
    }
    return components;
}

/* Returns the components that move if every column is a single component or zero, as for a node
 * that is not moved by another body; ALL + 1: there is another kind of column. */
static unsigned components_alone(int columns, const double *T)
{
    unsigned components = 0;
    for (int k = 0; k < columns; k++) {
        int entries = 0;
        for (int i = 0; i < N; i++) {
            const double part = T[i * columns + k];
            if (part == 0)
                continue;
            if (part != 1 || entries++ > 0)
                return ALL + 1;
            components |= 1u << i;
        }
    }
    return components;
}

static int count_bits(unsigned bits)
{
    int count = 0;
    for (; bits != 0; bits &= bits - 1)
        count++;
    return count;
}

static void set_whole(unsigned components, movable *out)
{
    memset(out, 0, sizeof *out);
    out->components = components;
    out->count = count_bits(components);
    out->whole = 1;
    for (int i = 0, k = 0; i < N; i++)
        if (components >> i & 1u) {
            out->span[i * out->count + k] = out->dual[k * N + i] = 1;
            out->component[k++] = i;
        }
}

void movable_of(int columns, const double *T, double length, movable *out)
{
    double column[N][N] = {{0}}, basis[N][N] = {{0}};
    const unsigned alone = components_alone(columns, T);
    if (alone <= ALL) {
        set_whole(alone, out);
        return;
    }
    memset(out, 0, sizeof *out);
    out->count = orthonormal(N, unit_columns(columns, T, length, column), column, basis);
    out->components = components_of(out->count, basis);
    if (out->count == count_bits(out->components)) {
        set_whole(out->components, out);
        return;
    }
    for (int k = 0; k < out->count; k++)
        for (int i = 0; i < N; i++) {
            const double unit = i < 3 ? length : 1,
                         part = out->components >> i & 1u ? basis[k][i] : 0;
            out->span[i * out->count + k] = part * unit;
            out->dual[k * N + i] = part / unit;
        }
}

void movable_prescribed(int columns, const double *T, const double m[3], double out[3])
{
    double column[N][N] = {{0}}, basis[N][N] = {{0}};
    int count = 0;
    for (int k = 0; k < columns; k++) {
        double *c = column[count];
        for (int i = 0; i < 3; i++)
            c[i] = T[(3 + i) * columns + k];
        const double norm = sqrt(dense_dot(3, c, c));
        for (int i = 0; i < 3; i++)
            c[i] /= norm > 0 ? norm : 1;
        count += norm > round_off;
    }
    const int rank = orthonormal(3, count, column, basis);
    memcpy(out, m, 3 * sizeof *out);
    if (rank == 3)
        memset(out, 0, 3 * sizeof *out);
    else
        deflate(3, rank, basis, out);
}

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

/* Adds P^T P to `sum`, where P is the matrix of the motions that the supports of a node prevent. */
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
        double K[SUPPORTS_N * SUPPORTS_N];
        const int node = d->el.vertex[0];
        double at[3], G[SUPPORTS_N * SUPPORTS_N], prevented[SUPPORTS_N * SUPPORTS_N];
        if (d->el.nodes == 2 || supports_root(part, m->mesh.vertex[node].body) != root)
            continue;
        spring_at_rest(d->spring, K);
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
    if (part == NULL || m->mesh.tie != NULL) {
        free(part);
        return 0;
    }
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
