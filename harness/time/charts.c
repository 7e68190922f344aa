#include "harness/time/charts.h"

#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/forms.h"
#include "harness/time/turning.h"

static void unit_matrix(double A[9])
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(A, one, sizeof one);
}

void inertia_turn(const model *m, int vertex, const model_state *s, const double inc[], double E[9])
{
    double R[9], N[9];
    rotation_matrix(&s->q[4 * vertex], R);
    inertia_chart(m, vertex, inc, R, N);
    mat3_mul(R, N, E);
}

void inertia_chart(const model *m, int vertex, const double inc[], const double R[9], double N[9])
{
    double at[3], inverse[9];
    unit_matrix(N);
    if (forms_of(m, vertex) != FORM_BODY)
        return;
    for (int i = 0; i < 3; i++)
        at[i] = inc[model_vertex(m, vertex)->coordinate[SCENE_RX + i]];
    turning_inverse(at, inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            N[3 * i + j] = vec3_dot(&inverse[3 * i], &R[3 * j]);
}

void inertia_turns(const model *m, const model_state *s, int vertex, double turn[9], double rate[9])
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3];
    unit_matrix(turn);
    rotation_matrix(&s->q[4 * vertex], rate);
    if (frame->angles == 0)
        return;
    kinematics_axes(m, s, vertex, b);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turn[3 * i + k] = rate[3 * i + k] = k < frame->angles ? b[k][i] : 0;
}
