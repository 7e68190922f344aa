/* Loads at the middle of a step: directions and arms that turn are the means of its ends. */
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/newton/newton.h"
#include "harness/time/place.h"

typedef struct loaded {
    conserving *s;
    const model_state *from, *now;
    double *out; /* [free + driven] */
} loaded;

/* (v_n + v)/2, and its derivative by the step's c: -1/2 v~ T_c. */
static void mean_of(const double back[9], const double T[9], const double v[3], double mean[3],
                    double change[9])
{
    double before[3], skew[9];
    mat3_mul_vec(back, v, before);
    cayley_skew(v, skew);
    mat3_mul(skew, T, change);
    for (int i = 0; i < 9; i++)
        change[i] *= -0.5;
    for (int i = 0; i < 3; i++)
        mean[i] = (before[i] + v[i]) / 2;
}

/* K[6 x 6] at (row, columns of c) -= A */
static void subtract_block(const double A[9], int row, double K[36])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[6 * (row + i) + 3 + j] -= A[3 * i + j];
}

/* K -= derivative of arm x force at (moment, columns of c): by[3 x 3] of each. */
static void subtract_lever(const double arm[3], const double by_arm[9], const double force[3],
                           const double by_force[9], double K[36])
{
    double skew[9], first[9], then[9];
    cayley_skew(force, skew);
    mat3_mul(skew, by_arm, first);
    cayley_skew(arm, skew);
    mat3_mul(skew, by_force, then);
    for (int i = 0; i < 9; i++)
        then[i] -= first[i];
    subtract_block(then, 3, K);
}

/* Force and moment F[6] of the mean, and K[6 x 6] = -dF by dr, c of the vertex. */
static void loads_middle_of(const loaded *of, const applied *what, const double c[3], double F[6],
                            double K[36])
{
    double R0[9], R1[9], back[9], T[9], arm[3], levered[3], by_force[9] = {0}, by[9];
    const size_t q = 4 * (size_t)what->vertex;
    memcpy(F, what->F, 6 * sizeof *F);
    cayley_tangent(c, T);
    rotation_matrix(of->from->q + q, R0);
    rotation_matrix(of->now->q + q, R1);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            back[3 * i + j] = vec3_dot(&R0[3 * i], &R1[3 * j]);
    if (what->follower) {
        mean_of(back, T, what->F + 3, F + 3, by);
        subtract_block(by, 3, K);
        mean_of(back, T, what->F, F, by_force);
        subtract_block(by_force, 0, K);
    }
    if (!what->offset)
        return;
    mean_of(back, T, what->arm, arm, by);
    subtract_lever(arm, by, F, by_force, K);
    vec3_cross(arm, F, levered);
    for (int i = 0; i < 3; i++)
        F[3 + i] += levered[i];
}

/* Onto the coordinates that move the vertex. */
static void take(void *context, const applied *what)
{
    const loaded *of = context;
    conserving *s = of->s;
    double dr[3], c[3], F[6], K[36] = {0};
    place_step(s, of->from, of->now, what->vertex, dr, c);
    loads_middle_of(of, what, c, F, K);
    place_add(s, of->from, of->now, what->vertex, F, K, of->out);
}

void conserving_loads(conserving *s, const instant *from, const model_state *now, double h,
                      double out[])
{
    const model *m = s->of.c->model;
    loaded of = {s, from->state, now, out};
    for (int i = 0; i < model_scene(m)->loads; i++)
        applied_each(m, now, &model_scene(m)->load[i],
                     applied_factor(&s->of.c->eq, &model_scene(m)->load[i], from->time + h / 2),
                     take, &of);
}
