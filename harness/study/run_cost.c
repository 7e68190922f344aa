#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double stations_of(const scene *s, const scene_analysis *a)
{
    while (scene_path_of(a) == NULL && a->follows != SCENE_NONE)
        a = &s->analysis[a->follows];
    return scene_path_of(a) != NULL ? scene_path_of(a)->stations : 1;
}

/* Returns the estimated number of load steps: `between` steps up to the first station, which are
 * shorter but count as full steps, and one step for each further station. */
static double steps_of(const scene_analysis *a, int steps)
{
    const int between = steps > 0 ? steps : scene_walk_of(a)->steps_between;
    return scene_path_of(a)->stations + between - 1;
}

static double motion_steps(const scene_motion *m)
{
    static const double usual = 1e-4, steps[] = {80, 40}, power[] = {0.45, 0.3};
    const int high = m->scheme == SCENE_RADAU;
    if (m->tolerance > 0 && m->scheme != SCENE_EXPLICIT)
        return steps[high] * pow(usual / m->tolerance, power[high]);
    return ceil(m->path.value[m->path.stations - 1] / m->step * (1 - 1e-9));
}

static void count_analysis(const scene *s, const scene_analysis *a, int steps, double times[])
{
    switch (a->kind) {
    case SCENE_LINEAR:
        times[RUN_COST_linear]++;
        break;
    case SCENE_BUCKLING:
        times[a->follows != SCENE_NONE ? RUN_COST_loaded_buckling : RUN_COST_buckling]++;
        break;
    case SCENE_MODAL:
    case SCENE_HARMONIC:
        times[RUN_COST_modal]++;
        break;
    case SCENE_MOTION:
        times[RUN_COST_alpha_step + (int)scene_motion_of(a)->scheme] +=
            motion_steps(scene_motion_of(a));
        break;
    case SCENE_STATIC:
        times[RUN_COST_load_step] += steps_of(a, steps);
        break;
    case SCENE_COMPLIANCE:
        times[RUN_COST_compliance] += stations_of(s, a);
        break;
    case SCENE_CONTINUATION:
        times[RUN_COST_continuation]++;
        break;
    case SCENE_ROTATION:
        times[RUN_COST_rotation_step] += steps_of(a, steps);
        times[RUN_COST_rotation_station] += stations_of(s, a);
        break;
    }
}

void run_cost_count(const scene *s, int steps, double times[RUN_COST_KINDS])
{
    for (int k = 0; k < RUN_COST_KINDS; k++)
        times[k] = k == RUN_COST_cell;
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i))
            count_analysis(s, &s->analysis[i], steps, times);
}

static run_cost_pair own_factor(const element_type *type)
{
    const run_cost_factor *row = run_cost_factors;
    while (row->formulation != NULL && strcmp(row->formulation, type->name) != 0)
        row++;
    return row->factor;
}

double run_cost_of_scene(const scene *s, int steps, const element_type *type, int elements)
{
    const run_cost_pair own = own_factor(type);
    const double all = (double)elements * s->members;
    double times[RUN_COST_KINDS], sum = 0;
    run_cost_count(s, steps, times);
    for (int k = 0; k < RUN_COST_KINDS; k++)
        sum += times[k] *
               (run_cost_work[k].once * own.once + run_cost_work[k].element * own.element * all);
    return sum;
}

double run_cost_of_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    return run_cost_of_scene(&p->scene, p->steps, one->formulation.type, one->mesh[mesh]);
}

/* fraction of the work of one process above which a series is expensive */
static const double expensive_share = 0.01;

typedef struct expense {
    double all; /* cost of the series; 0: the series is not expensive */
    int series;
} expense;

static int most_expensive_first(const void *left, const void *right)
{
    const expense *a = left, *b = right;
    if (a->all != b->all)
        return a->all > b->all ? -1 : 1;
    return a->series < b->series ? -1 : 1;
}

int run_cost_order(const sweep *s, int jobs, workload_task tasks[])
{
    double sum = 0;
    expense *list = malloc(((size_t)s->seriess + 1) * sizeof *list);
    int count = 0, n = 0;
    if (list == NULL)
        return -1;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        if (one->missing[0] != '\0' || one->imported != NULL ||
            s->point[one->point].status != STATUS_OK)
            continue;
        list[count] = (expense){0, i};
        for (int k = 0; k < one->meshes; k++)
            list[count].all += run_cost_of_cell(s, i, k);
        sum += list[count++].all;
    }
    for (int i = 0; i < count; i++)
        if (list[i].all * jobs < expensive_share * sum)
            list[i].all = 0;
    qsort(list, (size_t)count, sizeof *list, most_expensive_first);
    for (int i = 0; i < count; i++)
        for (int k = s->series[list[i].series].meshes - 1; k >= 0; k--)
            tasks[n++] = (workload_task){.series = list[i].series, .mesh = k};
    free(list);
    return 0;
}

/* The result of a cell is a tree of arrays. Records and elements are sent as they are in memory,
 * and the receiver replaces the pointers by its own. */
typedef struct branch branch;
struct branch {
    /* position of the pointer in the record, and size of an element [bytes] */
    size_t pointer, size;
    /* positions of the integers whose product is the number of elements; count 0: the array is a
     * string; times 0: there is only one integer */
    size_t count, times;
    /* number of elements per unit of the product, and number of additional elements */
    size_t each, more;
    const branch *parts;
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

static void free_branch(void *record, const branch parts[])
{
    for (const branch *b = parts; b->size > 0; b++)
        set_address(record, b, NULL);
}

/* Reads an array of `count` elements. Returns 0, SERIALISE_DAMAGED or SERIALISE_NO_MEMORY. After a
 * failure, *out is NULL. */
static int get_array(FILE *from, const branch *b, size_t count, char **out)
{
    enum { LARGEST = 1 << 28 }; /* [bytes] larger arrays mean that the data are damaged */
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
                free_branch(array + i * b->size, b->parts);
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
    free_branch(cell, of_cell);
    memset(&cell->scene, 0, sizeof cell->scene);
    const int bad = get_parts(from, cell, of_cell);
    if (bad == 0)
        return 0;
    free_parts(cell, of_cell);
    memset(cell, 0, sizeof *cell);
    return bad;
}
