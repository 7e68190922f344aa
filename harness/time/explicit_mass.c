#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/names.h"
#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/explicit_impl.h"
#include "harness/time/inertia.h"

/* Masses of the free coordinates of one frame: count, index[count], M[count x count]. */
static int block(const model *m, const carried_masses *masses, int index, const model_state *s,
                 const double v[], int of[6], double M[36])
{
    const int *at = model_vertex(m, masses->mass[index].frame)->coordinate;
    inertia_parts p;
    double K[36];
    int row[6], count = 0;
    inertia_frame(m, masses, index, s, v, NULL, &p);
    inertia_times(p.acceleration, 1, p.rate, K);
    inertia_rows(p.turn, K);
    for (int i = 0; i < 6; i++)
        if (at[i] != NONE && at[i] < model_unknowns(m)) {
            of[count] = at[i];
            row[count++] = i;
        }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            M[count * i + j] = K[6 * row[i] + row[j]];
    return count;
}

status explicit_accelerate(const model *m, const carried_masses *masses, const model_state *s,
                           const double v[], const double residual[], double a[], fault *f)
{
    for (int k = 0; k < masses->masses; k++) {
        int of[6], pivot[6];
        double M[36], b[6];
        const int n = block(m, masses, k, s, v, of, M);
        for (int i = 0; i < n; i++)
            b[i] = residual[of[i]];
        if (dense_lu_regular(n, M, pivot) != 0)
            return fault_set(f, STATUS_SINGULAR,
                             "%s: two angles of its rotation turn about one axis",
                             scene_called(model_scene(m), SCENE_NODES, masses->mass[k].frame).text);
        dense_lu_solve(n, 1, M, pivot, b);
        for (int i = 0; i < n; i++)
            a[of[i]] = b[i];
    }
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        if (c < model_unknowns(m))
            a[c] = residual[c] / masses->warping[c];
    }
    return STATUS_OK;
}

/* 1: no motion of the coordinates is without kinetic energy. */
static int is_heavy(int n, double M[])
{
    const double rounding = 1e-13;
    double size[6];
    for (int i = 0; i < n; i++)
        size[i] = sqrt(fmax(M[n * i + i], 0));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            M[n * i + j] = size[i] > 0 && size[j] > 0 ? M[n * i + j] / (size[i] * size[j]) : 0;
    if (dense_cholesky(n, M) != 0)
        return 0;
    for (int i = 0; i < n; i++)
        if (M[n * i + i] * M[n * i + i] < rounding)
            return 0;
    return 1;
}

static status refuse(const model *m, int vertex, const char *what, fault *f)
{
    scene_words whose = {"a node inside a member"};
    if (vertex < model_scene(m)->nodes)
        whose = scene_called(model_scene(m), SCENE_NODES, vertex);
    return fault_set(f, STATUS_REFUSED,
                     "integrator explicit: the %s of %s has no inertia, so that its acceleration "
                     "is not determined; give what has none a mass or an inertia (members: "
                     "do not omit rotary_inertia), or take alpha, conserving or radau",
                     what, whose.text);
}

static status check_vertex(const model *m, int index, const int heavy[], fault *f)
{
    const mesh_vertex *v = model_vertex(m, index);
    for (int c = 0; c < VERTEX_COORDINATES; c++)
        if (v->coordinate[c] != NONE && v->coordinate[c] < model_unknowns(m) &&
            !heavy[v->coordinate[c]])
            return refuse(m, index, c < SCENE_RX ? "place" : "rotation", f);
    return STATUS_OK;
}

/* Which free coordinates have inertia, whatever the others of their frame do. */
static void mark(const model *m, const carried_masses *masses, const double rest[], int heavy[])
{
    for (int k = 0; k < masses->masses; k++) {
        int of[6];
        double M[36];
        const int n = block(m, masses, k, kinematics_rest(m), rest, of, M);
        for (int i = 0; i < n; i++) {
            double some[36];
            /* the first i + 1 of them: where the last one adds nothing it has none */
            for (int r = 0; r <= i; r++)
                memcpy(&some[(i + 1) * r], &M[n * r], (size_t)(i + 1) * sizeof *some);
            heavy[of[i]] = is_heavy(i + 1, some);
        }
    }
    for (int w = 0; w < model_warps(m); w++)
        heavy[model_warp(m, w)] = masses->warping[model_warp(m, w)] > 0;
}

status explicit_check(const model *m, const carried_masses *masses, fault *f)
{
    const size_t all = (size_t)model_all_coordinates(m) + 1;
    if (model_releases(m) > 0)
        return fault_set(f, STATUS_REFUSED,
                         "integrator explicit: released ends of members have no inertia of their "
                         "own; alpha, conserving and radau take them");
    int *heavy = calloc(all, sizeof *heavy);
    double *rest = calloc(all, sizeof *rest);
    status outcome = heavy != NULL && rest != NULL
                         ? STATUS_OK
                         : fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    if (outcome == STATUS_OK)
        mark(m, masses, rest, heavy);
    for (int i = 0; i < model_vertices(m) && outcome == STATUS_OK; i++)
        if (model_vertex(m, i)->body == i)
            outcome = check_vertex(m, i, heavy, f);
    for (int w = 0; w < model_warps(m) && outcome == STATUS_OK; w++)
        if (model_warp(m, w) < model_unknowns(m) && !heavy[model_warp(m, w)])
            outcome =
                fault_set(f, STATUS_REFUSED,
                          "integrator explicit: warping has no inertia; alpha, conserving and "
                          "radau take what has none");
    free(heavy);
    free(rest);
    return outcome;
}
