/* The tangent of the last linearisation as a stiff and a soft part, for residuals that keep their
 * digits. */
#include "harness/newton/stiffness_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/ahead.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linearise.h"

void stiffness_parts_material_product(const model *m, const linear_memory *memory,
                                      const model_state *s, const double x[], double y[])
{
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        const model_slot w = linearise_slot(m, memory, i);
        double local[ELEMENT_MAX_COORDINATES], e[ELEMENT_MAX_STRAINS], sigma[ELEMENT_MAX_STRAINS],
            force[MODEL_MAX_COORDINATES] = {0};
        kinematics_local(m, s, el, x, local);
        dense_mul_vec(model_strains(m), model_own_coordinates(m), w.J, local, e);
        dense_mul_vec(model_strains(m), model_strains(m), w.C, e, sigma);
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, w.J, sigma, force);
        eliminate_forces(m, s, el, force);
        assemble_vector(el, force, y);
    }
    discrete_material_product(m, s, x, y);
}

/* Strains are off by the rounding of their terms, P'' by that of its entries: errors of all
 * elements alike, so they add up. */
double stiffness_parts_material_rounding(const model *m, const linear_memory *memory,
                                         const model_state *s, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const model_slot w = linearise_slot(m, memory, i);
        double local[ELEMENT_MAX_COORDINATES], e[ELEMENT_MAX_STRAINS];
        kinematics_local(m, s, model_element(m, i), x, local);
        dense_mul_vec(model_strains(m), model_own_coordinates(m), w.J, local, e);
        for (int k = 0; k < model_strains(m); k++) {
            double sigma = 0, sigma_terms = 0, terms = 0;
            for (int j = 0; j < model_strains(m); j++) {
                sigma += w.C[k * model_strains(m) + j] * e[j];
                sigma_terms += fabs(w.C[k * model_strains(m) + j] * e[j]);
            }
            for (int j = 0; j < model_own_coordinates(m); j++)
                terms += fabs(w.J[k * model_own_coordinates(m) + j] * local[j]);
            sum += DBL_EPSILON * (2 * fabs(sigma) * terms + fabs(e[k]) * sigma_terms);
        }
    }
    return sum + discrete_material_rounding(m, s, x);
}

status stiffness_parts_geometric(const equations *eq, const linear_memory *memory,
                                 const model_state *s, sparse *G, fault *f)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    const mesh_pattern *p = assemble_of(eq->run->patterns, G);
    status outcome = STATUS_OK;
    sparse_zero(G);
    ahead_strains(eq, s, AHEAD_H, s->sigma);
    for (int i = 0; i < model_elements(m) && outcome == STATUS_OK; i++) {
        const mesh_element *el = model_element(m, i);
        const model_slot w = linearise_slot(m, memory, i);
        const double *sigma = &s->sigma[(size_t)i * (size_t)model_strains(m)];
        node_state x[ELEMENT_MAX_NODES];
        double H[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
            present[ELEMENT_MAX_COORDINATES] = {0};
        kinematics_gather(m, s, el, x);
        ahead_strain(eq, i, x, &(strain_output){.s = sigma, .H = H});
        eq->run->counters.strain_evaluations++;
        if (eq->loading.rotates) {
            outcome = rotating_frame_add(eq, x, i, s->path, present, H, f);
        }
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, w.J, sigma, present);
        eliminate_matrix(m, s, el, present, H);
        assemble_matrix(p, i, H, G);
    }
    ahead_end(eq);
    TRY(outcome);
    discrete_geometric(m, s, &frame, G);
    loads_subtract_stiffness(eq, s, s->path, G);
    linearise_add_held_moments(eq, s, s->path, G);
    return STATUS_OK;
}
