#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lists the free coordinates to which masses couple a coordinate, in ascending order. Returns their
 * number. */
static int coupled(const model *m, const int frame_of[], const double warping[], int c, int list[6])
{
    int count = 0;
    if (frame_of[c] == NONE) {
        list[0] = c;
        return warping[c] > 0;
    }
    for (int p = 0; p < 6; p++) {
        const int other = model_vertex(m, frame_of[c])->coordinate[p];
        if (other == NONE || other >= model_unknowns(m))
            continue;
        int at = count++;
        for (; at > 0 && list[at - 1] > other; at--)
            list[at] = list[at - 1];
        list[at] = other;
    }
    return count;
}

/* Sets the columns of stage k, one after the other. Returns the number of entries; row NULL: only
 * this number. */
static int fill(const equations *eq, const sparse *single, const int frame_of[],
                const frame_masses *masses, stages_matrix *out, int *row)
{
    const model *m = eq->m;
    const int n = out->n, full = model_releases(m) > 0 || eq->run->damping != NULL ||
                                 masses->spread || /* consistent masses couple nodes */
                                 model_mesh_of(m)->joined != NULL;
    const double *warping = masses->warping;
    int count = 0;
    for (int k = 0; k < STAGES; k++)
        for (int c = 0; c < n; c++) {
            int list[6];
            const int beside = coupled(m, frame_of, warping, c, list);
            if (row != NULL)
                out->whole.column[k * n + c] = count;
            for (int i = 0; i < STAGES; i++) {
                const int entries =
                    i == k || full ? single->column[c + 1] - single->column[c] : beside;
                const int *rows = i == k || full ? single->row + single->column[c] : list;
                if (row != NULL && i == k)
                    out->diagonal[k * n + c] = count;
                for (int e = 0; row != NULL && e < entries; e++)
                    row[count + e] = i * n + rows[e];
                count += entries;
            }
        }
    if (row != NULL)
        out->whole.column[STAGES * n] = count;
    return count;
}

static status make(const equations *eq, const frame_masses *masses, const sparse *single,
                   int frame_of[], stages_matrix *out, fault *f)
{
    const model *m = eq->m;
    for (int c = 0; c < model_unknowns(m); c++)
        frame_of[c] = NONE;
    for (int k = 0; k < masses->masses; k++)
        for (int p = 0; p < 6; p++) {
            const int c = model_vertex(m, masses->mass[k].frame)->coordinate[p];
            if (c != NONE && c < model_unknowns(m))
                frame_of[c] = masses->mass[k].frame;
        }
    const size_t count = (size_t)fill(eq, single, frame_of, masses, out, NULL),
                 columns = STAGES * (size_t)out->n;
    out->whole.n = STAGES * out->n;
    out->whole.column = malloc((columns + 1) * sizeof *out->whole.column);
    out->whole.row = malloc((count + 1) * sizeof *out->whole.row);
    out->whole.value = calloc(count + 1, sizeof *out->whole.value);
    out->diagonal = malloc((columns + 1) * sizeof *out->diagonal);
    if (out->whole.column == NULL || out->whole.row == NULL || out->whole.value == NULL ||
        out->diagonal == NULL)
        return fault_memory(f, "the stages of a step");
    fill(eq, single, frame_of, masses, out, out->whole.row);
    return STATUS_OK;
}

status stages_alloc(const equations *eq, const frame_masses *masses, const sparse *single,
                    stages_matrix *out, fault *f)
{
    const model *m = eq->m;
    memset(out, 0, sizeof *out);
    out->n = model_unknowns(m);
    int *frame_of = malloc(((size_t)model_unknowns(m) + 1) * sizeof *frame_of);
    const status outcome =
        frame_of != NULL ? make(eq, masses, single, frame_of, out, f) : fault_memory(f, "stages");
    free(frame_of);
    return outcome;
}

void stages_free(stages_matrix *s)
{
    free(s->whole.column);
    free(s->whole.row);
    free(s->whole.value);
    free(s->diagonal);
}

void stages_zero(stages_matrix *s)
{
    sparse_zero(&s->whole);
}

