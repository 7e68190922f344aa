#include "harness/model/movable.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { N = 6, ALL = 0x3f };

/* Axes of turns have an error of a few eps: smaller parts of unit columns are taken for
 * round-off. */
static const double round_off = 1e-12;

/* column <- column without its part along the `count` orthonormal vectors, twice for
 * orthogonality. */
static void deflate(int n, int count, double (*basis)[N], double column[])
{
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < count; k++) {
            const double part = dense_dot(n, basis[k], column);
            for (int i = 0; i < n; i++)
                column[i] -= part * basis[k][i];
        }
}

/* Pivoted Gram-Schmidt: orthonormal vectors that span `count` columns of unit length. Returns the
 * rank. */
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

/* Columns of T with unit length, displacements in units of `length`; those that cancel to nothing
 * are left out. */
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

/* What moves where every column is a component of its own, or nothing, as those of a node are that
 * is its own body; ALL + 1: another column is among them. */
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

/* The motions are those of whole components. */
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
