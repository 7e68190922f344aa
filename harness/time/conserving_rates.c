/* Rates at the end of a step, of what has inertia and of what has none. */
#include <lapacke.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/carried_step.h"

enum { BALL = 3 };

/* N: onto the axes about which J[9] is zero; how many they are. */
static int null_space(const double J[9], double N[9])
{
    const double nothing = 1e-12;
    double A[9], value[3];
    int count = 0;
    memset(N, 0, 9 * sizeof *N);
    memcpy(A, J, sizeof A);
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', 3, A, 3, value); /* ascending; fails only for NAN */
    for (int k = 0; k < 3; k++) {
        if (value[k] > nothing * value[2])
            continue;
        count++;
        for (int i = 0; i < 9; i++)
            N[i] += A[3 * (i / 3) + k] * A[3 * (i % 3) + k];
    }
    return count;
}

static int turns_freely(const model *m, int vertex)
{
    int free = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ; c++)
        free += model_vertex(m, vertex)->coordinate[c] != NONE &&
                model_vertex(m, vertex)->coordinate[c] < model_unknowns(m);
    return free > 0;
}

status conserving_massless(conserving *s, fault *f)
{
    const model *m = s->of.c->model;
    int heavy = 0, turning = 0;
    for (int k = 0; k < s->of.masses->masses; k++) {
        const carried_mass *one = &s->of.masses->mass[k];
        double centre[3], J[9];
        carried_step_centre(m, one, centre, J);
        heavy += null_space(J, s->massless + (size_t)(9 * k)) < 3;
        turning += turns_freely(m, one->frame);
    }
    return heavy > 0 || turning == 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "no rotation has inertia, which the conserving scheme cannot do "
                           "without: take alpha or radau, or give the sections rotary inertia");
}

static double energy_of(const carried_mass *one, const carried_step *p, const double v[3],
                        const double W[3])
{
    return (one->mass * vec3_dot(v, v) + dense_quadratic(3, p->J, W)) / 2;
}

static int is_driven(const model *m, int vertex)
{
    for (int c = 0; c < 6; c++)
        if (model_vertex(m, vertex)->coordinate[c] >= model_unknowns(m))
            return 1;
    return 0;
}

double conserving_impulses(const conserving *s, const instant *from, double h, const instant *to)
{
    const model *m = s->of.c->model;
    double sum = 0;
    for (int k = 0; k < s->of.masses->masses && s->all > s->free; k++) {
        const carried_mass *one = &s->of.masses->mass[k];
        carried_step p;
        frame_rates r;
        double v[3], W[3], turned[3];
        if (!is_driven(m, one->frame))
            continue;
        carried_step_of(s, from, to->state, h, one, &p);
        forms_rates(m, to->state, one->frame, to->v, NULL, &r);
        vec3_cross(r.w, p.after, turned);
        mat3_transpose_mul_vec(r.R, r.w, W);
        for (int i = 0; i < 3; i++)
            v[i] = r.v[i] + turned[i];
        sum += energy_of(one, &p, v, W) - energy_of(one, &p, p.v1, p.W1);
    }
    return sum;
}

/* Of a sequence of angles: the rates whose angular velocity is nearest to w. */
static void angle_rates(const model *m, int vertex, instant *to, const double w[3])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const int n = v->angles;
    double b[3][3], square[9], rate[3];
    if (n == 0)
        return;
    kinematics_axes(m, to->state, vertex, b);
    for (int i = 0; i < n; i++) {
        rate[i] = vec3_dot(b[i], w);
        for (int k = 0; k < n; k++)
            square[i * n + k] = vec3_dot(b[i], b[k]);
    }
    if (n > 1) {
        int pivot[3];
        if (dense_lu_regular(n, square, pivot) != 0)
            return; /* two axes in one line */
        dense_lu_solve(n, 1, square, pivot, rate);
    }
    for (int k = 0; k < n; k++) {
        const int at = v->coordinate[SCENE_RX + k];
        if (at != NONE && at < model_unknowns(m))
            to->v[at] = rate[k];
    }
}

/* Rates without inertia would change their signs with every step: they become those of the mean.
 * N[9] projects turns onto those; NULL: there is no mass either. */
