/* Feedback loops in small vibrations. The force is P u with the factor u = (Kp + Kd s + Ki/s) (r -
 * S^T x), where S^T x is measured and r is the reference, as during motions (time/feedback.c). The
 * limit of u is ignored. In a harmonic analysis, each loop adds an unknown u. For damped modes, the
 * matrices become K + Kp P S^T and C + Kd P S^T. Each integral gain adds a coordinate, the integral
 * of -S^T x. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include "harness/time/time.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "feedback loops");
}

static int any(int n, const double x[])
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0)
            return 1;
    return 0;
}

status loops_find(vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    const model_size size = model_sizes(v->c->model);
    const size_t all = (size_t)size.free + (size_t)size.driven;
    int count = 0;
    for (int i = 0; i < s->loads; i++)
        count += scene_closes_loop(s, v->analysis, i);
    if (count == 0)
        return STATUS_OK;
    v->loop = calloc((size_t)count, sizeof *v->loop);
    v->signals = calloc(2 * (size_t)count * all + 1, sizeof *v->signals);
    if (v->loop == NULL || v->signals == NULL)
        return no_memory(f);
    for (int i = 0; i < s->loads; i++) {
        if (!scene_closes_loop(s, v->analysis, i))
            continue;
        double *push = v->signals + 2 * (size_t)v->loops * all;
        control_loop *one = &v->loop[v->loops++];
        *one = (control_loop){i, &s->load[i].feedback, push, push + all, 0};
        feedback_signals(&v->c->eq, v->state, i, push, push + all);
        one->integrates =
            one->gains->integral != 0 && any(size.free, push) && any(size.free, push + all);
    }
    return STATUS_OK;
}

void loops_free(vibration *v)
{
    free(v->loop);
    free(v->signals);
}

size_t loops_whole(const vibration *v)
{
    return (size_t)v->all + (size_t)v->loops;
}

const control_loop *loops_of(const vibration *v, int load)
{
    for (int i = 0; i < v->loops; i++)
        if (v->loop[i].load == load)
            return &v->loop[i];
    return NULL;
}

double complex loops_gain(const control_loop *l, double w, double complex *own)
{
    const scene_feedback *b = l->gains;
    const double complex s = I * w, gain = b->proportional + b->derivative * s;
    *own = b->integral != 0 ? s : 1; /* multiplied by s, so that the value is finite at s = 0 */
    return b->integral != 0 ? gain * s + b->integral : gain;
}

enum { CLOSED = 4 }; /* K, M, C, B */

typedef struct full_column {
    int n, rows;
    int *row;      /* [n] */
    char *is;      /* [n] 1: the row is in the list */
    double *value; /* [n x CLOSED] */
} full_column;

static void add(full_column *c, int which, int row, double value)
{
    if (!c->is[row])
        c->row[c->rows++] = row;
    c->is[row] = 1;
    c->value[row * CLOSED + which] += value;
}

/* Adds the entries of the loops to column j. Columns below n belong to coordinates, and columns
 * from n on belong to integrals. */
static void add_loops(const vibration *v, int n, int j, full_column *c)
{
    for (int l = 0, at = n; l < v->loops; l++) {
        const control_loop *loop = &v->loop[l];
        const scene_feedback *b = loop->gains;
        const double measured = j < n ? loop->measured[j] : 0;
        for (int i = 0; i < n && measured != 0; i++)
            if (loop->push[i] != 0) {
                add(c, 0, i, b->proportional * loop->push[i] * measured);
                add(c, 2, i, b->derivative * loop->push[i] * measured);
            }
        if (!loop->integrates)
            continue;
        if (measured != 0)
            add(c, 0, at, measured);
        for (int i = 0; i < n && j == at; i++)
            if (loop->push[i] != 0)
                add(c, 0, i, -b->integral * loop->push[i]);
        if (j == at)
            add(c, 2, at, 1);
        at++;
    }
}

