#include "harness/newton/newton_impl.h"

#include <math.h>

#include "elements/math/real.h"

typedef double lanes
    __attribute__((vector_size(PIECE_LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

#define INLINED static inline __attribute__((always_inline))

/* Multiplies a row v[nodes x joint] by the motion of the nodes with the start of the piece:
 * out[joint]. */
INLINED void times_motion(int c, int nodes, const lanes v[], const lanes arm[], int first,
                          lanes out[])
{
    for (int i = 0; i < c; i++)
        out[i] = (lanes){0};
    for (int k = 0; k < nodes; k++) {
        const lanes *f = v + (ptrdiff_t)k * c, *d = arm + (ptrdiff_t)3 * k;
        for (int i = 0; i < 6; i++)
            out[i] += f[i];
        out[3] += d[1] * f[2] - d[2] * f[1];
        out[4] += d[2] * f[0] - d[0] * f[2];
        out[5] += d[0] * f[1] - d[1] * f[0];
    }
    if (first && c == NODE_COORDINATES)
        out[6] = v[6];
}

INLINED lanes of_lanes(const double *const from[], int at)
{
    return (lanes){from[0][at], from[1][at], from[2][at], from[3][at]};
}

INLINED int place(int c, int i)
{
    return NODE_COORDINATES * (i / c) + i % c;
}

/* Adds (subtracts, if `less` is 1) sum_k A[k][i] B[k][j] to the lower triangle of front[i][j], from
 * row and column `first` on. Moves the sums `first` rows and columns up. Rows from `fixed` on stay
 * in their rows, and columns from `fixed` on in their columns. */
INLINED void add_products(int rows, int width, int depth, int first, int fixed, int less,
                          const lanes A[], const lanes B[], lanes front[])
{
    enum { TOGETHER = PIECE_MARGIN + 1 };
    for (int i = first; i < rows; i++)
        for (int j = first; j <= i; j += TOGETHER) {
            lanes sum[TOGETHER];
            for (int t = 0; t < TOGETHER; t++)
                sum[t] = front[i * width + j + t];
            for (int k = 0; k < depth; k++) {
                const lanes one = A[k * width + i];
                for (int t = 0; t < TOGETHER; t++) {
                    const lanes product = one * B[k * width + j + t];
                    sum[t] = less ? sum[t] - product : sum[t] + product;
                }
            }
            lanes *to = front + (ptrdiff_t)(i < fixed ? i - first : i) * width;
            for (int t = 0; t < TOGETHER && j + t <= i; t++)
                to[j + t < fixed ? j + t - first : j + t] = sum[t];
        }
}

/* Returns 1 if the strains E due to the motion with the start are rounding errors of J. */
INLINED int is_rigid(int c, int nodes, int strains, const lanes J[], const lanes arm[])
{
    const double rounding = 1e-9;
    const int n = c * nodes, width = n + c + PIECE_MARGIN;
    lanes longest = {0};
    int rigid = 1;
    for (int i = 0; i < 3 * nodes; i++)
        longest += arm[i] * arm[i];
    for (int k = 0; k < strains; k++) {
        lanes moved = {0}, turned = {0}, E = {0}, E_turned = {0};
        for (int i = 0; i < n; i++) {
            const lanes square = J[k * width + i] * J[k * width + i];
            if (i % c < 3)
                moved += square;
            else
                turned += square;
        }
        for (int i = 0; i < c; i++) {
            const lanes square = J[k * width + n + i] * J[k * width + n + i];
            if (i < 3)
                E += square;
            else
                E_turned += square;
        }
        const double limit = rounding * rounding;
        for (int lane = 0; lane < PIECE_LANES; lane++)
            rigid &= E[lane] <= limit * moved[lane] &&
                     E_turned[lane] <= limit * (moved[lane] * longest[lane] + turned[lane]);
    }
    return rigid;
}

/* J[strains x (rows + margin)]: the last columns, E, belong to the motion with the start. */
INLINED void take_strains(int c, int nodes, int strains, const piece_element *e, lanes J[])
{
    const int n = c * nodes, width = n + c + PIECE_MARGIN, columns = NODE_COORDINATES * nodes;
    for (int k = 0; k < strains; k++) {
        lanes *row = J + (ptrdiff_t)k * width;
        for (int i = 0; i < n; i++)
            row[i] = of_lanes(e->J, k * columns + place(c, i));
        times_motion(c, nodes, row, (const lanes *)e->arm, e->first, row + n);
        for (int i = n + c; i < width; i++)
            row[i] = (lanes){0};
    }
}

INLINED void multiply(int n, int width, int strains, const piece_element *e, const lanes J[],
                      lanes CJ[])
{
    enum { TOGETHER = PIECE_MARGIN + 1 };
    for (int k = 0; k < strains; k++)
        for (int i = 0; i < n; i += TOGETHER) {
            lanes sum[TOGETHER] = {{0}};
            for (int j = 0; j < strains; j++) {
                const lanes C = of_lanes(e->C, k * strains + j);
                for (int t = 0; t < TOGETHER; t++)
                    sum[t] += C * J[j * width + i + t];
            }
            for (int t = 0; t < TOGETHER; t++)
                CJ[k * width + i + t] = sum[t];
        }
}

INLINED void add_material(int c, int nodes, int strains, const piece_element *e, lanes J[],
                          lanes CJ[], lanes front[])
{
    const int n = c * nodes, rows = n + c, width = rows + PIECE_MARGIN;
    take_strains(c, nodes, strains, e, J);
    if (is_rigid(c, nodes, strains, J, (const lanes *)e->arm)) {
        multiply(n, width, strains, e, J, CJ);
        add_products(n, width, strains, 0, n, 0, J, CJ, front);
        return;
    }
    multiply(rows, width, strains, e, J, CJ);
    add_products(rows, width, strains, 0, rows, 0, J, CJ, front);
}

INLINED void add_geometric(int c, int nodes, const piece_element *e, lanes HT[], lanes front[])
{
    const int n = c * nodes, width = n + c + PIECE_MARGIN, columns = NODE_COORDINATES * nodes;
    const lanes *arm = (const lanes *)e->arm;
    for (int i = 0; i < n; i++) {
        lanes row[ELEMENT_MAX_COORDINATES], moved[CHAIN_JOINT];
        for (int j = 0; j < n; j++)
            row[j] = of_lanes(e->H, place(c, i) * columns + place(c, j));
        times_motion(c, nodes, row, arm, e->first, moved);
        for (int j = 0; j <= i; j++)
            front[i * width + j] += row[j];
        for (int a = 0; a < c; a++) {
            HT[a * n + i] = moved[a];
            front[(n + a) * width + i] += moved[a];
        }
    }
    for (int a = 0; a < c; a++) {
        lanes moved[CHAIN_JOINT];
        times_motion(c, nodes, HT + (ptrdiff_t)a * n, arm, e->first, moved);
        for (int b = 0; b <= a; b++)
            front[(n + a) * width + n + b] += moved[b];
    }
}

INLINED void add(int c, int nodes, int strains, const piece_element *e, double work[],
                 double front[])
{
    lanes *J = (lanes *)work, *CJ = J + (ptrdiff_t)strains * (c * (nodes + 1) + PIECE_MARGIN);
    add_material(c, nodes, strains, e, J, CJ, (lanes *)front);
    add_geometric(c, nodes, e, J, (lanes *)front);
}

void REAL_NAMED(triangular_pieces_add)(const piece_form *p, const piece_element *e, double work[],
                                       double front[])
{
    if (p->nodes == 2 && p->joint == 7)
        add(7, 2, p->strains, e, work, front);
    else if (p->nodes == 2)
        add(6, 2, p->strains, e, work, front);
    else
        add(p->joint, p->nodes, p->strains, e, work, front);
}

/* Sets the block before the coordinates of the start to zero. */
INLINED void empty_last(int c, int nodes, lanes front[])
{
    const int n = c * nodes, rows = n + c, width = rows + PIECE_MARGIN;
    for (int i = n - c; i < n; i++)
        for (int j = 0; j <= i; j++)
            front[i * width + j] = (lanes){0};
    for (int i = n; i < rows; i++)
        for (int j = n - c; j < n; j++)
            front[i * width + j] = (lanes){0};
}

/* Eliminates the columns of the first block within these columns. U[joint x (rows + margin)]:
 * columns before they are divided by the pivots; L: the same, divided. */
INLINED int eliminate_block(int c, int rows, lanes front[], lanes kept[], int negative[], lanes U[],
                            lanes L[])
{
    const int width = rows + PIECE_MARGIN;
    int regular = 1;
    for (int k = 0; k < c; k++) {
        const lanes d = front[k * width + k], inverse = 1 / d;
        for (int lane = 0; lane < PIECE_LANES; lane++) {
            regular &= isfinite(inverse[lane]) && isfinite(d[lane]);
            negative[lane] += d[lane] < 0;
        }
        *kept++ = inverse;
        for (int i = k + 1; i < rows; i++) {
            U[k * width + i] = front[i * width + k];
            *kept++ = L[k * width + i] = front[i * width + k] * inverse;
        }
        for (int i = k + 1; i < rows; i++)
            for (int j = k + 1; j < c && j <= i; j++)
                front[i * width + j] -= L[k * width + i] * U[k * width + j];
    }
    return regular;
}

INLINED int eliminate(int c, int nodes, lanes front[], lanes kept[], int negative[])
{
    const int n = c * nodes, rows = n + c, width = rows + PIECE_MARGIN;
    lanes U[CHAIN_JOINT * PIECE_MOST_WIDTH], L[CHAIN_JOINT * PIECE_MOST_WIDTH];
    for (int k = 0; k < c; k++)
        for (int i = rows; i < width; i++)
            U[k * width + i] = (lanes){0};
    const int regular = eliminate_block(c, rows, front, kept, negative, U, L);
    add_products(rows, width, c, c, n, 1, L, U, front);
    return regular;
}

/* Moves the coordinates after the first block to its place. */
INLINED void drop(int c, int nodes, lanes front[])
{
    const int n = c * nodes, rows = n + c, width = rows + PIECE_MARGIN;
    for (int i = c; i < rows; i++)
        for (int j = c; j <= i && j < n; j++)
            front[(i < n ? i - c : i) * width + j - c] = front[i * width + j];
}

INLINED int next(int c, int nodes, double front[], double kept[], int negative[])
{
    int regular = 1;
    if (kept == NULL)
        drop(c, nodes, (lanes *)front);
    else
        regular = eliminate(c, nodes, (lanes *)front, (lanes *)kept, negative);
    empty_last(c, nodes, (lanes *)front);
    return regular;
}

int REAL_NAMED(triangular_pieces_next)(const piece_form *p, double front[], double kept[],
                                       int negative[])
{
    if (p->nodes == 2 && p->joint == 7)
        return next(7, 2, front, kept, negative);
    if (p->nodes == 2)
        return next(6, 2, front, kept, negative);
    return next(p->joint, p->nodes, front, kept, negative);
}

INLINED void reduce(int c, int nodes, int blocks, const lanes kept[], const lanes arm[], lanes r[],
                    lanes ends[])
{
    const int n = c * nodes, all = n + c;
    lanes h[ELEMENT_MAX_COORDINATES + CHAIN_JOINT];
    for (int i = 0; i < all; i++)
        h[i] = (lanes){0};
    for (int block = 0; block < blocks; block++, r += c) {
        lanes moved[CHAIN_JOINT];
        times_motion(c, 1, r, arm + (ptrdiff_t)3 * (block + 1), 0, moved);
        for (int i = 0; i < c; i++) {
            h[n + i] += moved[i];
            h[i] += r[i];
        }
        for (int k = 0; k < c; k++) {
            const lanes y = h[k];
            r[k] = y * *kept++;
            for (int i = k + 1; i < all; i++)
                h[i] -= *kept++ * y;
        }
        for (int i = 0; i < n; i++)
            h[i] = i < n - c ? h[i + c] : (lanes){0};
    }
    lanes moved[CHAIN_JOINT];
    times_motion(c, 1, h, arm + (ptrdiff_t)3 * (blocks + 1), 0, moved);
    for (int i = 0; i < c; i++) {
        ends[i] = h[n + i] - moved[i];
        ends[c + i] = h[i];
    }
}

void REAL_NAMED(triangular_pieces_reduce)(const piece_form *p, int blocks, const double kept[],
                                          const double arm[], double r[], double ends[])
{
    const lanes *L = (const lanes *)kept, *d = (const lanes *)arm;
    if (p->nodes == 2 && p->joint == 7)
        reduce(7, 2, blocks, L, d, (lanes *)r, (lanes *)ends);
    else if (p->nodes == 2)
        reduce(6, 2, blocks, L, d, (lanes *)r, (lanes *)ends);
    else
        reduce(p->joint, p->nodes, blocks, L, d, (lanes *)r, (lanes *)ends);
}

/* Computes the motion of a node that moves with the start of the piece. The warping amplitude of
 * other nodes is zero. */
INLINED void carried(const lanes d[3], const lanes start[], lanes out[CHAIN_JOINT])
{
    out[6] = (lanes){0};
    for (int i = 0; i < 6; i++)
        out[i] = start[i];
    out[0] += start[4] * d[2] - start[5] * d[1];
    out[1] += start[5] * d[0] - start[3] * d[2];
    out[2] += start[3] * d[1] - start[4] * d[0];
}

INLINED void expand(int c, int nodes, int blocks, const lanes kept[], const lanes arm[],
                    const lanes ends[], lanes r[])
{
    const int n = c * nodes, all = n + c, size = c * all - c * (c - 1) / 2;
    lanes v[ELEMENT_MAX_COORDINATES + CHAIN_JOINT], with[CHAIN_JOINT];
    for (int i = 0; i < n; i++)
        v[i] = (lanes){0};
    carried(arm + (ptrdiff_t)3 * (blocks + 1), ends, with);
    for (int i = 0; i < c; i++) {
        v[n + i] = ends[i];
        v[i] = ends[c + i] - with[i];
    }
    for (int block = blocks; block-- > 0;) {
        const lanes *L = kept + (ptrdiff_t)(block + 1) * size;
        lanes *x = r + (ptrdiff_t)block * c;
        for (int i = n; i-- > c;)
            v[i] = v[i - c];
        for (int k = c; k-- > 0;) {
            lanes sum = x[k];
            L -= all - k - 1;
            for (int i = k + 1; i < all; i++)
                sum -= L[i - k - 1] * v[i];
            L--;
            v[k] = sum;
        }
        carried(arm + (ptrdiff_t)3 * (block + 1), ends, with);
        for (int i = 0; i < c; i++)
            x[i] = v[i] + with[i];
    }
}

void REAL_NAMED(triangular_pieces_expand)(const piece_form *p, int blocks, const double kept[],
                                          const double arm[], const double ends[], double r[])
{
    const lanes *L = (const lanes *)kept, *d = (const lanes *)arm, *at = (const lanes *)ends;
    if (p->nodes == 2 && p->joint == 7)
        expand(7, 2, blocks, L, d, at, (lanes *)r);
    else if (p->nodes == 2)
        expand(6, 2, blocks, L, d, at, (lanes *)r);
    else
        expand(p->joint, p->nodes, blocks, L, d, at, (lanes *)r);
}
