#include "harness/time/forms.h"
#include "cases/scene/names.h"

#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"

/* Components of a rotation about fixed axes that move. */
static int turns_of(const model *m, int vertex)
{
    const mesh_vertex *v = model_vertex(m, vertex);
    int count = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ; c++)
        count += v->coordinate[c] != NONE;
    return count;
}

rotation_form forms_of(const model *m, int vertex)
{
    if (model_vertex(m, vertex)->angles > 0)
        return FORM_SEQUENCE;
    return turns_of(m, vertex) == 3 ? FORM_BODY : FORM_AXIS;
}

/* Do held turns that are kept as rows leave one axis at most? */
static int keeps_axis(const model *m, int vertex)
{
    int moving = 0;
    for (int k = 0; k < 3; k++)
        moving += model_scene(m)->node[vertex].angle[k] != SCENE_HELD;
    return moving <= 1;
}

/* Names two axes that it turns about, and the third. */
static status refuse_turns(const model *m, int vertex, fault *f)
{
    static const char axis[] = "xyz";
    int last = 2, first;
    while (last > 0 && model_scene(m)->node[vertex].angle[last] == SCENE_HELD)
        last--;
    first = last > 0 ? last - 1 : 0;
    while (first > 0 && model_scene(m)->node[vertex].angle[first] == SCENE_HELD)
        first--;
    return fault_set(
        f, STATUS_REFUSED,
        "%s: a motion in time must know how it lies, which turns about fixed axes do not say: "
        "about %c, then about %c, and back by both leaves it turned about %c; give its rotation as "
        "a sequence of angles or as a vector, or hold one turn more",
        scene_called(model_scene(m), SCENE_NODES, vertex).text, axis[first], axis[last],
        axis[3 - first - last]);
}

status forms_check(const model *m, fault *f)
{
    for (int i = 0; i < model_first_release(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        if (v->body != i || v->angles > 0)
            continue;
        int driven = 0;
        for (int c = SCENE_RX; c <= SCENE_RZ; c++)
            driven += v->coordinate[c] >= model_unknowns(m);
        const int turns = turns_of(m, i);
        const int loose = turns == 3 && driven > 0 && v->vector_driver[0] == NONE;
        if (turns == 2 || (loose && !keeps_axis(m, i)))
            return refuse_turns(m, i, f);
    }
    return STATUS_OK;
}

/* Angles a_k about axes b_k, each carried by those before it:
 * w = sum b_k a_k', w' = sum b_k a_k'' + sum_(j<k) a_j' a_k' b_j x b_k. */
static void sequence_rates(const model *m, const model_state *s, int vertex, const double v[],
                           const double a[], frame_rates *out)
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3], rate[3] = {0, 0, 0};
    kinematics_axes(m, s, vertex, b);
    for (int k = 0; k < frame->angles; k++) {
        const int c = frame->coordinate[SCENE_RX + k];
        if (c == NONE)
            continue;
        rate[k] = v[c];
        for (int i = 0; i < 3; i++) {
            out->w[i] += b[k][i] * v[c];
            out->wd[i] += a != NULL ? b[k][i] * a[c] : 0;
        }
        for (int j = 0; j < k; j++) {
            double carried[3];
            vec3_cross(b[j], b[k], carried);
            for (int i = 0; i < 3; i++)
                out->wd[i] += rate[j] * rate[k] * carried[i];
        }
    }
}

void forms_rates(const model *m, const model_state *s, int vertex, const double v[],
                 const double a[], frame_rates *out)
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    memset(out, 0, sizeof *out);
    rotation_matrix(&s->q[4 * vertex], out->R);
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[i];
        out->v[i] = c != NONE ? v[c] : 0;
        out->a[i] = c != NONE && a != NULL ? a[c] : 0;
    }
    if (frame->angles > 0) {
        sequence_rates(m, s, vertex, v, a, out);
        return;
    }
    double w[3] = {0, 0, 0}, wd[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[SCENE_RX + i];
        w[i] = c != NONE ? v[c] : 0;
        wd[i] = c != NONE && a != NULL ? a[c] : 0;
    }
    mat3_mul_vec(out->R, w, out->w);
    mat3_mul_vec(out->R, wd, out->wd);
}

void forms_add_force(const model *m, const model_state *s, int vertex, const double F[6],
                     double out[])
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (frame->angles > 0)
        kinematics_axes(m, s, vertex, b);
    for (int c = 0; c < 3; c++)
        if (frame->coordinate[c] != NONE)
            out[frame->coordinate[c]] += F[c];
    for (int k = 0; k < 3; k++)
        if (frame->coordinate[SCENE_RX + k] != NONE)
            out[frame->coordinate[SCENE_RX + k]] += vec3_dot(b[k], F + 3);
}
