#include "harness/model/discrete.h"
#include "cases/scene/names.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/offset.h"
#include "harness/model/body.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"
#include "harness/model/spring.h"
#include "harness/model/turns.h"

enum { X = ELEMENT_MAX_COORDINATES };

static void begin(const int nodes, const int vertex[], mesh_discrete *d)
{
    memset(d, 0, sizeof *d);
    d->el.kind = d->el.member = NONE;
    d->el.nodes = nodes;
    d->el.triad = d->triad;
    for (int k = 0; k < nodes; k++) {
        d->el.vertex[k] = vertex[k];
        d->el.warp[k] = NONE;
        for (int i = 0; i < 3; i++)
            d->triad[k][4 * i] = 1;
    }
}

static void add_spring(model *m, const scene_spring *spring)
{
    const int both[2] = {spring->p, spring->q}, one = spring->p == SCENE_NONE;
    mesh_discrete *d = &m->mesh.discrete[m->mesh.discretes++];
    begin(one ? 1 : 2, one ? &both[1] : both, d);
    d->spring = spring;
    m->mesh.springs++;
}

status discrete_build(model *m, fault *f)
{
    int count = m->scene->springs;
    for (int i = 0; i < m->scene->nodes; i++)
        count += scene_has_body(&m->scene->node[i]);
    if (count == 0)
        return STATUS_OK;
    m->mesh.discrete = calloc((size_t)count, sizeof *m->mesh.discrete);
    if (m->mesh.discrete == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for rigid bodies and springs");
    for (int i = 0; i < m->scene->nodes; i++)
        if (scene_has_body(&m->scene->node[i])) {
            begin(1, &i, &m->mesh.discrete[m->mesh.discretes]);
            m->mesh.discrete[m->mesh.discretes++].body = &m->scene->node[i].body;
        }
    for (int i = 0; i < m->scene->springs; i++)
        add_spring(m, &m->scene->spring[i]);
    return STATUS_OK;
}

/* Of a spring in a state. */
typedef struct spring_state {
    double e[SPRING_STRAINS], sigma[SPRING_STRAINS], J[SPRING_STRAINS * X], H[X * X];
} spring_state;

static void spring_at(const model *m, const model_state *s, const mesh_discrete *d,
                      spring_state *out)
{
    node_state x[ELEMENT_MAX_NODES];
    const double *turn = turns_of_spring(m, s, (int)(d->spring - m->scene->spring));
    kinematics_gather(m, s, &d->el, x);
    spring_strain(d->el.nodes, x, turn, &(strain_output){.e = out->e, .J = out->J});
    dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, d->spring->stiffness, out->e, out->sigma);
    spring_strain(d->el.nodes, x, turn, &(strain_output){.s = out->sigma, .H = out->H});
}

/* Force and tangent at the nodes themselves; material: with J^T S J of springs. */
static void evaluate(const model *m, const model_state *s, const mesh_discrete *d,
                     const element_rotating_frame *frame, int material, double force[], double K[])
{
    const int n = NODE_COORDINATES * d->el.nodes;
    node_state x[ELEMENT_MAX_NODES];
    if (d->spring != NULL) {
        spring_state p;
        double work[SPRING_STRAINS * X];
        spring_at(m, s, d, &p);
        memset(force, 0, (size_t)n * sizeof *force);
        dense_add_transpose_mul(n, SPRING_STRAINS, 1, p.J, p.sigma, force);
        memcpy(K, p.H, (size_t)(n * n) * sizeof *K);
        if (material)
            dense_add_congruence(SPRING_STRAINS, n, p.J, d->spring->stiffness, K, work);
        return;
    }
    kinematics_gather(m, s, &d->el, x);
    body_inertia(d->body, x, frame, &(inertia_output){.force = force, .N = K});
    for (int k = 0; k < n; k++)
        force[k] = -force[k];
}

