#include "harness/newton/newton_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/section/section.h"

int distributed_spreads(const equations *eq, const scene_load *load)
{
    const int lumped = load->lumped || eq->loading.lumps == LUMPS_LOADS ||
                       (eq->loading.lumps == LUMPS_WEIGHTS && load->kind == SCENE_GRAVITY);
    return scene_load_along(load) && !lumped;
}

int distributed_acts(const distributed_loads *of)
{
    double part[2];
    if (of->eq->loading.rotates)
        return 1;
    for (int i = 0; i < model_scene(of->m)->loads; i++)
        if (applied_part(of->m, of->element, &model_scene(of->m)->load[i], part))
            return 1;
    return 0;
}

int distributed_jumps(const distributed_loads *of)
{
    double part[2];
    for (int i = 0; i < model_scene(of->m)->loads; i++)
        if (applied_part(of->m, of->element, &model_scene(of->m)->load[i], part) &&
            (applied_inside(part[0]) || applied_inside(part[1])))
            return i;
    return SCENE_NONE;
}

static void undeformed(const distributed_loads *of, double x, double R[9])
{
    const mesh_element *el = model_element(of->m, of->element);
    const mesh_kind *kind = model_kind(of->m, el->kind);
    double turn[3], q[4], by[9];
    for (int i = 0; i < 3; i++)
        turn[i] = x * kind->length * kind->curvature[i];
    rotation_exp(turn, q);
    rotation_matrix(q, by);
    mat3_mul(el->triad[0], by, R);
}

/* Computes the load at x times `scale`, given the undeformed triad at x. The result is a force or
 * moment per length, or of a load at a point. */
static void load_at(const distributed_loads *of, const scene_load *load, double scale, double x,
                    const double before[9], field_load *out)
{
    const section *c = model_section(of->m, model_kind_of(of->m, of->element)->section);
    const double size = scale * (load->kind == SCENE_GRAVITY ? c->density * c->A : 1);
    double vector[3], at[3], v[3], axes[9];
    applied_vector(of->m, of->element, load, x, vector);
    for (int i = 0; i < 3; i++)
        v[i] = vector[i] = size * vector[i];
    memcpy(at, load->at, sizeof at);
    if (load->axes == SCENE_AXES_MEMBER) {
        applied_member_axes(before, c, axes);
        mat3_mul_vec(axes, vector, v);
        mat3_mul_vec(axes, load->at, at);
    }
    memset(out, 0, sizeof *out);
    mat3_transpose_mul_vec(before, at, out->arm);
    if (load->kind == SCENE_GRAVITY && c->matrices)
        section_matrices_centre(c, out->arm);
    out->follower = load->follower;
    double *of_kind = scene_load_turns(load) ? out->moment : out->force;
    if (load->follower)
        mat3_transpose_mul_vec(before, v, of_kind);
    else
        memcpy(of_kind, v, sizeof v);
}

enum { MOST = FIELD_MOST_POINTS };

/* Returns 1 if the force in global axes is the same at all points of the element, and the load has
 * no arm. one: value of the load at a point. */
static int same(const distributed_loads *of, const scene_load *load, const field_load *one)
{
    return !load->varies && !load->follower && vec3_norm(one->arm) == 0 &&
           (load->axes == SCENE_AXES_FIXED ||
            vec3_norm(model_kind_of(of->m, of->element)->curvature) == 0);
}

/* Computes acting[], the values of one load at quadrature points of an element times the weights of
 * the points. Returns the number of points. */
static int points_of(const distributed_loads *of, const scene_load *load, double scale,
                     const double part[2], field_rows rows[MOST], field_load acting[MOST])
{
    const mesh_kind *kind = model_kind_of(of->m, of->element);
    double x[MOST], weight[MOST], before[9];
    int count = 1;
    undeformed(of, part[0], before);
    load_at(of, load, scale, part[0], before, acting);
    memset(rows, 0, sizeof *rows);
    if (scene_load_within(load)) {
        field_at(&kind->field, part[0], rows);
        return 1;
    }
    if (same(of, load, acting) && part[0] == 0 && part[1] == 1) {
        field_gather(kind->length, &kind->field.whole, rows);
        return 1;
    }
    count = field_points(&kind->field, part[0], part[1], x, weight);
    for (int k = 0; k < count; k++) {
        const double size = scale * weight[k] * kind->length;
        undeformed(of, x[k], before);
        load_at(of, load, size, x[k], before, &acting[k]);
        field_at(&kind->field, x[k], &rows[k]);
    }
    return count;
}

