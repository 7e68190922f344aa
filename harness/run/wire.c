#include "harness/run/wire.h"

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

int wire_write(FILE *to, const cell_result *cell)
{
    const solve_result *s = &cell->solve;
    int bad = put(to, &cell->size, sizeof cell->size) | put(to, &cell->counters, sizeof cell->counters) | put(to, s, sizeof *s) |
              put(to, &cell->left_out_lines, sizeof cell->left_out_lines);
    for (int i = 0; i < cell->left_out_lines && !bad; i++) {
        const size_t length = strlen(cell->left_out[i]) + 1;
        bad = put(to, &length, sizeof length) | put(to, cell->left_out[i], length);
    }
    bad |= put(to, s->quantity, (size_t)s->quantities * sizeof *s->quantity) | put(to, s->step, (size_t)s->steps * sizeof *s->step);
    for (int i = 0; i < s->quantities && !bad; i++) {
        const size_t bytes = (size_t)s->quantity[i].curve.points * sizeof(double);
        bad = put(to, s->quantity[i].curve.x, bytes) | put(to, s->quantity[i].curve.value, bytes);
    }
    return bad != 0 || fflush(to) != 0 ? -1 : 0;
}

static void *array(FILE *from, size_t count, size_t size, int *bad)
{
    void *out = calloc(count + 1, size);
    if (out == NULL || get(from, out, count * size) != 0)
        *bad = 1;
    return out;
}

int wire_read(FILE *from, cell_result *cell)
{
    solve_result *s = &cell->solve;
    int lines = 0, bad = 0;
    memset(cell, 0, sizeof *cell);
    if (get(from, &cell->size, sizeof cell->size) != 0 || get(from, &cell->counters, sizeof cell->counters) != 0 ||
        get(from, s, sizeof *s) != 0)
        return -1;
    s->quantity = NULL;
    s->step = NULL;
    if (get(from, &lines, sizeof lines) != 0)
        return -1;
    cell->left_out = calloc((size_t)lines + 1, sizeof *cell->left_out);
    for (int i = 0; i < lines && !bad && cell->left_out != NULL; i++) {
        size_t length = 0;
        bad = get(from, &length, sizeof length) != 0;
        cell->left_out[i] = bad ? NULL : array(from, length, 1, &bad);
        cell->left_out_lines++;
    }
    if (bad)
        return -1;
    s->quantity = array(from, (size_t)s->quantities, sizeof *s->quantity, &bad);
    s->step = array(from, (size_t)s->steps, sizeof *s->step, &bad);
    for (int i = 0; i < s->quantities && !bad; i++) {
        const size_t points = (size_t)s->quantity[i].curve.points;
        s->quantity[i].curve.x = points > 0 ? array(from, points, sizeof(double), &bad) : NULL;
        s->quantity[i].curve.value = points > 0 ? array(from, points, sizeof(double), &bad) : NULL;
    }
    return bad ? -1 : 0;
}
