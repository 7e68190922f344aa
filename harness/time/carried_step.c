/* Where a translation of a frame is held beside free ones, that of the centre follows from the
 * turn: it is (w x s) at both ends, whose mean is not that of the step, h (v_c + v_c1)/2 - dr_c =
 * h/4 c x g,   g = (R_n + R_1)/2 (W1 - W) x s. The moment g x m (v_c1 - v_c)/4 of the held
 * components does the work that is behind, so that the step gains the kinetic energy that it works
 * for. */
#include "harness/time/carried_step.h"

#include <string.h>

#include "elements/math/vec3.h"

void carried_step_follow(const carried_mass *one, carried_step *p)
{
    double w1[3], swept[3], change[3], crossed[3], before[3];
    if (!p->rides)
        return;
    mat3_mul_vec(p->R1, p->W1, w1);
    vec3_cross(w1, p->after, swept);
    for (int i = 0; i < 3; i++) {
        p->v1[i] = p->held[i] ? swept[i] : p->v1[i];
        p->behind[i] = p->held[i] ? one->mass * (p->v1[i] - p->v0[i]) / 4 : 0;
        change[i] = p->W1[i] - p->W0[i];
    }
    vec3_cross(change, p->centre, crossed);
    mat3_mul_vec(p->Rn, crossed, before);
    mat3_mul_vec(p->R1, crossed, p->turned);
    for (int i = 0; i < 3; i++)
        p->g[i] = (before[i] + p->turned[i]) / 2;
    vec3_cross(p->g, p->behind, p->late);
}

/* d(w1 x after)/dc */
static void riding(const carried_step *p, double h, const double T[9], const double swept[9],
                   double out[9])
{
    double w1[3], W[9], A[9], turn[9], spin[9], arm[9], moved[9];
    mat3_mul_vec(p->R1, p->W1, w1);
    cayley_skew(w1, W);
    mat3_mul(W, T, turn);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            spin[3 * i + j] = 2 / h * vec3_dot(&p->R1[3 * i], &p->Rn[3 * j]) - turn[3 * i + j];
    cayley_skew(p->after, A);
    mat3_mul(A, spin, arm);
    mat3_mul(W, swept, moved);
    for (int k = 0; k < 9; k++)
        out[k] = -arm[k] - moved[k];
}

void carried_step_sway(const carried_step *p, double h, const double T[9], const double swept[9],
                       double sway[9])
{
    double speed[9];
    memcpy(sway, swept, 9 * sizeof *sway);
    if (!p->rides)
        return;
    riding(p, h, T, swept, speed);
    for (int k = 0; k < 9; k++)
        if (p->held[k / 3])
            sway[k] = -h / 2 * speed[k];
}

/* dg/dc */
static void change_of(const carried_step *p, double h, const double T[9], double out[9])
{
    double A[9], both[9], by[9], turn[9];
    cayley_skew(p->centre, A);
    for (int i = 0; i < 9; i++)
        both[i] = (p->Rn[i] + p->R1[i]) / 2;
    mat3_mul(both, A, by);
    cayley_skew(p->turned, A);
    mat3_mul(A, T, turn);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = -2 / h * vec3_dot(&by[3 * i], &p->Rn[3 * j]) - turn[3 * i + j] / 2;
}

void carried_step_late(const carried_mass *one, const carried_step *p, double h, const double T[9],
                       const double sway[9], double K[36])
{
    double dg[9], behind[9], A[9], first[9], then[9];
    if (!p->rides)
        return;
    change_of(p, h, T, dg);
    for (int k = 0; k < 9; k++)
        behind[k] = p->held[k / 3] ? -one->mass / (2 * h) * sway[k] : 0;
    cayley_skew(p->behind, A);
    mat3_mul(A, dg, first);
    cayley_skew(p->g, A);
    mat3_mul(A, behind, then);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[6 * (3 + i) + 3 + j] += then[3 * i + j] - first[3 * i + j];
}
