#include "harness/time/time_impl.h"

#include "elements/math/vec3.h"

void inertia_swing_of(const model *m, const model_state *s, int vertex, const double v[],
                      const double a[], inertia_swing *out)
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    const int c = frame->coordinate[SCENE_RX];
    out->led = frame->led;
    if (!out->led)
        return;
    out->rate = c != NONE ? v[c] : 0;
    const double second = c != NONE && a != NULL ? a[c] : 0;
    kinematics_arm(m, s, vertex, out->moved);
    vec3_cross(frame->axis[0], out->moved, out->inward);
    for (int i = 0; i < 3; i++)
        out->change[i] = out->inward[i] * second - out->moved[i] * out->rate * out->rate;
}

void inertia_swing_column(const inertia_swing *by, int n, int at, const double A[],
                          const double C[], double rate, double place, double out[])
{
    for (int i = 0; i < n && by->led; i++)
        for (int k = 0; k < 3; k++) {
            const double turned = by->inward[k] * by->rate;
            out[i] += A[n * i + at + k] * (place * by->change[k] + 2 * rate * turned) +
                      place * C[n * i + at + k] * turned;
        }
}

void inertia_swing_row(const inertia_swing *by, int n, int at, const double force[3], double place,
                       double K[])
{
    for (int j = 0; j < n && by->led; j++)
        for (int k = 0; k < 3; k++)
            K[n * (at + 3) + j] += by->moved[k] * K[n * (at + k) + j];
    if (by->led)
        K[n * (at + 3) + at + 3] += place * vec3_dot(by->inward, force);
}