/* Like points_of, for a type that computes the motion of its sections: Gauss points x[]. */
static int line_points_of(const distributed_loads *of, const scene_load *load, double scale,
                          const double part[2], double x[ELEMENT_ALONG_POINTS],
                          field_load acting[ELEMENT_ALONG_POINTS])
{
    const double length = model_kind_of(of->m, of->element)->length, wide = part[1] - part[0];
    const int count = scene_load_within(load) ? 1 : ELEMENT_ALONG_POINTS;
    double weight[ELEMENT_ALONG_POINTS] = {1}, before[9];
    x[0] = 0;
    if (count > 1)
        quadrature_points(count, x, weight);
    for (int k = 0; k < count; k++) {
        x[k] = part[0] + wide * x[k];
        undeformed(of, x[k], before);
        load_at(of, load, count > 1 ? scale * weight[k] * wide * length : scale, x[k], before,
                &acting[k]);
    }
    return count;
}

static int taken(const equations *eq, int element, const scene_load *load, const double part[2])
{
    const model *m = eq->m;
    const section *c = model_section(m, model_kind_of(m, element)->section);
    double centre[3] = {0};
    if (!model_takes_loads(m) || !distributed_spreads(eq, load) || scene_load_within(load) ||
        scene_load_turns(load) || load->follower)
        return 0;
    if (load->kind == SCENE_GRAVITY && c->matrices)
        section_matrices_centre(c, centre);
    return vec3_norm(load->at) + vec3_norm(centre) == 0 && !applied_inside(part[0]) &&
           !applied_inside(part[1]);
}

int distributed_takes(const equations *eq, int element, const scene_load *load)
{
    const model *m = eq->m;
    double part[2];
    return applied_part(m, element, load, part) && taken(eq, element, load, part);
}

/* Adds a load times `scale` to its values force[3 points] at the points of element_type.along. */
static void gather(const equations *eq, int element, const scene_load *load, double scale,
                   double force[3 * ELEMENT_ALONG_POINTS])
{
    const model *m = eq->m;
    const distributed_loads of = {eq, m, element, 0};
    double x[ELEMENT_ALONG_POINTS], weight[ELEMENT_ALONG_POINTS], before[9];
    quadrature_points(ELEMENT_ALONG_POINTS, x, weight);
    for (int k = 0; k < ELEMENT_ALONG_POINTS; k++) {
        field_load one;
        undeformed(&of, x[k], before);
        load_at(&of, load, scale, x[k], before, &one);
        for (int i = 0; i < 3; i++)
            force[3 * k + i] += one.force[i];
    }
}

void distributed_take(const equations *eq, int element, double path, distributed_taken *out)
{
    const model *m = eq->m;
    out->acts = 0;
    for (int i = 0; i < model_scene(m)->loads && model_takes_loads(m); i++) {
        const scene_load *load = &model_scene(m)->load[i];
        double part[2];
        if (!applied_part(m, element, load, part) || !taken(eq, element, load, part))
            continue;
        const double scale = applied_factor(eq, load, path);
        if (scale == 0)
            continue;
        if (!out->acts)
            memset(out->force, 0, sizeof out->force);
        out->acts = 1;
        gather(eq, element, load, scale, out->force);
    }
    out->out = (along_output){.force = out->force, .mixed = out->mixed};
}

void distributed_add_taken(const model *m, const along_output *out, const double J[],
                           const double gap[], double forces[], double K[])
{
    enum { X = ELEMENT_ALONG_COORDINATES };
    double moment[3], work[ELEMENT_MAX_STRAINS * X], of[X * X] = {0}, both[X * X] = {0};
    memcpy(moment, out->moment, sizeof moment);
    if (gap != NULL)
        dense_add_transpose_mul(3, model_strains(m), 1, out->mixed, gap, moment);
    for (int j = 0; j < X; j++) {
        forces[j] += out->ends[j];
        for (int i = 0; i < 3; i++)
            forces[j] -= out->turn[i * X + j] * moment[i];
    }
    if (K == NULL)
        return;
    dense_mul(model_strains(m), 3, X, out->mixed, out->turn, work);
    dense_add_transpose_mul(X, model_strains(m), X, J, work, both);
    dense_add_congruence(3, X, out->turn, out->second, of, work);
    for (int i = 0; i < X; i++)
        for (int j = 0; j < X; j++)
            K[i * X + j] += out->H[i * X + j] + of[i * X + j] + both[i * X + j] + both[j * X + i];
}

