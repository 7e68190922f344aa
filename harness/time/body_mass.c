#include "harness/time/body_mass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/time/inertia.h"
#include "harness/time/released.h"
#include "harness/time/spread.h"

/* Rank of A[n x n], positive semidefinite, in which `none` is zero; destroys A. */
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

static double add_mass(const model *m, const carried_masses *all, int index, const model_state *s,
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

/* Of an element that spreads its mass: at the nodes that the body moves and the ends released from
 * it, not between these and others. What is missing here is missing in the whole matrix. */
static double add_element(const model *m, int element, int body, const model_state *s,
                          const body_mass *g)
{
    const mesh_element *el = model_element(m, element);
    spread_motion by[ELEMENT_MAX_NODES];
    double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES] = {0}, largest = 0;
    spread_parts p;
    int beside = 0;
    for (int k = 0; k < el->nodes; k++)
        beside |= model_vertex(m, el->vertex[k])->body == body;
    if (!beside)
        return 0;
    spread_masses(m, element, s, &p);
    spread_place(m, &p, by);
    spread_times(m, &p, p.acceleration, by, K);
    spread_rows(&p, K);
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

double body_mass_warps(const model *m, const carried_masses *all, int warp, const model_state *s)
{
    double mass = all->warping[model_warp(m, warp)];
    for (int i = 0; i < model_elements(m) && all->spread; i++)
        for (int k = 0; k < model_element(m, i)->nodes; k++) {
            const int at = NODE_COORDINATES * k + 6;
            spread_parts p;
            if (model_element(m, i)->warp[k] != warp)
                continue;
            spread_masses(m, i, s, &p);
            mass += p.acceleration[model_own_coordinates(m) * at + at];
        }
    return mass;
}

double body_mass_of(const model *m, const carried_masses *all, int body, const model_state *s,
                    body_mass *g)
{
    double largest = 0;
    g->count = 0;
    take_vertex(m, body, g);
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        if (model_vertex(m, i)->body == body)
            take_vertex(m, i, g);
    memset(g->M, 0, (size_t)(g->count * g->count) * sizeof *g->M);
    for (int k = 0; k < all->masses; k++)
        if (model_vertex(m, all->mass[k].frame)->body == body)
            largest = fmax(largest, add_mass(m, all, k, s, g));
    for (int i = 0; i < model_elements(m) && all->spread; i++)
        largest = fmax(largest, add_element(m, i, body, s, g));
    return largest;
}

/* Most ends that are released from one body. */
static int most_ends(const model *m, int ends[])
{
    int most = 0;
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        if (++ends[model_vertex(m, i)->body] > most)
            most = ends[model_vertex(m, i)->body];
    return most;
}

status body_mass_alloc(const model *m, body_mass *out, fault *f)
{
    int *ends = calloc((size_t)model_vertices(m) + 1, sizeof *ends);
    const size_t n = ends == NULL ? 0 : 6 + SCENE_RELEASED * (size_t)most_ends(m, ends);
    free(ends);
    memset(out, 0, sizeof *out);
    out->index = calloc(2 * n + 1, sizeof *out->index);
    out->M = calloc(2 * n * (n + 1) + (size_t)model_all_coordinates(m) + 1, sizeof *out->M);
    if (n == 0 || out->index == NULL || out->M == NULL) {
        body_mass_free(out);
        return fault_set(f, STATUS_FAULT, "out of memory for masses");
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
