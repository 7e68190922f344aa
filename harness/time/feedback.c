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
    return eq->run->feedback != NULL ? STATUS_OK : fault_memory(f, "feedback");
}

int feedback_count(const equations *eq)
{
    return eq->run->feedback != NULL ? model_scene(eq->m)->loads : 0;
}

/* Computes the derivative of component k of the rotation vector of a node with respect to its
 * spatial rotation increments. */
static void turn_row(const model *m, const model_state *s, int node, int k, double row[3])
{
    double t[3], inverse[9];
    for (int i = 0; i < 3; i++)
        t[i] = kinematics_component(m, s, node, SCENE_RX + i);
    rotation_rates_inverse(t, inverse);
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

/* Computes the reference value of the controller and its rate: out[0], out[1]. */
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

/* Computes the derivative of the measured component with respect to coordinates. Returns the number
 * of these coordinates. */
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

typedef struct feedback_push {
    const model *m;
    const model_state *s;
    int count, index[2 * KINEMATICS_MOST];
    double value[2 * KINEMATICS_MOST];
} feedback_push;

static void add_push(void *to, const applied *what)
{
    feedback_push *p = to;
    double T[6 * KINEMATICS_MOST], F[6], moment[3] = {0};
    const int n =
        kinematics_node_jacobian(p->m, p->s, what->vertex, KINEMATICS_MOST, p->index + p->count, T);
    memcpy(F, what->F, sizeof F);
    if (what->offset)
        vec3_cross(what->arm, what->F, moment);
    for (int k = 0; k < n; k++, p->count++) {
        p->value[p->count] = 0;
        for (int i = 0; i < 6; i++)
            p->value[p->count] += T[i * n + k] * (F[i] + (i < 3 ? 0 : moment[i - 3]));
    }
}

static void add_measured(const model *m, const model_state *s, int node, int component,
                         double times, double out[])
{
    int of[KINEMATICS_MOST];
    double slope[KINEMATICS_MOST];
    const int n = node != SCENE_NONE ? measure(m, s, node, component, of, slope) : 0;
    for (int k = 0; k < n; k++)
        out[of[k]] += times * slope[k];
}

void feedback_signals(const equations *eq, const model_state *s, int load, double push[],
                      double measured[])
{
    const scene_load *l = &model_scene(eq->m)->load[load];
    const double acts = scene_acting_factor(model_scene(eq->m), eq->loading.acting, l->load_case);
    feedback_push by = {eq->m, s, 0, {0}, {0}};
    applied_each(eq->m, s, l, 1, add_push, &by);
    for (int k = 0; k < by.count; k++)
        push[by.index[k]] += acts * by.value[k];
    add_measured(eq->m, s, l->feedback.node, l->feedback.component, 1, measured);
    add_measured(eq->m, s, l->feedback.from, l->feedback.component, -1, measured);
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
        int of[KINEMATICS_MOST];
        double slope[KINEMATICS_MOST];
        feedback_push push = {m, s, 0, {0}, {0}};
        applied_each(m, s, load, 1, add_push, &push);
        const double acts =
            scene_acting_factor(model_scene(m), eq->loading.acting, load->load_case);
        for (int k = 0; k < 2; k++) {
            const int columns =
                node[k] != SCENE_NONE ? measure(m, s, node[k], b->component, of, slope) : 0;
            for (int a = 0; a < push.count; a++)
                for (int c = 0; c < columns; c++)
                    take(to, push.index[a], of[c],
                         (k == 0 ? 1 : -1) * acts * gain * push.value[a] * slope[c]);
        }
    }
}