void stages_put(stages_matrix *s, int stage, const sparse *K)
{
    for (int c = 0; c < s->n; c++) {
        const int first = K->column[c], count = K->column[c + 1] - first;
        memcpy(s->whole.value + s->diagonal[stage * s->n + c], K->value + first,
               (size_t)count * sizeof *K->value);
    }
}

void stages_add_element(stages_matrix *s, int i, int k, const mesh_pattern *p, int element,
                        const double K[])
{
    const mesh_layout *layout = &p->layout[p->layout_of[element]];
    const int *index = p->element[element].index, *begin = p->matrix.column;
    for (int e = 0; e < layout->entries; e++) {
        const mesh_entry *one = &layout->entry[e];
        const int c = index[one->column];
        s->whole
            .value[s->whole.column[k * s->n + c] + i * (begin[c + 1] - begin[c]) + one->offset] +=
            K[one->local];
    }
}

void stages_add(stages_matrix *s, int i, int k, int row, int column, double value)
{
    if (row < 0 || column < 0 || row >= s->n || column >= s->n)
        return;
    assemble_subtract(&s->whole, i * s->n + row, k * s->n + column, -value);
}

void stages_add_block(stages_matrix *s, int i, int k, int count, const int index[],
                      const double block[])
{
    int row[MODEL_MAX_COORDINATES], column[MODEL_MAX_COORDINATES];
    for (int c = 0; c < count; c++) {
        const int inside = index[c] >= 0 && index[c] < s->n;
        row[c] = inside ? i * s->n + index[c] : NONE;
        column[c] = inside ? k * s->n + index[c] : NONE;
    }
    assemble_add_block(&s->whole, count, row, count, column, block);
}

/* Returns the rank of the positive semidefinite A[n x n], which is overwritten. Pivots up to `none`
 * count as zero. */
static int rank(int n, double A[], int used[], double none)
{
    int rank = 0;
    for (int k = 0; k < n; k++) {
        int most = -1;
        for (int i = 0; i < n; i++)
            if (!used[i] && (most < 0 || A[(n + 1) * i] > A[(n + 1) * most]))
                most = i;
        const double pivot = A[(n + 1) * most];
        if (pivot <= none)
            return rank;
        used[most] = 1;
        rank++;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n && !used[i]; j++)
                if (!used[j])
                    A[n * i + j] -= A[n * i + most] * A[n * most + j] / pivot;
    }
    return rank;
}

static int place_in(const body_mass *g, int coordinate)
{
    for (int k = 0; k < g->count; k++)
        if (g->index[k] == coordinate)
            return k;
    return NONE;
}

static void take_vertex(const model *m, int vertex, body_mass *g)
{
    for (int c = 0; c < 6; c++) {
        const int at = model_vertex(m, vertex)->coordinate[c];
        if (at == NONE || at >= model_unknowns(m) || place_in(g, at) != NONE)
            continue;
        g->unit[g->count] = c < SCENE_RX ? 1 : 1 / model_length(m);
        g->index[g->count++] = at;
    }
}

static void take(const body_mass *g, int row, int column, double mass)
{
    const int i = place_in(g, row), j = place_in(g, column);
    if (i != NONE && j != NONE)
        g->M[g->count * i + j] += mass * g->unit[i] * g->unit[j];
}

static double add_mass(const model *m, const frame_masses *all, int index, const model_state *s,
                       const body_mass *g)
{
    const int vertex = all->mass[index].frame;
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    inertia_parts p;
    released_masses of;
    double motion[6 * KINEMATICS_MOST], K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
    inertia_frame(m, all, index, s, g->zero, NULL, &p);
    released_columns(m, s, vertex, &of);
    released_motion(&of, 1, one, one, motion);
    released_project(&of, p.acceleration, motion, K);
    for (int i = 0; i < of.count; i++)
        for (int j = 0; j < of.count; j++)
            take(g, of.index[i], of.index[j], K[of.count * i + j]);
    return all->mass[index].mass;
}

static int first_of(const model *m, int vertex)
{
    return model_first_joined(m, model_vertex(m, vertex)->body);
}

/* Adds an element with consistent mass: the entries of the nodes that the body moves and of the
 * ends released from them. Returns the largest sum of the three translational masses of a node. */
