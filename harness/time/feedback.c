/* Loads with feedback in motions: their factors, the integrals of their errors, their tangents. */
#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

status feedback_begin(const equations *eq, fault *f)
{
    const scene *s = model_scene(eq->m);
    if (!scene_has_feedback(s) || eq->run->feedback != NULL)
        return STATUS_OK;
    eq->run->feedback = calloc((size_t)s->loads, sizeof *eq->run->feedback);
    return eq->run->feedback != NULL ? STATUS_OK
                                     : fault_set(f, STATUS_FAULT, "out of memory for feedback");
}

int feedback_count(const equations *eq)
{
    return eq->run->feedback != NULL ? model_scene(eq->m)->loads : 0;
}

/* Derivative of component k of the rotation vector with respect to spatial increments. */
static void turn_row(const model *m, const model_state *s, int node, int k, double row[3])
{
    double t[3], inverse[9];
    for (int i = 0; i < 3; i++)
        t[i] = kinematics_component(m, s, node, SCENE_RX + i);
    turning_inverse(t, inverse); /* of rates in the node's axes; transposed: in fixed axes */
    for (int i = 0; i < 3; i++)
        row[i] = inverse[3 * i + k];
}

static double rate_at(const model *m, const model_state *s, const double v[], int node,
                      int component)
{
    frame_rates at;
    double row[3];
    if (node == SCENE_NONE)
        return 0;
    vertex_rates(m, s, node, v, NULL, &at);
    if (component < SCENE_RX)
        return at.v[component];
    turn_row(m, s, node, component - SCENE_RX, row);
    return vec3_dot(row, at.w);
}

static double component_at(const model *m, const model_state *s, int node, int component)
{
    return node == SCENE_NONE ? 0 : kinematics_component(m, s, node, component);
}

/* The reference and its rate. */
static void reference_of(const scene_load *load, double time, double out[3])
{
    out[0] = out[1] = 0;
    if (load->function.pieces > 0)
        function_at(&load->function, time, out);
}

static double error_of(const model *m, const model_state *s, const scene_load *load, double time)
{
    const scene_feedback *b = &load->feedback;
    double reference[3];
    reference_of(load, time, reference);
    return reference[0] -
           (component_at(m, s, b->node, b->component) - component_at(m, s, b->from, b->component));
}

/* Before the limit. */
static double feedback_of(const model *m, const model_state *s, const scene_load *load, int index,
                          const double v[], double time)
{
    const scene_feedback *b = &load->feedback;
    double sum = b->proportional * error_of(m, s, load, time) + b->integral * s->feedback[index];
    if (b->derivative != 0 && v != NULL) {
        double reference[3];
        reference_of(load, time, reference);
        sum += b->derivative * (reference[1] - (rate_at(m, s, v, b->node, b->component) -
                                                rate_at(m, s, v, b->from, b->component)));
    }
    return sum;
}

void feedback_take(const equations *eq, const model_state *s, const double v[], double time)
{
    for (int i = 0; i < feedback_count(eq); i++) {
        const scene_load *load = &model_scene(eq->m)->load[i];
        const scene_feedback *b = &load->feedback;
        if (b->node == SCENE_NONE)
            continue;
        const double factor = feedback_of(eq->m, s, load, i, v, time);
        eq->run->feedback[i] = b->limit > 0 ? fmax(-b->limit, fmin(b->limit, factor)) : factor;
    }
}

void feedback_errors(const equations *eq, const model_state *s, double time, double out[])
{
    for (int i = 0; i < feedback_count(eq); i++) {
        const scene_load *load = &model_scene(eq->m)->load[i];
        out[i] = load->feedback.node != SCENE_NONE ? error_of(eq->m, s, load, time) : 0;
    }
}

void feedback_integrate(const equations *eq, const model_state *from, const model_state *now,
                        const feedback_step *step, double out[])
{
    for (int i = 0; i < feedback_count(eq); i++) {
        const scene_load *load = &model_scene(eq->m)->load[i];
        if (load->feedback.node != SCENE_NONE)
            out[i] = from->feedback[i] + step->h / 2 *
                                             (error_of(eq->m, from, load, step->begin) +
                                              error_of(eq->m, now, load, step->end));
    }
}

/* Derivative of the measured component with respect to coordinates; returns their number. */
static int measure(const model *m, const model_state *s, int node, int component, int index[],
                   double out[])
{
    double T[6 * KINEMATICS_MOST], row[3];
    const int n = kinematics_node_jacobian(m, s, node, KINEMATICS_MOST, index, T);
    if (component >= SCENE_RX)
        turn_row(m, s, node, component - SCENE_RX, row);
    for (int k = 0; k < n; k++)
        out[k] = component < SCENE_RX
                     ? T[component * n + k]
                     : row[0] * T[3 * n + k] + row[1] * T[4 * n + k] + row[2] * T[5 * n + k];
    return n;
}

/* Generalised load for the factor 1; returns the number of coordinates. */
static int direction_of(const model *m, const model_state *s, const scene_load *load, int index[],
                        double out[])
{
    double T[6 * KINEMATICS_MOST], F[6] = {0}, moment[3], at[3], vector[3], q[4];
    const int n = kinematics_node_jacobian(m, s, load->where, KINEMATICS_MOST, index, T);
    double place[3];
    kinematics_frame(m, s, load->where, place, q);
    memcpy(vector, load->vector, sizeof vector);
    if (load->follower)
        rotation_apply(q, load->vector, vector);
    memcpy(F + (scene_load_turns(load) ? 3 : 0), vector, sizeof vector);
    rotation_apply(q, load->at, at);
    vec3_cross(at, F, moment);
    for (int i = 0; i < 3; i++)
        F[3 + i] += moment[i];
    for (int k = 0; k < n; k++) {
        out[k] = 0;
        for (int i = 0; i < 6; i++)
            out[k] += T[i * n + k] * F[i];
    }
    return n;
}

void feedback_tangent(const equations *eq, const model_state *s, const feedback_gains *gains,
                      feedback_entry *take, void *to)
{
    const model *m = eq->m;
    for (int i = 0; i < feedback_count(eq); i++) {
        const scene_load *load = &model_scene(m)->load[i];
        const scene_feedback *b = &load->feedback;
        const int node[] = {b->node, b->from};
        const double u = eq->run->feedback[i], gain = b->proportional * gains->place +
                                                      b->derivative * gains->rate +
                                                      b->integral * gains->integral;
        if (b->node == SCENE_NONE || gain == 0 || (b->limit > 0 && fabs(u) >= b->limit))
            continue;
        int on[KINEMATICS_MOST], of[KINEMATICS_MOST];
        double push[KINEMATICS_MOST], slope[KINEMATICS_MOST];
        const int rows = direction_of(m, s, load, on, push);
        const double acts =
            scene_acting_factor(model_scene(m), eq->loading.acting, load->load_case);
        for (int k = 0; k < 2; k++) {
            const int columns =
                node[k] != SCENE_NONE ? measure(m, s, node[k], b->component, of, slope) : 0;
            for (int a = 0; a < rows; a++)
                for (int c = 0; c < columns; c++)
                    take(to, on[a], of[c], (k == 0 ? 1 : -1) * acts * gain * push[a] * slope[c]);
        }
    }
}
