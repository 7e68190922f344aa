#include "harness/equations/internal.h"

#include <math.h>

#include "elements/math/dense.h"
#include "harness/equations/equations_impl.h"
#include "harness/equations/loads.h"
#include "harness/model/kinematics.h"

/* Loads along the member that a vertex of it takes are taken off. */
typedef struct share {
    int vertex;
    double *force; /* [6] */
} share;

static void take_off(void *context, const applied *what)
{
    const share *of = context;
    double moment[3];
    if (what->vertex != of->vertex)
        return;
    for (int i = 0; i < 6; i++)
        of->force[i] -= what->F[i];
    if (!what->offset)
        return;
    vec3_cross(what->arm, what->F, moment);
    for (int i = 0; i < 3; i++)
        of->force[3 + i] -= moment[i];
}

/* The element has a section of its own where it changes along the member, with other axes than at the end. */
static void turn_to_end(const model *m, int member, int end, const mesh_element *el, double R[9])
{
    const scene_member *sm = &m->scene->member[member];
    const double angle = m->section[end ? sm->section_q : sm->section].axes_angle -
                         m->section[m->kind[el->kind].section].axes_angle,
                 c = cos(angle), d = sin(angle);
    for (int i = 0; i < 9 && angle != 0; i += 3) {
        const double y = R[i + 1];
        R[i + 1] = c * y + d * R[i + 2];
        R[i + 2] = c * R[i + 2] - d * y;
    }
}

void internal_at_end(model *m, const model_state *s, const double sigma[], double at, int member,
                     int end, double out[7])
{
    const int i = end ? m->first_element[member + 1] - 1 : m->first_element[member],
              k = end ? m->nodes - 1 : 0;
    const mesh_element *el = &m->element[i];
    node_state x[ELEMENT_MAX_NODES];
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0};
    const size_t first = (size_t)i * (size_t)m->strains;
    kinematics_gather(m, s, el, x);
    m->type->strain(m->kind[el->kind].data, x, &(strain_output){.J = J});
    dense_add_transpose_mul(m->coordinates, m->strains, 1, J,
                            sigma != NULL ? &sigma[first] : &s->sigma[first], force);
    rotating_frame_add(m, x, i, at, force, NULL, NULL); /* never fails in a state that is reached */
    const share of = {el->vertex[k], force + NODE_COORDINATES * k};
    for (int l = 0; l < m->scene->loads; l++) {
        const scene_load *load = &m->scene->load[l];
        if (scene_load_along(load) && load->where == member)
            applied_each(m, s, load, loads_factor(load, at), take_off, (void *)&of);
    }
    const double sign = end ? 1 : -1;
    turn_to_end(m, member, end, el, x[k].R);
    mat3_transpose_mul_vec(x[k].R, of.force, out);
    mat3_transpose_mul_vec(x[k].R, of.force + 3, out + 3);
    out[6] = of.force[6];
    for (int c = 0; c < 7; c++)
        out[c] *= sign;
}