static void without_inertia(const carried_mass *one, const double N[9], carried_step *p)
{
    double mean[3], back[3];
    for (int i = 0; i < 3; i++) {
        mean[i] = (p->W0[i] + p->W1[i]) / 2 - p->W1[i];
        p->v1[i] = one->mass > 0 ? p->v1[i] : (p->v0[i] + p->v1[i]) / 2;
    }
    if (N != NULL)
        mat3_mul_vec(N, mean, back);
    else
        memcpy(back, mean, sizeof back);
    for (int i = 0; i < 3; i++)
        p->W1[i] += back[i];
}

/* Which of the coordinates that an end keeps to itself move its mass. */
static void heavy_ones(const model *m, const carried_mass *one, const carried_step *p,
                       const model_state *s, int heavy[6])
{
    const double nothing = 1e-12;
    double b[3][3];
    release_turn_axes(m, s, one->frame, b);
    for (int i = 0, turns = 0; i < 3; i++) {
        double body[3];
        heavy[i] = one->mass > 0;
        heavy[3 + i] = 0;
        if (model_vertex(m, one->frame)->coordinate[3 + i] == NONE)
            continue;
        mat3_transpose_mul_vec(p->R1, b[turns++], body);
        heavy[3 + i] = dense_quadratic(3, one->inertia, body) >
                       nothing * (one->inertia[0] + one->inertia[4] + one->inertia[8]);
    }
}

/* Masses of released ends go on with velocities of their own, so that these keep energy and momenta
 * as those of nodes do: they follow from the coordinates but for what is of second order in a step.
 */
static void conserving_released_rates(const conserving *s, const instant *from, double h,
                                      instant *to)
{
    const model *m = s->of.c->model;
    const carried_masses *all = s->of.masses;
    for (int k = 0; k < all->masses; k++) {
        const carried_mass *one = &all->mass[k];
        const int *at = model_vertex(m, one->frame)->coordinate;
        carried_step p;
        int heavy[6];
        if (one->frame < model_first_release(m))
            continue;
        carried_step_of(s, from, to->state, h, one, &p);
        without_inertia(one, s->massless + (size_t)(9 * k), &p);
        double *own = to->ends + 6 * (one->frame - model_first_release(m));
        memcpy(own, p.v1, sizeof p.v1);
        memcpy(own + 3, p.W1, sizeof p.W1);
        heavy_ones(m, one, &p, to->state, heavy);
        for (int c = 0; c < 6; c++)
            if (at[c] != NONE)
                to->v[at[c]] =
                    heavy[c] ? 2 * s->step[at[c]] / h - from->v[at[c]] : s->step[at[c]] / h;
        for (int c = 0; c < 3 && release_of(m, one->frame)->turns == BALL; c++)
            to->v[at[SCENE_RX + c]] = p.W1[c];
    }
    to->ends_known = 1;
}

/* Of frames with a mass by their centres, of the others by themselves. */
void conserving_rates(conserving *s, const instant *from, double h, instant *to)
{
    const model *m = s->of.c->model;
    const carried_masses *all = s->of.masses;
    for (int i = 0, k = 0; i < model_first_release(m); i++) {
        const carried_mass plain = {.frame = i};
        const int *at = model_vertex(m, i)->coordinate;
        while (k < all->masses && all->mass[k].frame < i)
            k++;
        const carried_mass *one =
            k < all->masses && all->mass[k].frame == i ? &all->mass[k] : &plain;
        if (model_vertex(m, i)->body != i)
            continue;
        carried_step p;
        double w[3], turned[3];
        carried_step_of(s, from, to->state, h, one, &p);
        without_inertia(one, one == &plain ? NULL : s->massless + (size_t)(9 * k), &p);
        mat3_mul_vec(p.R1, p.W1, w);
        vec3_cross(w, p.after, turned);
        for (int c = 0; c < 3; c++) {
            if (at[c] != NONE && at[c] < model_unknowns(m))
                to->v[at[c]] = p.v1[c] - turned[c];
            if (at[SCENE_RX + c] != NONE && at[SCENE_RX + c] < model_unknowns(m) &&
                model_vertex(m, i)->angles == 0)
                to->v[at[SCENE_RX + c]] = p.W1[c];
        }
        angle_rates(m, i, to, w);
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mean = s->step[c] / h;
        to->v[c] = all->warping[c] > 0 ? 2 * mean - from->v[c] : mean;
    }
    if (model_releases(m) > 0)
        conserving_released_rates(s, from, h, to);
    for (int c = 0; c < s->free; c++)
        to->a[c] = to->algorithm[c] = (to->v[c] - from->v[c]) / h;
}
