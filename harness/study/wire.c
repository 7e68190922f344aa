#include "harness/study/wire.h"

#include <stdlib.h>
#include <string.h>

static int put(FILE *to, const void *data, size_t size)
{
    return size == 0 || fwrite(data, size, 1, to) == 1 ? 0 : -1;
}

static int get(FILE *from, void *data, size_t size)
{
    return size == 0 || fread(data, size, 1, from) == 1 ? 0 : -1;
}

static int put_shapes(FILE *to, const shapes *s)
{
    const size_t states = (size_t)s->states;
    if (states == 0)
        return 0;
    return put(to, s->first, ((size_t)s->members + 1) * sizeof *s->first) | put(to, s->state, states * sizeof *s->state) |
           put(to, s->point, states * (size_t)s->points * sizeof *s->point) |
           put(to, s->node, states * 3 * (size_t)s->nodes * sizeof *s->node);
}

int wire_write(FILE *to, const cell_result *cell)
{
    const solve_result *s = &cell->solve;
    int bad = put(to, &cell->size, sizeof cell->size) | put(to, &cell->counters, sizeof cell->counters) | put(to, s, sizeof *s) |
              put(to, &cell->left_out_lines, sizeof cell->left_out_lines);
    for (int i = 0; i < cell->left_out_lines && !bad; i++) {
        const size_t length = strlen(cell->left_out[i]) + 1;
        bad = put(to, &length, sizeof length) | put(to, cell->left_out[i], length);
    }
    bad |= put(to, s->quantity, (size_t)s->quantities * sizeof *s->quantity) |
           put(to, s->step, (size_t)s->steps * sizeof *s->step) | put(to, s->event, (size_t)s->events * sizeof *s->event) |
           put(to, s->iteration, (size_t)s->iterations * sizeof *s->iteration) |
           put(to, s->matrices, (size_t)s->matrix_sets * sizeof *s->matrices);
    for (int i = 0; i < s->matrix_sets && !bad; i++) {
        const nodal_matrices *m = &s->matrices[i];
        const size_t matrices = 36 * (size_t)m->stations * sizeof(double);
        bad = put(to, m->path, (size_t)m->stations * sizeof(double)) | put(to, m->compliance, matrices) |
              put(to, m->stiffness, matrices);
    }
    for (int i = 0; i < s->quantities && !bad; i++) {
        const size_t bytes = (size_t)s->quantity[i].curve.points * sizeof(double);
        bad = put(to, s->quantity[i].curve.x, bytes) | put(to, s->quantity[i].curve.value, bytes);
    }
    return bad || put_shapes(to, &s->shapes) != 0 || fflush(to) != 0 ? -1 : 0;
}

static void *array(FILE *from, size_t count, size_t size, int *bad)
{
    enum { LARGEST = 1 << 28 }; /* [bytes] a count beyond this is damage */
    void *out = count < LARGEST / size ? calloc(count + 1, size) : NULL;
    if (out == NULL || get(from, out, count * size) != 0)
        *bad = 1;
    return out;
}

/* The counts have been read; the arrays follow. */
static int get_shapes(FILE *from, shapes *s)
{
    const size_t states = (size_t)s->states;
    if (states == 0)
        return 0;
    if (shapes_alloc(s, NULL) != STATUS_OK)
        return -1;
    return get(from, s->first, ((size_t)s->members + 1) * sizeof *s->first) | get(from, s->state, states * sizeof *s->state) |
           get(from, s->point, states * (size_t)s->points * sizeof *s->point) |
           get(from, s->node, states * 3 * (size_t)s->nodes * sizeof *s->node);
}

static void read_matrices(FILE *from, int sets, solve_result *s, int *bad)
{
    s->matrices = array(from, (size_t)sets, sizeof *s->matrices, bad);
    s->matrix_sets = 0; /* those whose addresses are of this process */
    for (int i = 0; i < sets && !*bad; i++) {
        nodal_matrices *m = &s->matrices[i];
        const size_t stations = (size_t)m->stations;
        m->path = m->compliance = m->stiffness = NULL;
        s->matrix_sets++;
        m->path = array(from, stations, sizeof(double), bad);
        m->compliance = array(from, 36 * stations, sizeof(double), bad);
        m->stiffness = array(from, 36 * stations, sizeof(double), bad);
    }
}

static int read_cell(FILE *from, cell_result *cell)
{
    solve_result *s = &cell->solve;
    int lines = 0, bad = get(from, &cell->size, sizeof cell->size) | get(from, &cell->counters, sizeof cell->counters);
    solve_result head = {0};
    if (bad || get(from, &head, sizeof head) != 0 || get(from, &lines, sizeof lines) != 0 || head.quantities < 0 ||
        head.steps < 0 || head.events < 0 || head.iterations < 0 || head.matrix_sets < 0 || lines < 0)
        return -1;
    cell->left_out = calloc((size_t)lines + 1, sizeof *cell->left_out);
    for (int i = 0; i < lines && !bad && cell->left_out != NULL; i++) {
        size_t length = 0;
        bad = get(from, &length, sizeof length) != 0;
        cell->left_out[cell->left_out_lines++] = bad ? NULL : array(from, length, 1, &bad);
    }
    quantity_result *quantity = bad ? NULL : array(from, (size_t)head.quantities, sizeof *quantity, &bad);
    for (int i = 0; i < head.quantities && quantity != NULL; i++)
        quantity[i].curve.x = quantity[i].curve.value = NULL; /* addresses of the other process */
    head.shapes.first = NULL;                                 /* the arrays are the other process's */
    head.shapes.state = NULL;
    head.shapes.point = NULL;
    head.shapes.node = NULL;
    *s = head;
    s->quantity = quantity;
    s->quantities = quantity != NULL ? head.quantities : 0;
    s->matrices = NULL;
    s->matrix_sets = 0;
    s->step = bad ? NULL : array(from, (size_t)head.steps, sizeof *s->step, &bad);
    s->event = bad ? NULL : array(from, (size_t)head.events, sizeof *s->event, &bad);
    s->iteration = bad ? NULL : array(from, (size_t)head.iterations, sizeof *s->iteration, &bad);
    if (!bad)
        read_matrices(from, head.matrix_sets, s, &bad);
    for (int i = 0; i < s->quantities && !bad; i++) {
        const size_t points = (size_t)s->quantity[i].curve.points;
        s->quantity[i].curve.x = points > 0 ? array(from, points, sizeof(double), &bad) : NULL;
        s->quantity[i].curve.value = points > 0 ? array(from, points, sizeof(double), &bad) : NULL;
    }
    return bad || cell->left_out == NULL || get_shapes(from, &s->shapes) != 0 ? -1 : 0;
}

int wire_read(FILE *from, cell_result *cell)
{
    memset(cell, 0, sizeof *cell);
    const int outcome = read_cell(from, cell);
    if (outcome != 0)
        cell_result_free(cell); /* nothing half-read is left */
    return outcome;
}