int distributed_add_own(const equations *eq, const model_state *s, const node_state x[],
                        int element, double path, double forces[], double K[])
{
    const model *m = eq->m;
    enum { S = ELEMENT_MAX_STRAINS, X = ELEMENT_ALONG_COORDINATES };
    const size_t first = (size_t)element * (size_t)model_strains(m);
    const element_data *data = model_kind_of(m, element)->data;
    const int linear = s == kinematics_rest(m);
    distributed_taken of;
    double J[S * X], D[S], sigma[S], C[S * S], H[X * X], work[S * X];
    status outcome;
    distributed_take(eq, element, path, &of);
    if (!of.acts)
        return 0;
    model_type(m)->strain(
        data, x, &(strain_output){.e = D, .J = J, .history = model_history_of(m, s, element)});
    free_strain_subtract(eq, element, path, D);
    of.out.sigma = sigma;
    of.out.C = K != NULL || !linear ? C : NULL;
    of.out.H = K != NULL ? of.H : NULL;
    if (!linear) {
        of.out.e = &s->e[first];
        of.out.inner = &s->inner[(size_t)element * (size_t)model_inner(m)];
    }
    const element_data *unstressed = linear ? data : free_strain_data(eq, element, path);
    model_type(m)->along(1, &unstressed, x, &of.out, &outcome);
    for (int k = 0; k < model_strains(m) && !linear; k++)
        D[k] -= s->e[first + (size_t)k];
    distributed_add_taken(m, &of.out, J, linear ? NULL : D, forces, K);
    if (!linear)
        return 1;
    dense_mul_vec(model_strains(m), 1, sigma, (const double[]){-1}, D);
    dense_add_transpose_mul(X, model_strains(m), 1, J, D, forces);
    if (K == NULL)
        return 1;
    model_type(m)->strain(
        data, x, &(strain_output){.s = sigma, .H = H, .history = model_history_of(m, s, element)});
    dense_add_congruence(model_strains(m), X, J, C, K, work);
    for (int k = 0; k < X * X; k++)
        K[k] += H[k];
    return 1;
}

int distributed_stress(const equations *eq, const model_state *s, const node_state x[], int element,
                       double path, const stress_output *out, status *outcome)
{
    const model *m = eq->m;
    const element_data *data = free_strain_data(eq, element, path);
    distributed_taken of;
    distributed_take(eq, element, path, &of);
    if (!of.acts)
        return 0;
    of.out.sigma = out->sigma;
    of.out.C = out->C;
    of.out.e = &s->e[(size_t)element * (size_t)model_strains(m)];
    of.out.inner = &s->inner[(size_t)element * (size_t)model_inner(m)];
    model_type(m)->along(1, &data, x, &of.out, outcome);
    return 1;
}

static void add_rate(const equations *eq, const model_state *s, const node_state x[], int element,
                     const scene_load *load, double scale, double forces[])
{
    const model *m = eq->m;
    enum { S = ELEMENT_MAX_STRAINS, X = ELEMENT_ALONG_COORDINATES };
    const element_data *data = s == kinematics_rest(m) ? model_kind_of(m, element)->data
                                                       : free_strain_data(eq, element, s->path);
    distributed_taken of;
    double rate[3 * ELEMENT_ALONG_POINTS] = {0}, J[S * X], sigma[S], work[X] = {0};
    status outcome;
    distributed_take(eq, element, s->path, &of);
    if (!of.acts)
        memset(of.force, 0, sizeof of.force);
    gather(eq, element, load, scale, rate);
    of.out.sigma = sigma;
    of.out.rate = rate;
    if (s == kinematics_rest(m)) {
        of.out.rate = NULL;
        of.out.force = rate;
    } else {
        of.out.e = &s->e[(size_t)element * (size_t)model_strains(m)];
        of.out.inner = &s->inner[(size_t)element * (size_t)model_inner(m)];
    }
    model_type(m)->strain(data, x,
                          &(strain_output){.J = J, .history = model_history_of(m, s, element)});
    model_type(m)->along(1, &data, x, &of.out, &outcome);
    dense_add_transpose_mul(X, model_strains(m), 1, J, sigma, work);
    for (int k = 0; k < X; k++)
        forces[k] -= work[k];
    distributed_add_taken(m, &of.out, J, NULL, forces, NULL);
}