/* Force and tangent in model coordinates. */
static void eliminated(const model *m, const model_state *s, const mesh_discrete *d,
                       const element_rotating_frame *frame, int material, double force[],
                       double K[])
{
    evaluate(m, s, d, frame, material, force, K);
    eliminate_matrix(m, s, &d->el, force, K);
    eliminate_forces(m, s, &d->el, force);
}

void discrete_equations(const model *m, const model_state *s, const mesh_discrete *d,
                        const element_rotating_frame *frame, double force[], double K[])
{
    eliminated(m, s, d, frame, 1, force, K);
}

void discrete_inertia(const model *m, const model_state *s, const element_rotating_frame *frame,
                      sparse *M, sparse *G)
{
    for (int i = 0; i < m->mesh.discretes - m->mesh.springs; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        node_state x[ELEMENT_MAX_NODES];
        double mass[X * X], gyroscopic[X * X];
        kinematics_gather(m, s, &d->el, x);
        body_inertia(d->body, x, frame, &(inertia_output){.M = mass, .G = gyroscopic});
        eliminate_matrix(m, s, &d->el, NULL, mass);
        assemble_discrete(&d->el, mass, M);
        if (G == NULL)
            continue;
        eliminate_matrix(m, s, &d->el, NULL, gyroscopic);
        assemble_discrete(&d->el, gyroscopic, G);
    }
}

void discrete_material_product(const model *m, const model_state *s, const double x[], double y[])
{
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        const int n = NODE_COORDINATES * d->el.nodes;
        double local[X], e[SPRING_STRAINS], sigma[SPRING_STRAINS], force[X] = {0};
        spring_state p;
        spring_at(m, s, d, &p);
        kinematics_local(m, s, &d->el, x, local);
        dense_mul_vec(SPRING_STRAINS, n, p.J, local, e);
        dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, d->spring->stiffness, e, sigma);
        dense_add_transpose_mul(n, SPRING_STRAINS, 1, p.J, sigma, force);
        eliminate_forces(m, s, &d->el, force);
        assemble_vector(&d->el, force, y);
    }
}

void discrete_geometric(const model *m, const model_state *s, const element_rotating_frame *frame,
                        sparse *out)
{
    for (int i = 0; i < m->mesh.discretes; i++) {
        double force[X], K[X * X];
        eliminated(m, s, &m->mesh.discrete[i], frame, 0, force, K);
        assemble_discrete(&m->mesh.discrete[i].el, K, out);
    }
}

double discrete_material_rounding(const model *m, const model_state *s, const double x[])
{
    double sum = 0;
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        const int n = NODE_COORDINATES * d->el.nodes;
        double local[X], e[SPRING_STRAINS], sigma[SPRING_STRAINS];
        spring_state p;
        spring_at(m, s, d, &p);
        kinematics_local(m, s, &d->el, x, local);
        dense_mul_vec(SPRING_STRAINS, n, p.J, local, e);
        dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, d->spring->stiffness, e, sigma);
        for (int k = 0; k < SPRING_STRAINS; k++)
            for (int j = 0; j < n; j++)
                sum += DBL_EPSILON * 2 * fabs(sigma[k] * p.J[k * n + j] * local[j]);
    }
    return sum;
}

double discrete_stored(const model *m, const model_state *s)
{
    double sum = 0;
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        spring_state p;
        spring_at(m, s, &m->mesh.discrete[i], &p);
        sum += dense_dot(SPRING_STRAINS, p.e, p.sigma) / 2;
    }
    return sum;
}

void discrete_node_force(const model *m, const model_state *s, const element_rotating_frame *frame,
                         int node, double F[6])
{
    for (int i = 0; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        double force[X], K[X * X];
        evaluate(m, s, d, frame, 1, force, K);
        for (int k = 0; k < d->el.nodes; k++) {
            double *at = force + NODE_COORDINATES * k, rho[3];
            if (m->mesh.vertex[d->el.vertex[k]].body != node)
                continue;
            kinematics_offset(m, s, d->el.vertex[k], rho);
            if (d->el.vertex[k] != node)
                offset_force(rho, at);
            for (int c = 0; c < 6; c++)
                F[c] += at[c];
        }
    }
}
