#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "harness/model/model.h"

status harmonic_check_motion(const vibration *v, int driver, fault *f)
{
    const model *m = v->c->model;
    for (int i = 0; i < model_scene(m)->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (model_vertex(m, i)->vector_driver[k] == driver)
                return fault_set(f, STATUS_REFUSED,
                                 "motion %s is a component of a rotation vector; drive an angle or "
                                 "a translation",
                                 model_scene(m)->driver[driver].name);
    return STATUS_OK;
}

/* Returns the generalised force in coordinate k of the node, T[6 x count], due to a unit force
 * along a component or due to a unit rotating unbalance. */
static double complex force_of(const scene_response *r, double w, const double T[], int count,
                               int k)
{
    if (r->forced != SCENE_NONE)
        return T[r->forced_along * count + k];
    return w * w *
           (T[scene_unbalance_along(r, 0) * count + k] -
            I * T[scene_unbalance_along(r, 1) * count + k]);
}

status harmonic_input(const vibration *v, const scene_response *r, double w, double complex x[],
                      fault *f)
{
    const model *m = v->c->model;
    int index[KINEMATICS_MOST], moves = 0;
    double T[6 * KINEMATICS_MOST];
    double complex own;
    memset(x, 0, loops_whole(v) * sizeof *x);
    if (r->driver != SCENE_NONE) {
        const int c = model_driver_coordinate(m, r->driver);
        TRY(harmonic_check_motion(v, r->driver, f));
        for (int k = v->K.column[c]; k < v->K.column[c + 1]; k++)
            if (v->K.row[k] < v->free)
                x[v->K.row[k]] = -harmonic_dynamic(v, w, k);
        x[c] = 1;
        for (int l = 0; l < v->loops; l++)
            x[v->all + l] = -loops_gain(&v->loop[l], w, &own) * v->loop[l].measured[c];
        return STATUS_OK;
    }
    if (r->reference != SCENE_NONE) {
        const control_loop *loop = loops_of(v, r->reference);
        x[v->all + (loop - v->loop)] = loops_gain(loop, w, &own);
        return STATUS_OK;
    }
    const int node = r->forced != SCENE_NONE ? r->forced : r->unbalanced,
              count = kinematics_node_jacobian(m, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        if (index[k] < v->free) {
            x[index[k]] = force_of(r, w, T, count, k);
            moves |= cabs(force_of(r, 1, T, count, k)) > 0;
        }
    return moves ? STATUS_OK
                 : fault_set(f, STATUS_REFUSED,
                             "a force along a fixed or driven component of %s has no effect; name "
                             "another component, or a motion with 'drive'",
                             scene_called(model_scene(m), SCENE_NODES, node).text);
}

int harmonic_carried(const vibration *v, const scene_response *r, double y[])
{
    if (r->driver == SCENE_NONE)
        return 0;
    harmonic_modes_carried(v, model_driver_coordinate(v->c->model, r->driver), y);
    return 1;
}

/* Adds `times` the small motion of a component of a node to o[all]. */
static void add_motion(const vibration *v, int node, int component, double times,
                       double complex o[])
{
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        o[index[k]] += times * T[component * count + k];
}

status harmonic_reacting(const vibration *v, const scene_response *r, int *out, fault *f)
{
    const scene *s = v->c->scene;
    int index[KINEMATICS_MOST], driver = SCENE_NONE, nodes = 0;
    double T[6 * KINEMATICS_MOST];
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, r->node, KINEMATICS_MOST, index, T);
    const int first = r->component - r->component % 3;
    const double rounding = 1e-12;
    double R[9];
    scene_node_axes(&s->node[r->node], R);
    *out = -1;
    for (int k = 0; k < count; k++) {
        double moved = 0;
        for (int i = 0; i < 3; i++)
            moved += R[3 * i + r->component % 3] * T[(first + i) * count + k];
        if (fabs(moved) > rounding)
            *out = *out == -1 && index[k] >= v->free ? index[k] : -2;
    }
    for (int i = 0; i < s->drivers && *out >= 0; i++)
        if (model_driver_coordinate(v->c->model, i) == *out)
            driver = i;
    for (int i = 0; i < s->nodes && driver != SCENE_NONE; i++)
        for (int k = 0; k < 3; k++)
            nodes += (s->node[i].translation[k] == driver) + (s->node[i].angle[k] == driver) +
                     2 * (model_vertex(v->c->model, i)->vector_driver[k] == driver);
    for (int i = 0; i < 6 * s->nodes && driver != SCENE_NONE; i++)
        nodes += model_tie(v->c->model, i / 6, i % 6) != NULL &&
                 model_vertex(v->c->model, i / 6)->coordinate[i % 6] == *out;
    if (driver == SCENE_NONE)
        return fault_set(
            f, STATUS_REFUSED,
            "a reaction of %s requires a motion that drives only this component, but there is "
            "none; remove the component from 'hold', and 'drive' it by a motion with path: [0, 1] "
            "and "
            "value: [0, 0]",
            scene_called(s, SCENE_NODES, r->node).text);
    return nodes == 1
               ? STATUS_OK
               : fault_set(
                     f, STATUS_REFUSED,
                     "motion %s drives more components than the one whose reaction is requested; "
                     "give each component its own motion, or attach the nodes to one driven node",
                     s->driver[driver].name);
}

/* Adds row c of D at w to o[all]. */
static void add_row(const vibration *v, int c, double w, double complex o[])
{
    for (int j = 0; j < v->all; j++)
        for (int k = v->K.column[j]; k < v->K.column[j + 1]; k++) {
            if (v->K.row[k] == c)
                o[j] += harmonic_dynamic(v, w, k);
            else if (j == c && v->K.symmetric)
                o[v->K.row[k]] += harmonic_dynamic(v, w, k);
        }
}

/* Adds the contribution of modal damping to the reaction of a driven coordinate. The contribution
 * follows from the forces -i w r^T U U^T (x - r of the input). */
static void add_carried(vibration *v, const scene_response *r, int c, double w, double complex o[])
{
    const double *U;
    const int more = harmonic_modes_damped(v->modes, &U), n = v->free;
    double *own = v->x, *input = v->x + n;
    if (more == 0)
        return;
    harmonic_modes_carried(v, c, own);
    for (int i = 0; i < more; i++)
        for (int k = 0; k < n; k++)
            o[k] -= I * w * own[i] * U[(size_t)i * (size_t)n + (size_t)k];
    if (!harmonic_carried(v, r, input))
        return;
    for (int i = 0; i < more; i++)
        o[model_driver_coordinate(v->c->model, r->driver)] += I * w * own[i] * input[i];
}

void harmonic_output(vibration *v, const scene_response *r, double w, double complex o[])
{
    int c = 0;
    fault unused = {""};
    memset(o, 0, loops_whole(v) * sizeof *o);
    if (r->of == SCENE_REACTING) {
        if (harmonic_reacting(v, r, &c, &unused) == STATUS_OK) {
            add_row(v, c, w, o);
            add_carried(v, r, c, w, o);
            for (int l = 0; l < v->loops; l++)
                o[v->all + l] -= v->loop[l].push[c];
        }
        return;
    }
    add_motion(v, r->node, r->component, 1, o);
    if (r->from != SCENE_NONE)
        add_motion(v, r->from, r->component, -1, o);
}

double complex harmonic_force_at(const vibration *v, const scene_response *r, double w)
{
    const int node = r->forced != SCENE_NONE ? r->forced : r->unbalanced;
    int index[KINEMATICS_MOST], c = 0;
    double T[6 * KINEMATICS_MOST];
    double complex sum = 0;
    fault unused = {""};
    if (r->of != SCENE_REACTING || node == SCENE_NONE ||
        harmonic_reacting(v, r, &c, &unused) != STATUS_OK)
        return 0;
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        sum += index[k] == c ? force_of(r, w, T, count, k) : 0;
    return sum;
}

/* Sets out[4 x free] to the columns of K, M, C and B that belong to a driven coordinate. Returns
 * the number of these columns. */
static int shapes_of_motion(const vibration *v, int c, double out[])
{
    const sparse *const by_motion[HARMONIC_SHAPES_OF_MOTION] = {&v->K, &v->M, &v->C, &v->B};
    for (int i = 0; i < HARMONIC_SHAPES_OF_MOTION; i++)
        for (int k = v->K.column[c]; k < v->K.column[c + 1]; k++)
            if (v->K.row[k] < v->free)
                out[(size_t)i * (size_t)v->free + (size_t)v->K.row[k]] = by_motion[i]->value[k];
    return HARMONIC_SHAPES_OF_MOTION;
}

static void take_shape(const vibration *v, double out[])
{
    for (int k = 0; k < v->free; k++)
        out[k] = creal(v->output[k]);
}

/* Sets the forces of an input, and returns their number. */
static int shapes_of_input(vibration *v, const scene_response *r, double out[])
{
    const size_t n = (size_t)v->free;
    const int rotates = r->unbalanced != SCENE_NONE,
              count = r->forced != SCENE_NONE ? 1 : 2 * rotates;
    if (r->driver != SCENE_NONE)
        return shapes_of_motion(v, model_driver_coordinate(v->c->model, r->driver), out);
    for (int i = 0; i < count; i++) {
        memset(v->output, 0, loops_whole(v) * sizeof *v->output);
        if (rotates)
            add_motion(v, r->unbalanced, scene_unbalance_along(r, i), 1, v->output);
        else
            add_motion(v, r->forced, r->forced_along, 1, v->output);
        take_shape(v, out + (size_t)i * n);
    }
    return count;
}

int harmonic_shapes(vibration *v, const scene_response *r, double out[])
{
    const size_t n = (size_t)v->free;
    fault unused = {""};
    int c;
    const int count = shapes_of_input(v, r, out);
    if (r->of == SCENE_REACTING)
        return harmonic_reacting(v, r, &c, &unused) == STATUS_OK
                   ? count + shapes_of_motion(v, c, out + (size_t)count * n)
                   : count;
    harmonic_output(v, r, 0, v->output);
    take_shape(v, out + (size_t)count * n);
    return count + 1;
}
