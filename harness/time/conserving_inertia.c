/* Centres of mass move with dr_c = h (v_c + v_c1)/2, R_n^T c = h (W + W1)/2; forces act at the
 * centres' mean places. About a frame that only turns, the tensor of its mass is as constant as
 * about the centre. */
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/carried_step.h"
#include "harness/time/place.h"
#include "harness/time/vertex_rates.h"

/* How many translations of a frame are held, and not all: those of the centre follow from its turn.
 */
static int held_of(const model *m, int frame, int held[3])
{
    int count = 0;
    for (int i = 0; i < 3 && frame < model_first_release(m); i++)
        count += held[i] = model_vertex(m, frame)->coordinate[i] == NONE;
    return count < 3 ? count : 0;
}

static int only_turns(const model *m, int frame)
{
    int held[3] = {0};
    return held_of(m, frame, held) == 0 && held[0];
}

void carried_step_centre(const model *m, const carried_mass *one, double centre[3], double J[9])
{
    if (only_turns(m, one->frame)) {
        memset(centre, 0, 3 * sizeof *centre);
        memcpy(J, one->inertia, 9 * sizeof *J);
        return;
    }
    const double mass = one->mass > 0 ? one->mass : 1;
    for (int i = 0; i < 3; i++)
        centre[i] = one->moment[i] / mass;
    const double square = vec3_dot(one->moment, centre);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[3 * i + j] =
                one->inertia[3 * i + j] - ((i == j ? square : 0) - one->moment[i] * centre[j]);
}

void carried_step_of(const conserving *s, const instant *from, const model_state *now, double h,
                     const carried_mass *one, carried_step *out)
{
    const model *m = s->of.c->model;
    double dr[3], swept[3], body[3], turned[3];
    frame_rates r;
    carried_step_centre(m, one, out->centre, out->J);
    out->rides = held_of(m, one->frame, out->held);
    inertia_rates(m, from->state, one->frame, from->v, NULL, &r);
    memcpy(out->Rn, r.R, sizeof r.R);
    rotation_matrix(&now->q[4 * one->frame], out->R1);
    mat3_mul_vec(out->Rn, out->centre, out->before);
    mat3_mul_vec(out->R1, out->centre, out->after);
    place_step(s, from->state, now, one->frame, dr, out->c);
    for (int i = 0; i < 3; i++)
        out->mean[i] = (out->before[i] + out->after[i]) / 2;
    vec3_cross(r.w, out->before, turned);
    vec3_cross(out->c, out->mean, swept);
    mat3_transpose_mul_vec(out->Rn, r.w, out->W0);
    mat3_transpose_mul_vec(out->Rn, out->c, body);
    for (int i = 0; i < 3; i++)
        out->v0[i] = r.v[i] + turned[i];
    if (one->frame >= model_first_release(m) && from->ends_known) {
        const double *own = from->ends + 6 * (one->frame - model_first_release(m));
        memcpy(out->v0, own, sizeof out->v0);
        memcpy(out->W0, own + 3, sizeof out->W0);
    }
    for (int i = 0; i < 3; i++) {
        out->v1[i] = 2 * (dr[i] + swept[i]) / h - out->v0[i];
        out->W1[i] = 2 * body[i] / h - out->W0[i];
    }
    carried_step_follow(one, out);
}

/* Force and moment on the frame. */
static void forces_of(const carried_mass *one, const carried_step *p, double h, double F[6])
{
    double H0[3], H1[3], spun0[3], spun1[3], lever[3];
    mat3_mul_vec(p->J, p->W0, H0);
    mat3_mul_vec(p->J, p->W1, H1);
    mat3_mul_vec(p->Rn, H0, spun0);
    mat3_mul_vec(p->R1, H1, spun1);
    for (int i = 0; i < 3; i++)
        F[i] = one->mass * (p->v1[i] - p->v0[i]) / h;
    vec3_cross(p->mean, F, lever);
    for (int i = 0; i < 3; i++)
        F[3 + i] = (spun1[i] - spun0[i]) / h + lever[i] + (p->rides ? p->late[i] : 0);
}

/* K[6 x 6] by dr and c. */
static void tangent_of(const carried_mass *one, const carried_step *p, double h, const double F[6],
                       double K[36])
{
    const double b = 2 / (h * h);
    double T[9], A[9], swept[9], sway[9], RJ[9], RJR[9], H1[3], spun[3], turn[9], mean[9], lever[9],
        force[9], more[9];
    cayley_tangent(p->c, T);
    cayley_skew(p->after, A);
    mat3_mul(A, T, swept); /* minus d(centre)/dc */
    mat3_mul(p->R1, p->J, RJ);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            RJR[3 * i + j] = vec3_dot(&RJ[3 * i], &p->Rn[3 * j]);
    mat3_mul_vec(p->J, p->W1, H1);
    mat3_mul_vec(p->R1, H1, spun);
    cayley_skew(spun, A);
    mat3_mul(A, T, turn);
    cayley_skew(p->mean, mean);
    carried_step_sway(p, h, T, swept, sway);
    mat3_mul(mean, sway, lever);
    cayley_skew(F, force);
    mat3_mul(force, swept, more);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int k = 3 * i + j;
            K[6 * i + j] = i == j ? one->mass * b : 0;
            K[6 * i + 3 + j] = -one->mass * b * sway[k];
            K[6 * (3 + i) + j] = one->mass * b * mean[k];
            K[6 * (3 + i) + 3 + j] =
                b * RJR[k] - turn[k] / h - one->mass * b * lever[k] + more[k] / 2;
        }
    carried_step_late(one, p, h, T, sway, K);
}

void conserving_inertia(conserving *s, const instant *from, const model_state *now, double h)
{
    const model *m = s->of.c->model;
    const carried_masses *all = s->of.masses;
    for (int k = 0; k < all->masses; k++) {
        const carried_mass *one = &all->mass[k];
        carried_step p;
        double F[6], K[36];
        carried_step_of(s, from, now, h, one, &p);
        forces_of(one, &p, h, F);
        tangent_of(one, &p, h, F, K);
        for (int i = 0; i < 6; i++)
            F[i] = -F[i];
        place_add(s, from->state, now, one->frame, F, K, s->residual);
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mass = all->warping[c];
        s->residual[c] -= mass * (2 * s->step[c] / h - 2 * from->v[c]) / h;
        assemble_subtract(&s->S, c, c, -2 * mass / (h * h));
    }
}