static int ascending(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static void append(full_column *c, int j, sparse to[])
{
    qsort(c->row, (size_t)c->rows, sizeof *c->row, ascending);
    for (int k = 0; k < c->rows; k++) {
        const int i = c->row[k], at = to->column[j] + k;
        to->row[at] = i;
        for (int m = 0; m < CLOSED; m++)
            to[m].value[at] = c->value[i * CLOSED + m];
        memset(c->value + (size_t)i * CLOSED, 0, CLOSED * sizeof *c->value);
        c->is[i] = 0;
    }
    to->column[j + 1] = to->column[j] + c->rows;
    c->rows = 0;
}

/* Lists the entries of the symmetric K above its diagonal row by row. The entries of row i start at
 * index first[i]. column: their columns; of: their positions in K. */
static void turn(const sparse *K, int first[], int column[], int of[])
{
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            first[K->row[k] + 1] += K->row[k] != j;
    for (int i = 0; i < K->n; i++)
        first[i + 1] += first[i];
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            if (K->row[k] != j) {
                of[first[K->row[k]]] = k;
                column[first[K->row[k]]++] = j;
            }
    for (int i = K->n; i > 0; i--)
        first[i] = first[i - 1];
    first[0] = 0;
}

static void fill(const vibration *v, const sparse *const from[], const int first[],
                 const int column[], const int of[], full_column *c, sparse to[])
{
    const sparse *K = from[0];
    for (int j = 0; j < c->n; j++) {
        for (int k = j < K->n ? K->column[j] : 0; j < K->n && k < K->column[j + 1]; k++)
            for (int m = 0; m < CLOSED; m++)
                add(c, m, K->row[k], from[m]->value[k]);
        for (int k = j < K->n ? first[j] : 0; j < K->n && K->symmetric && k < first[j + 1]; k++)
            for (int m = 0; m < CLOSED; m++)
                add(c, m, column[k], from[m]->value[of[k]]);
        add_loops(v, K->n, j, c);
        append(c, j, to);
    }
}

status loops_close(const vibration *v, const sparse *const from[], sparse to[], fault *f)
{
    const int n = from[0]->n, entries = from[0]->column[n];
    int more = n, most = 2 * entries;
    for (int l = 0; l < v->loops; l++) {
        int pushed = 0, measured = 0;
        for (int i = 0; i < n; i++) {
            pushed += v->loop[l].push[i] != 0;
            measured += v->loop[l].measured[i] != 0;
        }
        more += v->loop[l].integrates;
        most += (pushed + 1) * (measured + 1);
    }
    full_column c = {.n = more,
                     .row = calloc((size_t)more + 1, sizeof *c.row),
                     .is = calloc((size_t)more + 1, sizeof *c.is),
                     .value = calloc((size_t)more * CLOSED + 1, sizeof *c.value)};
    int *room = calloc((size_t)n + 2 + 2 * (size_t)entries, sizeof *room);
    to[0] = (sparse){.n = more,
                     .column = calloc((size_t)more + 1, sizeof(int)),
                     .row = calloc((size_t)most + 1, sizeof(int)),
                     .value = calloc(CLOSED * (size_t)most + 1, sizeof(double))};
    status outcome = STATUS_OK;
    if (c.row == NULL || c.is == NULL || c.value == NULL || room == NULL || to->column == NULL ||
        to->row == NULL || to->value == NULL)
        outcome = no_memory(f);
    for (int m = 1; m < CLOSED && outcome == STATUS_OK; m++) {
        to[m] = to[0];
        to[m].value = to->value + (size_t)m * (size_t)most;
    }
    if (outcome == STATUS_OK) {
        int *const column = room + n + 1, *const of = column + entries;
        if (from[0]->symmetric)
            turn(from[0], room, column, of);
        fill(v, from, room, column, of, &c, to);
    }
    free(c.row);
    free(c.is);
    free(c.value);
    free(room);
    return outcome;
}

void loops_release(sparse closed[])
{
    free(closed[0].column);
    free(closed[0].row);
    free(closed[0].value);
}
