#include "harness/model/discrete.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/body.h"
#include "harness/model/kinematics.h"
#include "harness/model/offset.h"

enum { X = ELEMENT_MAX_COORDINATES };

static void begin(const int nodes, const int vertex[], mesh_discrete *d)
{
    memset(d, 0, sizeof *d);
    d->el.kind = d->el.member = NONE;
    d->el.nodes = nodes;
    for (int k = 0; k < nodes; k++) {
        d->el.vertex[k] = vertex[k];
        d->el.warp[k] = NONE;
        for (int i = 0; i < 3; i++)
            d->el.triad[k][4 * i] = 1;
    }
}

status discrete_build(model *m, fault *f)
{
    int count = 0;
    for (int i = 0; i < m->scene->nodes; i++)
        count += scene_has_body(&m->scene->node[i]);
    if (count == 0)
        return STATUS_OK;
    m->discrete = calloc((size_t)count, sizeof *m->discrete);
    if (m->discrete == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for rigid bodies");
    for (int i = 0; i < m->scene->nodes; i++)
        if (scene_has_body(&m->scene->node[i])) {
            begin(1, &i, &m->discrete[m->discretes]);
            m->discrete[m->discretes++].body = &m->scene->node[i].body;
        }
    return STATUS_OK;
}

/* Force and tangent at the nodes themselves. */
static void evaluate(const model *m, const model_state *s, const mesh_discrete *d, double path,
                     double force[], double K[])
{
    const int n = NODE_COORDINATES * d->el.nodes;
    const element_spin spin = model_spin(m, path);
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, s, &d->el, x);
    body_inertia(d->body, x, &spin, &(inertia_output){.force = force, .N = K});
    for (int k = 0; k < n; k++)
        force[k] = -force[k];
}

void discrete_equations(const model *m, const model_state *s, const mesh_discrete *d, double path,
                        double force[], double K[])
{
    evaluate(m, s, d, path, force, K);
    eliminate_matrix(m, s, &d->el, force, K);
    eliminate_forces(m, s, &d->el, force);
}

void discrete_inertia(const model *m, const model_state *s, double path, sparse *M, sparse *G)
{
    const element_spin spin = model_spin(m, path);
    for (int i = 0; i < m->discretes; i++) {
        const mesh_discrete *d = &m->discrete[i];
        node_state x[ELEMENT_MAX_NODES];
        double mass[X * X], gyroscopic[X * X];
        kinematics_gather(m, s, &d->el, x);
        body_inertia(d->body, x, &spin, &(inertia_output){.M = mass, .G = gyroscopic});
        eliminate_matrix(m, s, &d->el, NULL, mass);
        assemble_discrete(&d->el, mass, M);
        if (G == NULL)
            continue;
        eliminate_matrix(m, s, &d->el, NULL, gyroscopic);
        assemble_discrete(&d->el, gyroscopic, G);
    }
}

void discrete_stiffness(const model *m, const model_state *s, double path, sparse *out)
{
    for (int i = 0; i < m->discretes; i++) {
        double force[X], K[X * X];
        discrete_equations(m, s, &m->discrete[i], path, force, K);
        assemble_discrete(&m->discrete[i].el, K, out);
    }
}

double discrete_energy2(const model *m, const model_state *s, double path, const double x[])
{
    double sum = 0;
    for (int i = 0; i < m->discretes; i++) {
        const mesh_element *el = &m->discrete[i].el;
        double force[X], K[X * X], own[X];
        discrete_equations(m, s, &m->discrete[i], path, force, K);
        for (int k = 0; k < NODE_COORDINATES * el->nodes; k++)
            own[k] = el->index[k] == NONE ? 0 : x[el->index[k]];
        sum += dense_quadratic(NODE_COORDINATES * el->nodes, K, own);
    }
    return sum;
}

void discrete_node_force(const model *m, const model_state *s, int node, double F[6])
{
    for (int i = 0; i < m->discretes; i++) {
        const mesh_discrete *d = &m->discrete[i];
        double force[X], K[X * X];
        evaluate(m, s, d, s->path, force, K);
        for (int k = 0; k < d->el.nodes; k++) {
            double *at = force + NODE_COORDINATES * k, rho[3];
            if (m->vertex[d->el.vertex[k]].body != node)
                continue;
            kinematics_offset(m, s, d->el.vertex[k], rho);
            if (d->el.vertex[k] != node)
                offset_force(rho, at);
            for (int c = 0; c < 6; c++)
                F[c] += at[c];
        }
    }
}
