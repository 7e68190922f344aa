#include "harness/study/serialise.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A cell's result is a tree of arrays that records point to; records and elements are sent as they
 * stand in memory, and the addresses in them replaced by those of their own arrays. A new array is
 * one line in the tables below; a new number none. */
typedef struct branch branch;
struct branch {
    size_t pointer, size; /* of the address in the record; of an element [bytes] */
    /* ints in the record whose product counts the elements; count 0: a text; times 0: none */
    size_t count, times;
    size_t each, more;   /* elements for each of the product, and besides */
    const branch *parts; /* arrays of each element; NULL: none */
};

#define CELL(member)     offsetof(cell_result, member)
#define SOLVE(member)    offsetof(cell_result, solve.member)
#define QUANTITY(member) offsetof(quantity_result, member)
#define MATRICES(member) offsetof(nodal_matrices, member)
static const branch of_line[] = {{0, sizeof(char), 0, 0, 1, 0, NULL}, {0}};
static const branch of_quantity[] = {
    {QUANTITY(curve.x), sizeof(double), QUANTITY(curve.points), 0, 1, 0, NULL},
    {QUANTITY(curve.value), sizeof(double), QUANTITY(curve.points), 0, 1, 0, NULL},
    {0}};
static const branch of_matrices[] = {
    {MATRICES(path), sizeof(double), MATRICES(stations), 0, 1, 0, NULL},
    {MATRICES(compliance), sizeof(double), MATRICES(stations), 0, 36, 0, NULL},
    {MATRICES(stiffness), sizeof(double), MATRICES(stations), 0, 36, 0, NULL},
    {0}};
static const branch of_cell[] = {
    {CELL(left_out), sizeof(char *), CELL(left_out_lines), 0, 1, 0, of_line},
    {SOLVE(quantity), sizeof(quantity_result), SOLVE(quantities), 0, 1, 0, of_quantity},
    {SOLVE(step), sizeof(step_record), SOLVE(steps), 0, 1, 0, NULL},
    {SOLVE(iteration), sizeof(iteration_record), SOLVE(iterations), 0, 1, 0, NULL},
    {SOLVE(event), sizeof(path_event), SOLVE(events), 0, 1, 0, NULL},
    {SOLVE(motion), sizeof(motion_record), SOLVE(motions), 0, 1, 0, NULL},
    {SOLVE(matrices), sizeof(nodal_matrices), SOLVE(matrix_sets), 0, 1, 0, of_matrices},
    {SOLVE(shapes.first), sizeof(int), SOLVE(shapes.members), 0, 1, 1, NULL},
    {SOLVE(shapes.state), sizeof(shape_state), SOLVE(shapes.states), 0, 1, 0, NULL},
    {SOLVE(shapes.point), sizeof(centreline_point), SOLVE(shapes.states), SOLVE(shapes.points), 1,
     0, NULL},
    {SOLVE(shapes.node), sizeof(double), SOLVE(shapes.states), SOLVE(shapes.nodes), 3, 0, NULL},
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

static size_t whole_at(const void *record, size_t offset)
{
    int out;
    memcpy(&out, (const char *)record + offset, sizeof out);
    return out > 0 ? (size_t)out : 0;
}

static size_t elements(const void *record, const branch *b)
{
    const char *text = b->count == 0 ? address(record, b) : NULL;
    if (b->count == 0)
        return text != NULL ? strlen(text) + 1 : 0;
    return b->each * whole_at(record, b->count) * (b->times > 0 ? whole_at(record, b->times) : 1) +
           b->more;
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
        if (b->parts != NULL)
            for (size_t i = 0; i < count; i++)
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

/* As serialise_read; *out NULL then. */
static int get_array(FILE *from, const branch *b, size_t count, char **out)
{
    enum { LARGEST = 1 << 28 }; /* [bytes] a count beyond this is damage */
    *out = NULL;
    if (count >= LARGEST / b->size)
        return SERIALISE_DAMAGED;
    *out = calloc(count + 1, b->size);
    if (*out == NULL)
        return SERIALISE_NO_MEMORY;
    if (get(from, *out, count * b->size) == 0 && (b->count != 0 || (*out)[count - 1] == '\0'))
        return 0;
    free(*out);
    *out = NULL;
    return SERIALISE_DAMAGED;
}

static int get_parts(FILE *from, void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++) {
        size_t count = 0;
        if (get(from, &count, sizeof count) != 0)
            return -1;
        if (b->count != 0 && count != elements(record, b) &&
            (count != 0 || elements(record, b) > b->more))
            return -1;
        if (count == 0)
            continue;
        char *array;
        const int bad = get_array(from, b, count, &array);
        if (bad != 0)
            return bad;
        set_address(record, b, array);
        if (b->parts != NULL)
            for (size_t i = 0; i < count; i++)
                forget(array + i * b->size, b->parts);
        for (size_t i = 0; b->parts != NULL && i < count; i++) {
            const int worse = get_parts(from, array + i * b->size, b->parts);
            if (worse != 0)
                return worse;
        }
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

int serialise_write(FILE *to, const cell_result *cell)
{
    if (put(to, cell, sizeof *cell) != 0 || put_parts(to, cell, of_cell) != 0)
        return -1;
    return fflush(to) == 0 ? 0 : -1;
}

int serialise_read(FILE *from, cell_result *cell)
{
    memset(cell, 0, sizeof *cell);
    if (get(from, cell, sizeof *cell) != 0) {
        memset(cell, 0, sizeof *cell);
        return -1;
    }
    forget(cell, of_cell);
    memset(&cell->scene, 0, sizeof cell->scene); /* it stays with the point */
    const int bad = get_parts(from, cell, of_cell);
    if (bad == 0)
        return 0;
    free_parts(cell, of_cell);
    memset(cell, 0, sizeof *cell); /* nothing half-read is left */
    return bad;
}
