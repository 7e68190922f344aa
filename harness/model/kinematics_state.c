/* States of a model: one block of numbers each. */
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"

const model_state *kinematics_rest(const model *m)
{
    return m->rest;
}

double kinematics_state_path(const model_state *s)
{
    return s->path;
}

const double *kinematics_strains(const model_state *s)
{
    return s->e;
}

/* With a block of so many doubles. */
static status block_alloc(size_t size, model_state **out, fault *f)
{
    model_state *s = *out = calloc(1, sizeof *s);
    if (s != NULL)
        s->block = calloc(size + 1, sizeof *s->block);
    if (s != NULL && s->block != NULL) {
        s->size = size;
        return STATUS_OK;
    }
    free(s);
    *out = NULL;
    return fault_set(f, STATUS_FAULT, "out of memory for a state");
}

status kinematics_nodes_alloc(const model *m, const model_state *from, model_state **out, fault *f)
{
    const size_t N = (size_t)m->scene->nodes, drivers = (size_t)m->scene->drivers;
    const size_t turns = 3 * (size_t)m->mesh.turns;
    TRY(block_alloc(10 * N + drivers + turns, out, f));
    model_state *s = *out;
    s->path = from->path;
    s->u = s->block;
    s->q = s->u + 3 * N;
    s->angle = s->q + 4 * N;
    s->driver = s->angle + 3 * N;
    s->turn = s->driver + drivers;
    memcpy(s->u, from->u, 3 * N * sizeof *s->u);
    memcpy(s->q, from->q, 4 * N * sizeof *s->q);
    memcpy(s->angle, from->angle, 3 * N * sizeof *s->angle);
    memcpy(s->driver, from->driver, drivers * sizeof *s->driver);
    memcpy(s->turn, from->turn, turns * sizeof *s->turn);
    return STATUS_OK;
}

status kinematics_state_alloc(const model *m, model_state **out, fault *f)
{
    const size_t V = (size_t)m->mesh.vertices, E = (size_t)m->mesh.elements;
    TRY(block_alloc(
        V * 10 + 3 * (size_t)m->mesh.releases + (size_t)m->mesh.warps + (size_t)m->scene->drivers +
            E * (size_t)(2 * m->mesh.strains + m->mesh.inner) + 3 * (size_t)m->mesh.turns,
        out, f));
    model_state *s = *out;
    s->u = s->block;
    s->q = s->u + 3 * V;
    s->angle = s->q + 4 * V;
    s->shift = s->angle + 3 * V;
    s->warp = s->shift + 3 * m->mesh.releases;
    s->driver = s->warp + m->mesh.warps;
    s->e = s->driver + m->scene->drivers;
    s->sigma = s->e + E * (size_t)m->mesh.strains;
    s->inner = s->sigma + E * (size_t)m->mesh.strains;
    s->turn = s->inner + E * (size_t)m->mesh.inner;
    for (size_t i = 0; i < V; i++)
        rotation_identity(&s->q[4 * i]);
    if (m->mesh.type->rest != NULL)
        for (size_t i = 0; i < E; i++)
            m->mesh.type->rest(m->mesh.kind[m->mesh.element[i].kind].data,
                               &s->inner[i * (size_t)m->mesh.inner]);
    return STATUS_OK;
}

void kinematics_state_free(model_state *s)
{
    if (s == NULL)
        return;
    free(s->block);
    free(s);
}

void kinematics_state_copy(const model *m, const model_state *from, model_state *to)
{
    (void)m;
    memcpy(to->block, from->block, from->size * sizeof *from->block);
    to->path = from->path;
}