static void add_field_wide(const model *m, const displacement_field *field, const node_state x[],
                           int count, const field_rows rows[], const field_load acting[],
                           double forces[], double K[])
{
    double own[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES] = {0};
    const int all = model_own_coordinates(m);
    field_add_loads(field, x, count, rows, acting, forces, own);
    dense_widen(NODE_COORDINATES * model_nodes(m), all, own);
    for (int i = 0; i < all * all; i++)
        K[i] += own[i];
}

static int add_field(const equations *eq, const node_state x[], int element, const scene_load *load,
                     double scale, const double part[2], double forces[], double K[])
{
    const model *m = eq->m;
    const distributed_loads of = {eq, m, element, 0};
    field_rows rows[MOST];
    field_load acting[MOST];
    if (model_type(m)->line != NULL) {
        double at[ELEMENT_ALONG_POINTS];
        const int points = line_points_of(&of, load, scale, part, at, acting);
        line_add_loads(m, element, x, points, at, acting, forces, K);
        return 1;
    }
    const int count = points_of(&of, load, scale, part, rows, acting);
    const displacement_field *field = &model_kind_of(m, element)->field;
    if (K != NULL && model_scalars(m) > 0)
        add_field_wide(m, field, x, count, rows, acting, forces, K);
    else
        field_add_loads(field, x, count, rows, acting, forces, K);
    return 1;
}

int distributed_add_one(const equations *eq, const model_state *s, const node_state x[],
                        int element, const scene_load *load, double scale, double forces[],
                        double K[])
{
    const model *m = eq->m;
    double part[2];
    if (!applied_part(m, element, load, part) || scale == 0)
        return 0;
    if (!taken(eq, element, load, part))
        return add_field(eq, x, element, load, scale, part, forces, K);
    add_rate(eq, s, x, element, load, scale, forces);
    return 1;
}

int distributed_add_field(const equations *eq, const node_state x[], int element, double path,
                          double forces[], double K[])
{
    const model *m = eq->m;
    int acting = 0;
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        double part[2];
        if (!distributed_spreads(eq, load) || !applied_part(m, element, load, part) ||
            taken(eq, element, load, part))
            continue;
        const double scale = applied_factor(eq, load, path);
        acting |= scale != 0 && add_field(eq, x, element, load, scale, part, forces, K);
    }
    return acting;
}

int distributed_add(const equations *eq, const model_state *s, const node_state x[], int element,
                    double path, double forces[], double K[])
{
    const int acting = distributed_add_field(eq, x, element, path, forces, K);
    return distributed_add_own(eq, s, x, element, path, forces, K) || acting;
}

/* Adds the force and moment of a load per length at x, in global axes, on the section with triad R.
 */
static void add_load(const distributed_loads *of, const scene_load *load, double x,
                     const double before[9], const double R[9], span_load *out)
{
    field_load one;
    double at[3], v[3], moment[3], turning[3];
    load_at(of, load, applied_factor(of->eq, load, of->path), x, before, &one);
    mat3_mul_vec(R, one.arm, at);
    memcpy(v, one.force, sizeof v);
    memcpy(moment, one.moment, sizeof moment);
    if (one.follower) {
        mat3_mul_vec(R, one.force, v);
        mat3_mul_vec(R, one.moment, moment);
    }
    vec3_cross(at, v, turning);
    for (int i = 0; i < 3; i++) {
        out->force[i] += v[i];
        out->moment[i] += moment[i] + turning[i];
    }
}

/* Like add_rotating, for a section given by matrices. With momentum p and angular momentum h per
 * length, velocity v of the line and angular velocity omega, the load on the line is -omega x p,
 * and the moment is -omega x h - v x p. */
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

static void add_rotating(const distributed_loads *of, const span_frame *at, span_load *out)
{
    const model *m = of->m;
    const section *c = model_section(m, model_kind_of(m, of->element)->section);
    const element_rotating_frame frame = loading_frame(&of->eq->loading, of->path);
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
    if (!(model_features(m) & model_type(m)->offers & FEATURE_ROTARY_INERTIA))
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
    const distributed_loads *of = context;
    double before[9];
    memset(out, 0, sizeof *out);
    undeformed(of, x, before);
    for (int i = 0; i < model_scene(of->m)->loads; i++) {
        const scene_load *load = &model_scene(of->m)->load[i];
        double part[2];
        if (applied_part(of->m, of->element, load, part) && !scene_load_within(load))
            add_load(of, load, x, before, at->R, out);
    }
    if (of->eq->loading.rotates)
        add_rotating(of, at, out);
}
