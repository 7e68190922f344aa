/* Transforms element coordinates (dr, dphi, da per vertex) to those of the moving bodies, in place.
 * Offset: see elements/math/rotation.h. Sequence: theta = sum b_i dt_i + 1/2 sum_(i<j) b_i x b_j
 * dt_i dt_j (Baker-Campbell-Hausdorff). */
#include "harness/model/model_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

static void sequence_force(int angles, double b[3][3], double force[7])
{
    double t[3] = {0, 0, 0};
    for (int k = 0; k < angles; k++)
        t[k] = vec3_dot(b[k], force + 3);
    memcpy(force + 3, t, sizeof t);
}

void eliminate_forces(const model *m, const model_state *s, const mesh_element *el, double force[])
{
    if (el->plain)
        return;
    for (int k = 0, own = mesh_own_coordinates(el); k < el->nodes; k++) {
        const int v = el->vertex[k], body = m->mesh.vertex[v].body;
        double rho[3], b[3][3];
        if (release_of(m, v) != NULL) {
            release_force(m, s, v, force + NODE_COORDINATES * k, force + own);
            own += release_of(m, v)->turns + release_of(m, v)->slides;
        }
        if (body != v) {
            kinematics_offset(m, s, v, rho);
            offset_force(rho, force + NODE_COORDINATES * k);
        }
        if (m->mesh.vertex[body].angles > 0) {
            kinematics_axes(m, s, body, b);
            const double *F = force + (ptrdiff_t)NODE_COORDINATES * k;
            double moved[3] = {0, 0, 0};
            if (m->mesh.vertex[body].led)
                kinematics_arm(m, s, body, moved);
            sequence_force(m->mesh.vertex[body].angles, b, force + NODE_COORDINATES * k);
            force[NODE_COORDINATES * k + 3] += vec3_dot(moved, F);
        }
        kinematics_to_own(&m->mesh.vertex[body], force + NODE_COORDINATES * k);
    }
}

static void sequence_matrix(int n, int at, int angles, double b[3][3], const double moment[3],
                            double K[])
{
    for (int i = 0; i < n; i++) {
        double t[3] = {0, 0, 0};
        for (int k = 0; k < angles; k++)
            t[k] = vec3_dot(&K[i * n + at + 3], b[k]);
        memcpy(&K[i * n + at + 3], t, sizeof t);
    }
    for (int j = 0; j < n; j++) {
        const double column[3] = {K[(at + 3) * n + j], K[(at + 4) * n + j], K[(at + 5) * n + j]};
        for (int k = 0; k < 3; k++)
            K[(at + 3 + k) * n + j] = k < angles ? vec3_dot(column, b[k]) : 0;
    }
    if (moment == NULL)
        return;
    for (int i = 0; i < angles; i++)
        for (int j = i + 1; j < angles; j++) {
            double cross[3];
            vec3_cross(b[i], b[j], cross);
            const double half = vec3_dot(moment, cross) / 2;
            K[(at + 3 + i) * n + at + 3 + j] += half;
            K[(at + 3 + j) * n + at + 3 + i] += half;
        }
}

static void swing_matrix(const model *m, const model_state *s, int body, int n, int at,
                         const double F[3], double K[])
{
    double moved[3], inward[3];
    kinematics_arm(m, s, body, moved);
    vec3_cross(m->mesh.vertex[body].axis[0], moved, inward);
    for (int i = 0; i < n; i++)
        K[i * n + at + 3] += vec3_dot(&K[i * n + at], moved);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < 3; i++)
            K[(at + 3) * n + j] += moved[i] * K[(at + i) * n + j];
    K[(at + 3) * n + at + 3] += F != NULL ? vec3_dot(F, inward) : 0;
}

void eliminate_matrix(const model *m, const model_state *s, const mesh_element *el,
                      const double force[], double K[])
{
    if (el->plain)
        return;
    const int n = el->columns;
    if (n > mesh_own_coordinates(el))
        dense_widen(mesh_own_coordinates(el), n, K);
    for (int k = 0, own = mesh_own_coordinates(el); k < el->nodes; k++) {
        const int v = el->vertex[k], body = m->mesh.vertex[v].body;
        double rho[3], b[3][3], moment[7];
        if (force != NULL)
            memcpy(moment, force + NODE_COORDINATES * k, sizeof moment);
        if (release_of(m, v) != NULL) {
            release_matrix(m, s, v, n, NODE_COORDINATES * k, own, force != NULL ? moment : NULL, K);
            own += release_of(m, v)->turns + release_of(m, v)->slides;
        }
        if (body != v) {
            kinematics_offset(m, s, v, rho);
            offset_matrix(n, NODE_COORDINATES * k, rho,
                          force != NULL ? force + NODE_COORDINATES * k : NULL, K);
            if (force != NULL)
                offset_force(rho, moment);
        }
        if (m->mesh.vertex[body].angles > 0) {
            kinematics_axes(m, s, body, b);
            sequence_matrix(n, NODE_COORDINATES * k, m->mesh.vertex[body].angles, b,
                            force != NULL ? moment + 3 : NULL, K);
        }
        if (m->mesh.vertex[body].led)
            swing_matrix(m, s, body, n, NODE_COORDINATES * k,
                         force != NULL ? force + NODE_COORDINATES * k : NULL, K);
        kinematics_turn_matrix(&m->mesh.vertex[body], n, NODE_COORDINATES * k, K);
    }
}