static double add_element(const model *m, int element, int body, const model_state *s,
                          const body_mass *g)
{
    const mesh_element *el = model_element(m, element);
    consistent_mass_motion by[ELEMENT_MAX_NODES];
    double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES], largest = 0;
    consistent_mass_parts p;
    int beside = 0;
    for (int k = 0; k < el->nodes; k++)
        beside |= first_of(m, el->vertex[k]) == body;
    if (!beside)
        return 0;
    consistent_mass_masses(m, element, s, &p);
    consistent_mass_place(m, &p, by);
    memset(K, 0, (size_t)(p.columns * p.columns) * sizeof *K);
    consistent_mass_times(m, &p, p.acceleration, by, K);
    consistent_mass_rows(&p, K);
    for (int i = 0; i < p.columns; i++)
        for (int j = 0; j < p.columns; j++)
            take(g, el->index[i], el->index[j], K[p.columns * i + j]);
    for (int at = 0; at < model_own_coordinates(m); at += NODE_COORDINATES) {
        double sum = 0;
        for (int i = at; i < at + 3; i++)
            sum += p.acceleration[(model_own_coordinates(m) + 1) * i];
        largest = fmax(largest, sum);
    }
    return largest;
}

double body_mass_warps(const model *m, const frame_masses *all, int warp, const model_state *s)
{
    double mass = all->warping[model_warp(m, warp)];
    for (int i = 0; i < model_elements(m) && all->spread; i++)
        for (int k = 0; k < model_element(m, i)->nodes; k++) {
            const int at = NODE_COORDINATES * k + 6;
            consistent_mass_parts p;
            if (model_element(m, i)->warp[k] != warp)
                continue;
            consistent_mass_masses(m, i, s, &p);
            mass += p.acceleration[model_own_coordinates(m) * at + at];
        }
    return mass;
}

double body_mass_of(const model *m, const frame_masses *all, int body, const model_state *s,
                    body_mass *g)
{
    double largest = 0;
    g->count = 0;
    for (int i = body; i != NONE; i = model_next_joined(m, i))
        take_vertex(m, i, g);
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        if (first_of(m, i) == body)
            take_vertex(m, i, g);
    memset(g->M, 0, (size_t)(g->count * g->count) * sizeof *g->M);
    for (int k = 0; k < all->masses; k++)
        if (first_of(m, all->mass[k].frame) == body)
            largest = fmax(largest, add_mass(m, all, k, s, g));
    for (int i = 0; i < model_elements(m) && all->spread; i++)
        largest = fmax(largest, add_element(m, i, body, s, g));
    return largest;
}

static int most_coordinates(const model *m, int count[])
{
    int most = 0;
    for (int i = 0; i < model_vertices(m); i++) {
        const int released = i >= model_first_release(m), first = first_of(m, i);
        if (released || model_vertex(m, i)->body == i)
            count[first] += released ? SCENE_RELEASED : VERTEX_COORDINATES;
        most = count[first] > most ? count[first] : most;
    }
    return most;
}

status body_mass_alloc(const model *m, body_mass *out, fault *f)
{
    int *count = calloc((size_t)model_vertices(m) + 1, sizeof *count);
    const size_t n = count == NULL ? 0 : (size_t)most_coordinates(m, count);
    free(count);
    memset(out, 0, sizeof *out);
    out->index = calloc(2 * n + 1, sizeof *out->index);
    out->M = calloc(2 * n * (n + 1) + (size_t)model_all_coordinates(m) + 1, sizeof *out->M);
    if (n == 0 || out->index == NULL || out->M == NULL) {
        body_mass_free(out);
        return fault_memory(f, "masses");
    }
    out->used = out->index + n;
    out->rest = out->M + n * n;
    out->value = out->rest + n * n;
    out->unit = out->value + n;
    out->zero = out->unit + n;
    return STATUS_OK;
}

void body_mass_free(body_mass *g)
{
    free(g->index);
    free(g->M);
}

int body_mass_rank(body_mass *g, double none)
{
    const int n = g->count;
    memcpy(g->rest, g->M, (size_t)(n * n) * sizeof *g->rest);
    memset(g->used, 0, (size_t)n * sizeof *g->used);
    return rank(n, g->rest, g->used, none);
}
