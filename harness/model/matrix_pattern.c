#include "harness/model/model_impl.h"

#include <stdlib.h>
#include <string.h>

/* Returns 1 if a spring is not symmetric. damped 1: also returns 1 if a dashpot is not
 * symmetric. */
static int has_unsymmetric(const model *m, int damped)
{
    for (int i = 0; i < m->scene->springs; i++)
        if (scene_spring_circulates(&m->scene->spring[i]) ||
            (damped && scene_spring_gyrates(&m->scene->spring[i])))
            return 1;
    return 0;
}

/* Returns 0 if there are dead moments about fixed axes (loads or reactions), follower loads,
 * unsymmetric springs or dashpots, or forces with a history. */
int assemble_symmetric(const model *m)
{
    int whole = has_unsymmetric(m, 1) || model_absolute(m);
    for (int i = 0; i < m->scene->nodes; i++)
        whole |= coordinates_held_turn(m, i) != NONE;
    for (int i = 0; i < m->scene->loads; i++)
        whole |= scene_load_unsymmetric(&m->scene->load[i]);
    return !whole;
}

/* Returns 1 if the entry of two coordinates is stored: both belong to the matrix and, in a
 * symmetric matrix, the entry is not below the diagonal. */
static int stored(const mesh_pattern *p, int row, int column)
{
    return row >= 0 && column >= 0 && row < p->matrix.n && column < p->matrix.n &&
           (!p->matrix.symmetric || row <= column);
}

void assemble_subtract(sparse *K, int row, int column, double value)
{
    if (row < 0 || column < 0 || row >= K->n || column >= K->n || (K->symmetric && row > column))
        return;
    const int position = sparse_position(K, row, column);
    if (position >= 0)
        K->value[position] -= value;
}

void assemble_add_block(sparse *K, int rows, const int row[], int columns, const int column[],
                        const double block[])
{
    for (int j = 0; j < columns; j++) {
        if (column[j] < 0 || column[j] >= K->n)
            continue;
        const int end = K->column[column[j] + 1];
        int next = end; /* entry after the previous one, which is often the one of the next row */
        for (int i = 0; i < rows; i++) {
            if (row[i] < 0 || row[i] >= K->n || (K->symmetric && row[i] > column[j]))
                continue;
            const int at =
                next < end && K->row[next] == row[i] ? next : sparse_position(K, row[i], column[j]);
            if (at >= 0)
                K->value[at] += block[columns * i + j];
            next = at >= 0 ? at + 1 : end;
        }
    }
}

static size_t collect_of(const mesh_element *el, const mesh_pattern *p, size_t count, int row[],
                         int column[])
{
    for (int a = 0; a < el->columns; a++)
        for (int b = 0; b < el->columns; b++) {
            if (!stored(p, el->index[a], el->index[b]))
                continue;
            if (row != NULL) {
                row[count] = el->index[a];
                column[count] = el->index[b];
            }
            count++;
        }
    return count;
}

