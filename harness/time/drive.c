#include "harness/time/drive.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/turning.h"

status drive_check(const model *m, fault *f)
{
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_scene(m)->driver[d].value == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "driver %s is unknown: a motion in time takes known ones",
                             model_scene(m)->driver[d].name);
    return STATUS_OK;
}

/* A rotation by its vector t(time): W = Jr t', W' = Jr t'' + d(Jr t')/dt t'. */
static void drive_vector(const equations *eq, const model_state *from, int index, double time,
                         double inc[], double v[], double a[])
{
    const model *m = eq->m;
    const mesh_vertex *frame = model_vertex(m, index);
    double t[3], rate[3], second[3], Jr[9], D[9], W[3], Wd[3], more[3], q[4], to[4], back[4];
    for (int k = 0; k < 3; k++) {
        double at[3];
        loads_driver_rates(eq, &model_scene(m)->driver[frame->vector_driver[k]], time, at);
        t[k] = at[0];
        rate[k] = at[1];
        second[k] = at[2];
    }
    turning_jacobian(t, Jr);
    turning_derivative(t, rate, D);
    mat3_mul_vec(Jr, rate, W);
    mat3_mul_vec(Jr, second, Wd);
    mat3_mul_vec(D, rate, more);
    rotation_exp(t, to);
    rotation_conjugate(&from->q[4 * index], back);
    rotation_compose(back, to, q);
    rotation_log(q, t);
    for (int k = 0; k < 3; k++) {
        const int c = frame->coordinate[SCENE_RX + k];
        if (inc != NULL)
            inc[c] = t[k];
        if (v != NULL)
            v[c] = W[k];
        if (a != NULL)
            a[c] = Wd[k] + more[k];
    }
}

void drive_at(const equations *eq, const model_state *from, double time, double inc[], double v[],
              double a[])
{
    const model *m = eq->m;
    for (int c = model_unknowns(m); c < model_all_coordinates(m); c++) {
        if (inc != NULL)
            inc[c] = 0;
        if (v != NULL)
            v[c] = 0;
        if (a != NULL)
            a[c] = 0;
    }
    for (int d = 0; d < model_scene(m)->drivers; d++) {
        const int c = model_driver_coordinate(m, d);
        double at[3];
        if (c < model_unknowns(m))
            continue;
        loads_driver_rates(eq, &model_scene(m)->driver[d], time, at);
        if (inc != NULL)
            inc[c] = at[0] - from->driver[d];
        if (v != NULL)
            v[c] = at[1];
        if (a != NULL)
            a[c] = at[2];
    }
    for (int i = 0; i < model_scene(m)->nodes; i++)
        if (model_vertex(m, i)->vector_driver[0] != NONE && model_vertex(m, i)->body == i)
            drive_vector(eq, from, i, time, inc, v, a);
}
