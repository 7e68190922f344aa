/* Forces of some of the elements: on a node, on coordinates. */
#include <math.h>
#include <string.h>

#include "cases/scene/names.h"
#include "elements/math/dense.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linear_springs.h"
#include "harness/newton/linearise.h"
#include "harness/newton/loads.h"

void linearise_node_force(const equations *eq, const model_state *s, const double sigma[], int node,
                          double F[6])
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    const double *stress = sigma != NULL ? sigma : s->sigma;
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        for (int k = 0; k < model_nodes(m); k++) {
            if (model_vertex(m, el->vertex[k])->body != node)
                continue;
            node_state x[ELEMENT_MAX_NODES];
            double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
                force[ELEMENT_MAX_COORDINATES] = {0}, rho[3], moment[3];
            kinematics_gather(m, s, el, x);
            model_type(m)->strain(model_kind(m, el->kind)->data, x, &(strain_output){.J = J});
            dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                    &stress[(size_t)i * (size_t)model_strains(m)], force);
            rotating_frame_add(eq, x, i, s->path, force, NULL,
                               NULL); /* never fails in a state that has been reached */
            kinematics_offset(m, s, el->vertex[k], rho);
            vec3_cross(rho, force + NODE_COORDINATES * k, moment);
            for (int c = 0; c < 3; c++) {
                F[c] += force[NODE_COORDINATES * k + c];
                F[3 + c] +=
                    force[NODE_COORDINATES * k + 3 + c] + (el->vertex[k] == node ? 0 : moment[c]);
            }
        }
    }
    discrete_node_force(m, s, &frame, node, F);
    if (sigma != NULL)
        linear_springs_node_force(m, &sigma[(size_t)model_elements(m) * (size_t)model_strains(m)],
                                  node, F);
}

/* Of what the moments at a node are made of; less is rounding. */
static const double least_moment = 1e-12;

double linearise_held_moment(const equations *eq, const model_state *s, const double sigma[],
                             double path, int node, int axis)
{
    const model *m = eq->m;
    double F[6], load[6];
    linearise_node_force(eq, s, sigma, node, F);
    loads_at_node(eq, s, path, node, load);
    const double moment = F[3 + axis] - load[3 + axis],
                 size = vec3_norm(F + 3) + vec3_norm(load + 3) +
                        model_length(m) * (vec3_norm(F) + vec3_norm(load));
    return fabs(moment) > least_moment * size ? moment : 0;
}

void linearise_add_held_moments(const equations *eq, const model_state *s, double path, sparse *K)
{
    const model *m = eq->m;
    for (int node = 0; node < model_scene(m)->nodes; node++) {
        const int h = coordinates_held_turn(m, node);
        if (h == NONE)
            continue;
        const int *coordinate = model_vertex(m, node)->coordinate + SCENE_RX,
                  i = coordinate[(h + 1) % 3], j = coordinate[(h + 2) % 3];
        const double half = linearise_held_moment(eq, s, NULL, path, node, h) / 2;
        assemble_subtract(K, i, j, -half);
        assemble_subtract(K, j, i, half);
    }
}

status linearise_held_have_potential(const equations *eq, const double sigma[], double path,
                                     fault *f)
{
    const model *m = eq->m;
    static const char *const turn[] = {"rx", "ry", "rz"};
    for (int node = 0; node < model_scene(m)->nodes; node++) {
        const int h = coordinates_held_turn(m, node);
        if (h != NONE && linearise_held_moment(eq, kinematics_rest(m), sigma, path, node, h) != 0)
            return fault_set(f, STATUS_REFUSED,
                             "the moment that holds %s of %s, which turns freely about two axes "
                             "across it, has no potential: hold one of them, or follow a path",
                             turn[h], scene_called(model_scene(m), SCENE_NODES, node).text);
    }
    return STATUS_OK;
}

void linearise_add_internal(const equations *eq, const model_state *s, int elements,
                            const int element[], double out[])
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    for (int k = 0; k < elements; k++) {
        const mesh_element *el = model_element(m, element[k]);
        node_state x[ELEMENT_MAX_NODES];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[MODEL_MAX_COORDINATES] = {0};
        kinematics_gather(m, s, el, x);
        model_type(m)->strain(model_kind(m, el->kind)->data, x, &(strain_output){.J = J});
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                &s->sigma[(size_t)element[k] * (size_t)model_strains(m)], force);
        eliminate_forces(m, s, el, force);
        assemble_vector(el, force, out);
    }
    for (int i = model_discretes(m) - model_springs(m); i < model_discretes(m); i++) {
        double force[MODEL_MAX_COORDINATES] = {0},
               K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
        discrete_equations(m, s, model_discrete(m, i), &frame, force, K);
        assemble_vector(&model_discrete(m, i)->el, force, out);
    }
}