static size_t collect_nodes(const model *m, const mesh_pattern *p, const int node[2], size_t count,
                            int row[], int column[])
{
    int on[KINEMATICS_MOST], of[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    const int rows = kinematics_node_jacobian(m, NULL, node[0], KINEMATICS_MOST, on, T),
              columns = kinematics_node_jacobian(m, NULL, node[1], KINEMATICS_MOST, of, T);
    for (int a = 0; a < rows; a++)
        for (int c = 0; c < columns; c++) {
            if (!stored(p, on[a], of[c]))
                continue;
            if (row != NULL) {
                row[count] = on[a];
                column[count] = of[c];
            }
            count++;
        }
    return count;
}

static size_t collect_loads(const model *m, const mesh_pattern *p, size_t count, int row[],
                            int column[])
{
    for (int i = 0; i < m->scene->loads; i++) {
        const scene_load *load = &m->scene->load[i];
        const int on[] = {load->where, load->towards},
                  of[] = {load->feedback.node, load->feedback.from};
        for (int a = 0; a < 2; a++) {
            for (int b = 0; b < 2 && load->towards != SCENE_NONE; b++)
                count = collect_nodes(m, p, (const int[]){on[a], on[b]}, count, row, column);
            for (int b = 0; b < 2 && load->feedback.node != SCENE_NONE && !p->matrix.symmetric; b++)
                if (on[a] != SCENE_NONE && of[b] != SCENE_NONE)
                    count = collect_nodes(m, p, (const int[]){on[a], of[b]}, count, row, column);
        }
    }
    return count;
}

/* Returns the number of pairs of coordinates that elements, springs, bodies and loads couple,
 * including repetitions. */
static size_t collect(const model *m, const mesh_pattern *p, int row[], int column[])
{
    size_t count = 0;
    for (int i = 0; i < m->mesh.elements; i++)
        count = collect_of(&m->mesh.element[i], p, count, row, column);
    for (int i = 0; i < m->mesh.discretes; i++)
        count = collect_of(&m->mesh.discrete[i].el, p, count, row, column);
    return collect_loads(m, p, count, row, column);
}

/* Sets begin[n + 1], the starts of n lists into which pairs are sorted by their index. */
static void begin_lists(size_t pairs, const int index[], int n, int begin[])
{
    memset(begin, 0, ((size_t)n + 1) * sizeof *begin);
    for (size_t i = 0; i < pairs; i++)
        begin[index[i] + 1]++;
    for (int i = 0; i < n; i++)
        begin[i + 1] += begin[i];
}

typedef struct pairs {
    size_t count;
    int *row, *column, *by_row;
    int *begin, *end; /* [n + 1] starts of the lists of rows; ends of lists so far */
} pairs;

static void sort_pairs(const pairs *all, sparse *out)
{
    const int n = out->n;
    begin_lists(all->count, all->row, n, all->begin);
    memcpy(all->end, all->begin, (size_t)n * sizeof *all->end);
    for (size_t i = 0; i < all->count; i++)
        all->by_row[all->end[all->row[i]]++] = all->column[i];
    begin_lists(all->count, all->column, n, out->column);
    memcpy(all->end, out->column, (size_t)n * sizeof *all->end);
    for (int i = 0; i < n; i++)
        for (int k = all->begin[i]; k < all->begin[i + 1]; k++) {
            int *end = &all->end[all->by_row[k]];
            if (*end == out->column[all->by_row[k]] || out->row[*end - 1] != i)
                out->row[(*end)++] = i;
        }
    for (int j = 0, entries = 0; j < n; j++) {
        const int begin = out->column[j];
        out->column[j] = entries;
        for (int k = begin; k < all->end[j]; k++)
            out->row[entries++] = out->row[k];
        if (j + 1 == n)
            out->column[n] = entries;
    }
}

static status compress(const model *m, mesh_pattern *p, fault *f)
{
    const size_t n = (size_t)p->matrix.n + 1, count = collect(m, p, NULL, NULL);
    int *work = malloc((3 * count + 2 * n) * sizeof *work);
    p->matrix.column = malloc(n * sizeof *p->matrix.column);
    p->matrix.row = malloc((count + 1) * sizeof *p->matrix.row);
    const int good = work != NULL && p->matrix.column != NULL && p->matrix.row != NULL;
    if (good) {
        const pairs all = {
            count, work, work + count, work + 2 * count, work + 3 * count, work + 3 * count + n};
        collect(m, p, all.row, all.column);
        sort_pairs(&all, &p->matrix);
    }
    free(work);
    return good ? STATUS_OK
                : fault_memory(f, "the matrix of a model with %d coordinates", p->matrix.n);
}

static int entries_of(const mesh_element *el, const mesh_pattern *p, mesh_entry entry[])
{
    const sparse *a = &p->matrix;
    int count = 0;
    for (int i = 0; i < el->columns; i++)
        for (int k = 0; k < el->columns; k++) {
            if (!stored(p, el->index[i], el->index[k]))
                continue;
            const int begin = a->column[el->index[k]];
            int at = begin;
            while (a->row[at] != el->index[i])
                at++;
            entry[count++] = (mesh_entry){(short)(i * el->columns + k), (short)k, at - begin};
        }
    return count;
}

/* Returns the layout with these entries if it is among the last layouts that were stored, otherwise
 * NONE. */
static int find_layout(const mesh_pattern *p, int entries, const mesh_entry entry[])
{
    const int looked_at = 16;
    for (int i = p->layouts - 1; i >= 0 && i >= p->layouts - looked_at; --i)
        if (p->layout[i].entries == entries &&
            memcmp(p->layout[i].entry, entry, (size_t)entries * sizeof *entry) == 0)
            return i;
    return NONE;
}

static status add_layout(mesh_pattern *p, int entries, const mesh_entry entry[], fault *f)
{
    mesh_layout one = {entries, malloc(((size_t)entries + 1) * sizeof *entry)};
    if (one.entry == NULL)
        return fault_memory(f, "the positions of matrix entries");
    memcpy(one.entry, entry, (size_t)entries * sizeof *entry);
    const status outcome = memory_append(&p->layout, &p->layouts, &one, sizeof one,
                                         "the positions of matrix entries", f);
    if (outcome != STATUS_OK)
        free(one.entry);
    return outcome;
}

static status find_places(const model *m, mesh_pattern *p, fault *f)
{
    mesh_entry entry[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
    p->element = m->mesh.element;
    p->layout_of = malloc(((size_t)m->mesh.elements + 1) * sizeof *p->layout_of);
    if (p->layout_of == NULL)
        return fault_memory(f, "the matrix of a model with %d coordinates", p->matrix.n);
    for (int i = 0; i < m->mesh.elements; i++) {
        const int entries = entries_of(&m->mesh.element[i], p, entry);
        p->layout_of[i] = find_layout(p, entries, entry);
        if (p->layout_of[i] != NONE)
            continue;
        TRY(add_layout(p, entries, entry, f));
        p->layout_of[i] = p->layouts - 1;
    }
    return STATUS_OK;
}

static void pattern_free(mesh_pattern *p)
{
    free(p->matrix.column);
    free(p->matrix.row);
    for (int i = 0; i < p->layouts; i++)
        free(p->layout[i].entry);
    free(p->layout);
    free(p->layout_of);
    factor_free(p->analysed);
    memset(p, 0, sizeof *p);
}

static status fill_pattern(const model *m, mesh_pattern *p, fault *f)
{
    TRY(compress(m, p, f));
    return find_places(m, p, f);
}

enum { FREE, WITH_DRIVEN, IN_TIME, WHOLE, WHOLE_WITH_DRIVEN, PATTERNS };
struct assemble_patterns {
    mesh_pattern pattern[PATTERNS];
};

status assemble_patterns_alloc(assemble_patterns **out, fault *f)
{
    *out = calloc(1, sizeof **out);
    return *out != NULL ? STATUS_OK : fault_memory(f, "patterns");
}

void assemble_patterns_free(assemble_patterns *all)
{
    for (int i = 0; i < PATTERNS && all != NULL; i++)
        pattern_free(&all->pattern[i]);
    free(all);
}

static status make(const model *m, assemble_patterns *all, int which, const sparse **out, fault *f)
{
    mesh_pattern *p = &all->pattern[which];
    *out = &p->matrix;
    if (p->made)
        return STATUS_OK;
    const int with_driven = which == WITH_DRIVEN || which == WHOLE_WITH_DRIVEN;
    p->matrix.n = with_driven ? m->mesh.free + m->mesh.driven : m->mesh.free;
    p->matrix.symmetric = which <= WITH_DRIVEN;
    p->matrix.by_numbers = which >= WHOLE;
    const status outcome = fill_pattern(m, p, f);
    p->made = outcome == STATUS_OK;
    if (!p->made)
        pattern_free(p);
    return outcome;
}

status assemble_pattern(const model *m, assemble_patterns *all, int with_driven, const sparse **out,
                        fault *f)
{
    return make(m, all, with_driven ? WITH_DRIVEN : FREE, out, f);
}

status assemble_pattern_of_states(const model *m, assemble_patterns *all, int with_driven,
                                  const sparse **out, fault *f)
{
    if (assemble_symmetric(m))
        return assemble_pattern(m, all, with_driven, out, f);
    return make(m, all, with_driven ? WHOLE_WITH_DRIVEN : WHOLE, out, f);
}

status assemble_pattern_whole(const model *m, assemble_patterns *all, int with_driven,
                              const sparse **out, fault *f)
{
    return make(m, all, with_driven ? WHOLE_WITH_DRIVEN : WHOLE, out, f);
}

status assemble_pattern_at_rest(const model *m, assemble_patterns *all, int damped, int with_driven,
                                const sparse **out, fault *f)
{
    return has_unsymmetric(m, damped) ? assemble_pattern_of_states(m, all, with_driven, out, f)
                                      : assemble_pattern(m, all, with_driven, out, f);
}

status assemble_pattern_in_time(const model *m, assemble_patterns *all, const sparse **out,
                                fault *f)
{
    return make(m, all, IN_TIME, out, f);
}

const mesh_pattern *assemble_of(const assemble_patterns *all, const sparse *a)
{
    for (int i = WITH_DRIVEN; i <= WHOLE_WITH_DRIVEN; i++)
        if (all->pattern[i].made && all->pattern[i].matrix.row == a->row)
            return &all->pattern[i];
    return &all->pattern[FREE];
}

status assemble_factor(assemble_patterns *all, const sparse *a, matrix_factor **out, fault *f)
{
    mesh_pattern *p = &all->pattern[assemble_of(all, a) - all->pattern];
    if (!a->symmetric)
        return factor_alloc(a, out, f);
    if (p->analysed == NULL) {
        const status outcome = factor_alloc(a, &p->analysed, f);
        if (outcome != STATUS_OK) {
            factor_free(p->analysed);
            p->analysed = NULL;
            return outcome;
        }
    }
    return factor_alloc_like(p->analysed, a, out, f);
}

void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out)
{
    const mesh_layout *layout = &p->layout[p->layout_of[element]];
    const int *index = p->element[element].index;
    for (int i = 0; i < layout->entries; i++) {
        const mesh_entry *e = &layout->entry[i];
        out->value[out->column[index[e->column]] + e->offset] += K[e->local];
    }
}

void assemble_discrete(const mesh_element *el, const double K[], sparse *out)
{
    const int n = el->columns;
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const int row = el->index[a], column = el->index[b];
            if (row != NONE && column != NONE && row < out->n && column < out->n &&
                (!out->symmetric || row <= column))
                out->value[sparse_position(out, row, column)] += K[n * a + b];
        }
}

void assemble_vector(const mesh_element *el, const double local[], double out[])
{
    for (int i = 0; i < el->columns; i++)
        if (el->index[i] != NONE)
            out[el->index[i]] += local[i];
}
