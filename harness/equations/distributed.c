#include "harness/equations/distributed.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/section/matrices.h"
#include "harness/equations/equations_impl.h"
#include "harness/equations/loads.h"

static int acts(const model *m, int element, const scene_load *load)
{
    return scene_load_along(load) && load->where == m->element[element].member;
}

int distributed_acts(const distributed *of)
{
    if (of->m->rotates)
        return 1;
    for (int i = 0; i < of->m->scene->loads; i++)
        if (acts(of->m, of->element, &of->m->scene->load[i]))
            return 1;
    return 0;
}

/* The triad of the undeformed element at x. */
static void undeformed(const distributed *of, double x, double R[9])
{
    const mesh_element *el = &of->m->element[of->element];
    const mesh_kind *kind = &of->m->kind[el->kind];
    double turn[3], q[4], by[9];
    for (int i = 0; i < 3; i++)
        turn[i] = x * kind->length * kind->curvature[i];
    rotation_exp(turn, q);
    rotation_matrix(q, by);
    mat3_mul(el->triad[0], by, R);
}

/* Its vectors, in fixed axes, of the section with the triad R. */
static void add_load(const distributed *of, const scene_load *load, const double before[9],
                     const double R[9], span_load *out)
{
    const section *c = &of->m->section[of->m->kind[of->m->element[of->element].kind].section];
    const double scale =
        loads_factor(of->m, load, of->path) * (load->kind == SCENE_GRAVITY ? c->density * c->A : 1);
    double v[3], at[3], moved[3], turning[3], axes[9];
    memcpy(v, load->vector, sizeof v);
    memcpy(at, load->at, sizeof at);
    if (load->axes == SCENE_AXES_MEMBER) {
        applied_member_axes(before, c, axes);
        mat3_mul_vec(axes, load->vector, v);
        mat3_mul_vec(axes, load->at, at);
    }
    mat3_transpose_mul_vec(before, at, moved);
    if (load->kind == SCENE_GRAVITY && c->matrices)
        section_matrices_centre(c, moved);
    mat3_mul_vec(R, moved, at);
    if (load->follower) {
        mat3_transpose_mul_vec(before, v, moved);
        mat3_mul_vec(R, moved, v);
    }
    if (load->kind == SCENE_DISTRIBUTED_MOMENT) {
        for (int i = 0; i < 3; i++)
            out->moment[i] += scale * v[i];
        return;
    }
    vec3_cross(at, v, turning);
    for (int i = 0; i < 3; i++) {
        out->force[i] += scale * v[i];
        out->moment[i] += scale * turning[i];
    }
}

/* The same of a section by its matrices: momentum p and h of the velocity v of the line and of
 * omega, -omega x p and -omega x h - v x p on the line. */
static void add_rotating_matrices(const section *c, const double omega[3], const double speed[3],
                                  const double R[9], span_load *out)
{
    double v[6], p[6], force[3], momentum[3], turning[3], moving[3];
    mat3_transpose_mul_vec(R, speed, v);
    mat3_transpose_mul_vec(R, omega, v + 3);
    dense_mul_vec(6, 6, c->mass, v, p);
    mat3_mul_vec(R, p, momentum);
    vec3_cross(omega, momentum, force);
    vec3_cross(speed, momentum, moving);
    mat3_mul_vec(R, p + 3, momentum);
    vec3_cross(omega, momentum, turning);
    for (int i = 0; i < 3; i++) {
        out->force[i] -= force[i];
        out->moment[i] -= turning[i] + moving[i];
    }
}

/* Centrifugal force on the mass at the centroid, and moment on the section's inertia. */
static void add_rotating(const distributed *of, const span_frame *at, span_load *out)
{
    const model *m = of->m;
    const section *c = &m->section[m->kind[m->element[of->element].kind].section];
    const element_rotating_frame frame = model_rotating_frame(m, of->path);
    double arm[3], speed[3], force[3], inside[3], moment[3];
    const double inertia[3] = {c->Iy + c->Iz, c->Iy, c->Iz};
    for (int i = 0; i < 3; i++)
        arm[i] = at->r[i] - frame.centre[i];
    vec3_cross(frame.omega, arm, speed);
    if (c->matrices) {
        add_rotating_matrices(c, frame.omega, speed, at->R, out);
        return;
    }
    vec3_cross(frame.omega, speed, force);
    for (int i = 0; i < 3; i++)
        out->force[i] -= c->density * c->A * force[i];
    if (!(m->features & m->type->offers & FEATURE_ROTARY_INERTIA))
        return;
    mat3_transpose_mul_vec(at->R, frame.omega, inside);
    for (int i = 0; i < 3; i++)
        inside[i] *= c->density * inertia[i];
    mat3_mul_vec(at->R, inside, speed);
    vec3_cross(frame.omega, speed, moment);
    for (int i = 0; i < 3; i++)
        out->moment[i] -= moment[i];
}

void distributed_at(void *context, double x, const span_frame *at, span_load *out)
{
    const distributed *of = context;
    double before[9];
    memset(out, 0, sizeof *out);
    undeformed(of, x, before);
    for (int i = 0; i < of->m->scene->loads; i++)
        if (acts(of->m, of->element, &of->m->scene->load[i]))
            add_load(of, &of->m->scene->load[i], before, at->R, out);
    if (of->m->rotates)
        add_rotating(of, at, out);
}
