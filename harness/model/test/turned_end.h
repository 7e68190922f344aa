/* A model in which the last end of a member is rotated relative to its node. No scene can describe
 * this. */
#ifndef BEAMWORK_TEST_TURNED_END_H
#define BEAMWORK_TEST_TURNED_END_H

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/model/model_impl.h"

/* Rotates the last end further by a rotation vector. own[]: receives the triads of the element
 * after the rotation. */
static inline void turned_end(model *m, const double vector[3], mesh_triad own[ELEMENT_MAX_NODES],
                              mesh_triad *before)
{
    mesh_element *last = &m->mesh.element[m->mesh.elements - 1];
    double q[4], R[9];
    rotation_exp(vector, q);
    rotation_matrix(q, R);
    memcpy(own, before, (size_t)last->nodes * sizeof *own);
    mat3_mul(R, before[last->nodes - 1], own[last->nodes - 1]);
    last->triad = own;
}

#endif
