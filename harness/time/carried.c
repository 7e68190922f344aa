#include "harness/time/carried.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/shared/lumped.h"
#include "harness/model/model.h"

/* Tensor of a mass at r: mass (r.r 1 - r r^T). */
static void add_point(double mass, const double r[3], double tensor[9])
{
    const double square = vec3_dot(r, r);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[3 * i + j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
}

/* Of a mass about r, with its first moment from there. */
static void shift(double mass, const double moment[3], const double r[3], double tensor[9])
{
    add_point(mass, r, tensor);
    const double mixed = 2 * vec3_dot(r, moment);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[3 * i + j] += (i == j ? mixed : 0) - r[i] * moment[j] - moment[i] * r[j];
}

/* What a vertex carries goes to the frame that moves it; a released end keeps its own. */
static void take(const model *m, int vertex, double mass, const double moment[3],
                 const double tensor[9], carried_mass of[])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const int released = vertex >= model_first_release(m);
    const double none[3] = {0, 0, 0}, *offset = released ? none : v->offset;
    carried_mass *to = &of[released ? vertex : v->body];
    double moved[9];
    memcpy(moved, tensor, sizeof moved);
    shift(mass, moment, offset, moved);
    to->mass += mass;
    for (int i = 0; i < 3; i++)
        to->moment[i] += moment[i] + mass * offset[i];
    for (int i = 0; i < 9; i++)
        to->inertia[i] += moved[i];
}

/* In axes of the triad. */
static void lump(const lumped_mass *l, double share, double moment[3], double tensor[9])
{
    memset(moment, 0, 3 * sizeof *moment);
    memset(tensor, 0, 9 * sizeof *tensor);
    for (int i = 0; i < 3; i++) {
        tensor[4 * i] = share * l->rotary[i];
        moment[i] = l->vectors > 0 ? share * l->mass * l->vector[0][i] : 0;
    }
    for (int k = 0; k < l->vectors; k++)
        add_point(share * l->carried[k], l->vector[k], tensor);
}

static void turn(const double triad[9], const double moment[3], const double tensor[9],
                 double out_moment[3], double out_tensor[9])
{
    double half[9], transposed[9];
    mat3_mul_vec(triad, moment, out_moment);
    mat3_mul(triad, tensor, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            transposed[3 * i + j] = triad[3 * j + i];
    mat3_mul(half, transposed, out_tensor);
}

void carried_share(const model *m, const mesh_element *el, int node, carried_mass *out,
                   double *warping)
{
    const mesh_kind *kind = model_kind(m, el->kind);
    const lumped_mass whole =
        lumped_of(model_section(m, kind->section), model_features(m), kind->length);
    const double share = el->share[node];
    double moment[3], tensor[9];
    lump(&whole, share, moment, tensor);
    turn(el->triad[node], moment, tensor, out->moment, out->inertia);
    out->frame = el->vertex[node];
    out->mass = share * whole.mass;
    *warping = share * whole.warping;
}

static void add_element(const model *m, const mesh_element *el, carried_mass of[], double warping[])
{
    for (int k = 0; k < el->nodes; k++) {
        carried_mass share;
        double of_warping;
        carried_share(m, el, k, &share, &of_warping);
        take(m, el->vertex[k], share.mass, share.moment, share.inertia, of);
        if (el->warp[k] != NONE)
            warping[model_warp(m, el->warp[k])] += of_warping;
    }
}

static void add_body(const model *m, const mesh_discrete *d, carried_mass of[])
{
    const scene_body *b = d->body;
    const double *J = b->inertia;
    const double none[3] = {0, 0, 0};
    double tensor[9] = {J[0], J[3], J[5], J[3], J[1], J[4], J[5], J[4], J[2]}, moment[3];
    shift(b->mass, none, b->centre, tensor);
    for (int i = 0; i < 3; i++)
        moment[i] = b->mass * b->centre[i];
    take(m, d->el.vertex[0], b->mass, moment, tensor, of);
}

/* Frames without mass are left out. */
static void keep_heavy(const model *m, carried_mass of[], carried_masses *out)
{
    for (int i = 0; i < model_vertices(m); i++) {
        double size = of[i].mass;
        for (int k = 0; k < 3; k++)
            size += of[i].inertia[4 * k];
        if (size <= 0)
            continue;
        out->total += of[i].mass;
        out->mass[out->masses] = of[i];
        out->mass[out->masses++].frame = i;
    }
}

static status alloc(const model *m, int spread, carried_masses *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->spread = spread;
    out->mass = calloc((size_t)model_vertices(m) + 1, sizeof *out->mass);
    out->warping = calloc((size_t)model_all_coordinates(m) + 1, sizeof *out->warping);
    if (out->mass == NULL || out->warping == NULL) {
        carried_free(out);
        return fault_set(f, STATUS_FAULT, "out of memory for masses");
    }
    for (int i = 0; i < model_elements(m) && !spread; i++)
        add_element(m, model_element(m, i), out->mass, out->warping);
    for (int i = 0; i < model_discretes(m) - model_springs(m); i++)
        add_body(m, model_discrete(m, i), out->mass);
    keep_heavy(m, out->mass, out);
    return STATUS_OK;
}

status carried_alloc(const model *m, carried_masses *out, fault *f)
{
    return alloc(m, 0, out, f);
}

status carried_alloc_spread(const model *m, carried_masses *out, fault *f)
{
    return alloc(m, 1, out, f);
}

void carried_free(carried_masses *c)
{
    free(c->mass);
    free(c->warping);
    memset(c, 0, sizeof *c);
}
