#include "harness/study/wire.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A cell's result is a tree of arrays that records point to; records and elements are sent as they stand in memory, and the
 * addresses in them replaced by those of their own arrays. A new array is one line in the tables below; a new number none. */
typedef struct branch branch;
struct branch {
    size_t pointer, size;               /* of the address in the record; of an element [bytes] */
    size_t (*elements)(const void *of); /* by the counts of the record; NULL: a text, which ends with its first zero */
    const branch *parts;                /* arrays of each element; NULL: none */
};

static size_t at_least_0(int n)
{
    return n > 0 ? (size_t)n : 0;
}

static size_t curve_points(const void *of)
{
    return at_least_0(((const quantity_result *)of)->curve.points);
}

static size_t stations(const void *of)
{
    return at_least_0(((const nodal_matrices *)of)->stations);
}

static size_t entries(const void *of)
{
    return 36 * stations(of);
}

static size_t lines(const void *of)
{
    return at_least_0(((const cell_result *)of)->left_out_lines);
}

static size_t quantities(const void *of)
{
    return at_least_0(((const cell_result *)of)->solve.quantities);
}

static size_t steps(const void *of)
{
    return at_least_0(((const cell_result *)of)->solve.steps);
}

static size_t iterations(const void *of)
{
    return at_least_0(((const cell_result *)of)->solve.iterations);
}

static size_t events(const void *of)
{
    return at_least_0(((const cell_result *)of)->solve.events);
}

static size_t matrix_sets(const void *of)
{
    return at_least_0(((const cell_result *)of)->solve.matrix_sets);
}

static const shapes *shapes_of(const void *of)
{
    return &((const cell_result *)of)->solve.shapes;
}

static size_t shape_states(const void *of)
{
    return at_least_0(shapes_of(of)->states);
}

static size_t shape_members(const void *of)
{
    return shape_states(of) > 0 ? at_least_0(shapes_of(of)->members) + 1 : 0;
}

static size_t shape_points(const void *of)
{
    return shape_states(of) * at_least_0(shapes_of(of)->points);
}

static size_t shape_nodes(const void *of)
{
    return 3 * shape_states(of) * at_least_0(shapes_of(of)->nodes);
}

static const branch of_line[] = {{0, sizeof(char), NULL, NULL}, {0}};
static const branch of_quantity[] = {{offsetof(quantity_result, curve.x), sizeof(double), curve_points, NULL},
                                     {offsetof(quantity_result, curve.value), sizeof(double), curve_points, NULL},
                                     {0}};
static const branch of_matrices[] = {{offsetof(nodal_matrices, path), sizeof(double), stations, NULL},
                                     {offsetof(nodal_matrices, compliance), sizeof(double), entries, NULL},
                                     {offsetof(nodal_matrices, stiffness), sizeof(double), entries, NULL},
                                     {0}};
static const branch of_cell[] = {{offsetof(cell_result, left_out), sizeof(char *), lines, of_line},
                                 {offsetof(cell_result, solve.quantity), sizeof(quantity_result), quantities, of_quantity},
                                 {offsetof(cell_result, solve.step), sizeof(step_record), steps, NULL},
                                 {offsetof(cell_result, solve.iteration), sizeof(iteration_record), iterations, NULL},
                                 {offsetof(cell_result, solve.event), sizeof(path_event), events, NULL},
                                 {offsetof(cell_result, solve.matrices), sizeof(nodal_matrices), matrix_sets, of_matrices},
                                 {offsetof(cell_result, solve.shapes.first), sizeof(int), shape_members, NULL},
                                 {offsetof(cell_result, solve.shapes.state), sizeof(shape_state), shape_states, NULL},
                                 {offsetof(cell_result, solve.shapes.point), sizeof(centreline_point), shape_points, NULL},
                                 {offsetof(cell_result, solve.shapes.node), sizeof(double), shape_nodes, NULL},
                                 {0}};

static void *address(const void *record, const branch *b)
{
    void *out;
    memcpy(&out, (const char *)record + b->pointer, sizeof out);
    return out;
}

static void set_address(void *record, const branch *b, const void *to)
{
    memcpy((char *)record + b->pointer, &to, sizeof to);
}

static size_t elements(const void *record, const branch *b)
{
    const char *text = address(record, b);
    if (b->elements != NULL)
        return b->elements(record);
    return text != NULL ? strlen(text) + 1 : 0;
}

static int put(FILE *to, const void *data, size_t size)
{
    return size == 0 || fwrite(data, size, 1, to) == 1 ? 0 : -1;
}

static int get(FILE *from, void *data, size_t size)
{
    return size == 0 || fread(data, size, 1, from) == 1 ? 0 : -1;
}

/* Every array behind its length. */
static int put_parts(FILE *to, const void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++) {
        const char *array = address(record, b);
        const size_t count = array != NULL ? elements(record, b) : 0;
        if (put(to, &count, sizeof count) != 0 || put(to, array, count * b->size) != 0)
            return -1;
        for (size_t i = 0; i < count && b->parts != NULL; i++)
            if (put_parts(to, array + i * b->size, b->parts) != 0)
                return -1;
    }
    return 0;
}

/* The addresses are those of the other process. */
static void forget(void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++)
        set_address(record, b, NULL);
}

/* NULL: out of memory, the stream ended, or it is damaged. */
static char *get_array(FILE *from, const branch *b, size_t count)
{
    enum { LARGEST = 1 << 28 }; /* [bytes] a count beyond this is damage */
    char *out = count < LARGEST / b->size ? calloc(count + 1, b->size) : NULL;
    if (out != NULL && get(from, out, count * b->size) == 0 && (b->elements != NULL || out[count - 1] == '\0'))
        return out;
    free(out);
    return NULL;
}

static int get_parts(FILE *from, void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++) {
        size_t count = 0;
        if (get(from, &count, sizeof count) != 0 || (b->elements != NULL && b->elements(record) != count))
            return -1;
        if (count == 0)
            continue;
        char *array = get_array(from, b, count);
        if (array == NULL)
            return -1;
        set_address(record, b, array);
        for (size_t i = 0; i < count && b->parts != NULL; i++)
            forget(array + i * b->size, b->parts);
        for (size_t i = 0; i < count && b->parts != NULL; i++)
            if (get_parts(from, array + i * b->size, b->parts) != 0)
                return -1;
    }
    return 0;
}

static void free_parts(void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++) {
        char *array = address(record, b);
        const size_t count = array != NULL && b->parts != NULL ? elements(record, b) : 0;
        for (size_t i = 0; i < count; i++)
            free_parts(array + i * b->size, b->parts);
        free(array);
    }
}

int wire_write(FILE *to, const cell_result *cell)
{
    if (put(to, cell, sizeof *cell) != 0 || put_parts(to, cell, of_cell) != 0)
        return -1;
    return fflush(to) == 0 ? 0 : -1;
}

int wire_read(FILE *from, cell_result *cell)
{
    memset(cell, 0, sizeof *cell);
    if (get(from, cell, sizeof *cell) != 0) {
        memset(cell, 0, sizeof *cell);
        return -1;
    }
    forget(cell, of_cell);
    memset(&cell->scene, 0, sizeof cell->scene); /* it stays with the point */
    if (get_parts(from, cell, of_cell) == 0)
        return 0;
    free_parts(cell, of_cell);
    memset(cell, 0, sizeof *cell); /* nothing half-read is left */
    return -1;
}
