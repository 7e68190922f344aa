/* A frame that turns steadily: what it does to elements, and the matrices of small motions in it (J
 * Eq. 76). */
#include "harness/newton/rotating_frame.h"
#include "cases/scene/names.h"

#include <string.h>

#include "elements/field/field_mass.h"
#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"

int rotating_frame_lumps(const equations *eq)
{
    return model_scene(eq->m)->lumped || eq->loading.lumps != LUMPS_NOTHING;
}

static status inertia_at(const equations *eq, const node_state x[], int i, double path,
                         inertia_output *out, fault *f)
{
    const model *m = eq->m;
    const element_rotating_frame frame = loading_frame(&eq->loading, path);
    const mesh_kind *kind = model_kind_of(m, i);
    const element_rotating_frame *turning = eq->loading.rotates ? &frame : NULL;
    status outcome;
    if (rotating_frame_lumps(eq)) {
        const lumped_mass whole =
            lumped_of(model_section(m, kind->section), model_features(m), kind->length);
        outcome =
            lumped_element(&whole, model_nodes(m), model_element(m, i)->share, x, turning, out);
    } else {
        outcome = model_type(m)->inertia(kind->data, x, turning, out);
    }
    eq->run->counters.inertia_evaluations++;
    if (outcome != STATUS_OK)
        return fault_set(
            f, outcome, "element %d of %s: its inertia cannot be evaluated", i,
            scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text);
    return STATUS_OK;
}

status rotating_frame_add(const equations *eq, const node_state x[], int i, double path,
                          double force[], double K[], fault *f)
{
    const model *m = eq->m;
    double centrifugal[ELEMENT_MAX_COORDINATES],
        N[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    if (!eq->loading.rotates)
        return STATUS_OK;
    TRY(inertia_at(eq, x, i, path,
                   &(inertia_output){.force = centrifugal, .N = K != NULL ? N : NULL}, f));
    for (int k = 0; k < model_own_coordinates(m); k++)
        force[k] -= centrifugal[k];
    if (K != NULL)
        for (int k = 0; k < model_own_coordinates(m) * model_own_coordinates(m); k++)
            K[k] += N[k];
    return STATUS_OK;
}

status rotating_frame_inertia(const equations *eq, const model_state *state, double path, sparse *M,
                              sparse *G, fault *f)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, path);
    const model *m = eq->m;
    const model_state *s = state != NULL ? state : kinematics_rest(m);
    const mesh_pattern *p = assemble_of(eq->run->patterns, M);
    double mass[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
        gyroscopic[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
    sparse_zero(M);
    if (G != NULL)
        sparse_zero(G);
    for (int i = 0; i < model_elements(m); i++) {
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, model_element(m, i), x);
        TRY(inertia_at(eq, x, i, path,
                       &(inertia_output){.M = mass, .G = G != NULL ? gyroscopic : NULL}, f));
        eliminate_matrix(m, s, model_element(m, i), NULL, mass);
        assemble_matrix(p, i, mass, M);
        if (G == NULL)
            continue;
        eliminate_matrix(m, s, model_element(m, i), NULL, gyroscopic);
        assemble_matrix(p, i, gyroscopic, G);
    }
    discrete_inertia(m, s, &frame, M, G);
    return STATUS_OK;
}

/* Of a vector in fixed axes, in those of an element between its ends. */
static void in_axes(const mesh_element *el, const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int i = 0; i < 3; i++)
            out[k] += (el->triad[0][3 * i + k] + el->triad[1][3 * i + k]) / 2 * v[i];
    }
}

double rotating_frame_inner(const model *m, const double x[])
{
    double sum = 0;
    for (int e = 0; e < model_elements(m); e++) {
        const mesh_element *el = model_element(m, e);
        const double *B = model_kind(m, el->kind)->inner;
        double local[ELEMENT_MAX_COORDINATES], own[FIELD_INNER];
        if (B == NULL)
            continue;
        kinematics_local(m, kinematics_rest(m), el, x, local);
        for (int node = 0; node < 2; node++) {
            const int at = NODE_COORDINATES * node;
            in_axes(el, local + at, own + at);
            in_axes(el, local + at + 3, own + at + 3);
            own[at + 6] = local[at + 6];
        }
        sum += dense_quadratic(FIELD_INNER, B, own);
    }
    return sum;
}

/* B in fixed axes. */
static void turn_inner(const mesh_element *el, const double B[], double out[])
{
    double T[FIELD_INNER * FIELD_INNER] = {0}, half[FIELD_INNER * FIELD_INNER];
    for (int at = 0; at < FIELD_INNER; at += NODE_COORDINATES) {
        for (int block = 0; block < 6; block += 3)
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++)
                    T[FIELD_INNER * (at + block + k) + at + block + i] =
                        (el->triad[0][3 * i + k] + el->triad[1][3 * i + k]) / 2;
        T[(FIELD_INNER + 1) * (at + 6)] = 1;
    }
    dense_mul(FIELD_INNER, FIELD_INNER, FIELD_INNER, B, T, half);
    dense_add_transpose_mul(FIELD_INNER, FIELD_INNER, FIELD_INNER, T, half, out);
}

int rotating_frame_inner_matrix(const equations *eq, sparse *out)
{
    const model *m = eq->m;
    const mesh_pattern *p = assemble_of(eq->run->patterns, out);
    int any = 0;
    sparse_zero(out);
    for (int e = 0; e < model_elements(m); e++) {
        const double *B = model_kind_of(m, e)->inner;
        double E[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES] = {0};
        if (B == NULL)
            continue;
        turn_inner(model_element(m, e), B, E);
        eliminate_matrix(m, kinematics_rest(m), model_element(m, e), NULL, E);
        assemble_matrix(p, e, E, out);
        any = 1;
    }
    return any;
}

void rotating_frame_load_stiffness(const equations *eq, const model_state *s, double path,
                                   sparse *out)
{
    sparse_zero(out);
    loads_subtract_stiffness(eq, s, path, out);
}
