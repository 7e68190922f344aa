#include "harness/newton/newton_impl.h"

#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/section/section.h"
#include "elements/shared/masses.h"

/* Returns `factor` times the factor of the load's case; `factor` for a load without a case. */
static double combined(const equations *eq, const scene_load *load, double factor)
{
    return load->load_case == SCENE_NONE
               ? factor
               : scene_acting_factor(model_scene(eq->m), eq->loading.acting, load->load_case) *
                     factor;
}

double applied_factor(const equations *eq, const scene_load *load, double path)
{
    double at[3];
    if (eq->loading.unloaded)
        return 0;
    if (!eq->loading.in_time)
        return combined(eq, load, along_path_factor(load, path));
    if (load->feedback.node != SCENE_NONE)
        return eq->run->feedback != NULL
                   ? combined(eq, load, eq->run->feedback[load - model_scene(eq->m)->load])
                   : 0;
    if (load->function.pieces == 0)
        return combined(eq, load, along_path_factor(load, eq->loading.held_path));
    function_at(&load->function, path, at);
    return combined(eq, load, at[0]);
}

double applied_rate(const equations *eq, const scene_load *load, double path)
{
    double at[3] = {0};
    if (eq->loading.unloaded)
        return 0;
    if (!eq->loading.in_time)
        return combined(eq, load, along_path_rate(load, path));
    if (load->function.pieces > 0)
        function_at(&load->function, path, at);
    return combined(eq, load, at[1]);
}

void applied_member_axes(const double triad[9], const section *of, double R[9])
{
    const double angle = of->axes_angle, c = cos(angle), d = sin(angle);
    memcpy(R, triad, 9 * sizeof(double));
    for (int i = 0; i < 9; i += 3) {
        const double y = R[i + 1];
        R[i + 1] = c * y - d * R[i + 2];
        R[i + 2] = c * R[i + 2] + d * y;
    }
}

/* Returns the force and moment of a load on one vertex, multiplied by `scale`. axes: axes of the
 * components of the load; NULL: global axes. beside: vector from the vertex to the point of
 * application, in global axes. */
static applied of_vertex(const model_state *s, int vertex, const scene_load *load, double scale,
                         const double axes[9], const double beside[3])
{
    applied out = {.vertex = vertex, .follower = load->follower};
    const int moment = scene_load_turns(load) ? 3 : 0;
    double v[3], at[3];
    memcpy(v, load->vector, sizeof v);
    memcpy(at, load->at, sizeof at);
    if (axes != NULL) {
        mat3_mul_vec(axes, load->vector, v);
        mat3_mul_vec(axes, load->at, at);
    }
    for (int i = 0; i < 3; i++)
        at[i] += beside[i];
    out.offset = vec3_norm(at) > 0;
    if (out.offset)
        rotation_apply(&s->q[4 * vertex], at, out.arm);
    if (load->follower) {
        memcpy(at, v, sizeof at);
        rotation_apply(&s->q[4 * vertex], at, v);
    }
    for (int i = 0; i < 3; i++)
        out.F[moment + i] = scale * v[i];
    return out;
}

static applied of_weight(const model *m, const model_state *s, const scene_load *load, double scale)
{
    const scene_body *body = &model_scene(m)->node[load->where].body;
    scene_load force = *load;
    for (int i = 0; i < 3; i++)
        force.vector[i] *= body->mass;
    return of_vertex(s, load->where, &force, scale, NULL, body->centre);
}

/* Returns the factor that makes the load vector a force per length of an element: the mass per
 * length for gravity, and 1 for other loads. */
static double density_of(const model *m, const scene_load *load, const mesh_element *el)
{
    const section *c = model_section(m, model_kind(m, el->kind)->section);
    return load->kind == SCENE_GRAVITY ? c->density * c->A : 1;
}

static void weight_centre(const model *m, const scene_load *load, const mesh_element *el, int node,
                          double centre[3])
{
    const section *c = model_section(m, model_kind(m, el->kind)->section);
    double at[3];
    memset(centre, 0, 3 * sizeof *centre);
    if (load->kind != SCENE_GRAVITY || !c->matrices)
        return;
    section_matrices_centre(c, at);
    mat3_mul_vec(el->triad[node], at, centre);
}

/* Smallest length of a loaded part of an element, relative to the element. A shorter part is due to
 * rounding and has no load. */
static const double least_part = 1e-12;

int applied_inside(double x)
{
    return x > least_part && x < 1 - least_part;
}

int applied_part(const model *m, int element, const scene_load *load, double part[2])
{
    const int member = model_element(m, element)->member;
    if (!scene_load_along(load) || load->where != member || load->kind == SCENE_TEMPERATURE)
        return 0;
    const int number = element - model_first_element(m, member);
    if (scene_load_within(load)) {
        const int at = division_at(model_division(m), member, load->range[0], 0, &part[0]);
        part[1] = part[0];
        return at == number;
    }
    for (int i = 0; i < 2; i++)
        part[i] = division_inside(model_division(m), member, number, load->range[i]);
    part[0] = fmax(part[0], 0);
    part[1] = fmin(part[1], 1);
    return part[1] - part[0] > least_part;
}

void applied_vector(const model *m, int element, const scene_load *load, double x, double vector[3])
{
    const int member = model_element(m, element)->member;
    memcpy(vector, load->vector, 3 * sizeof *vector);
    if (!load->varies)
        return;
    const double place = division_place(model_division(m), member,
                                        element - model_first_element(m, member), x),
                 along = (place - load->range[0]) / (load->range[1] - load->range[0]);
    for (int i = 0; i < 3; i++)
        vector[i] += along * (load->last[i] - load->vector[i]);
}

static double share_of(const model *m, int k, double x)
{
    double part[ELEMENT_MAX_NODES];
    lagrange_at(model_nodes(m), model_places(m), x, part, NULL);
    return part[k];
}

/* Computes quadrature points x and their weights for a load on a part of an element. Returns the
 * number of points. The quadrature is exact for the product of a linear load and a shape
 * function. */
static int points_of(const model *m, const scene_load *load, const double part[2], double x[],
                     double weight[])
{
    const int count = model_nodes(m) / 2 + 1;
    if (scene_load_within(load)) {
        x[0] = part[0];
        weight[0] = 1;
        return 1;
    }
    quadrature_points(count, x, weight);
    for (int i = 0; i < count; i++) {
        x[i] = part[0] + (part[1] - part[0]) * x[i];
        weight[i] *= part[1] - part[0];
    }
    return count;
}

int applied_with_mass(const scene_load *load)
{
    return !load->lumped && !load->varies && load->range[0] == 0 && load->range[1] == 1;
}

/* Computes the share of node k in the load on an element: the integral of the load vector times the
 * shape function over the part. */
static void share_at(const model *m, const scene_load *load, int element, const double part[2],
                     int k, double vector[3])
{
    const double length = scene_load_within(load) ? 1 : model_kind_of(m, element)->length;
    double x[ELEMENT_MAX_NODES], weight[ELEMENT_MAX_NODES];
    memset(vector, 0, 3 * sizeof *vector);
    if (!load->varies && !scene_load_within(load) && part[0] == 0 && part[1] == 1) {
        const double *share =
            applied_with_mass(load) ? model_element(m, element)->share : model_shares(m);
        for (int i = 0; i < 3; i++)
            vector[i] = share[k] * length * load->vector[i];
        return;
    }
    const int count = points_of(m, load, part, x, weight);
    for (int g = 0; g < count; g++) {
        double here[3];
        applied_vector(m, element, load, x[g], here);
        for (int i = 0; i < 3; i++)
            vector[i] += length * weight[g] * share_of(m, k, x[g]) * here[i];
    }
}

void applied_element(const model *m, const model_state *s, const scene_load *load, double scale,
                     int element, void (*take)(void *context, const applied *), void *context)
{
    const mesh_element *el = model_element(m, element);
    double part[2];
    if (!applied_part(m, element, load, part))
        return;
    for (int k = 0; k < model_nodes(m); k++) {
        double axes[9], centre[3];
        scene_load one = *load;
        share_at(m, load, element, part, k, one.vector);
        if (load->axes == SCENE_AXES_MEMBER)
            applied_member_axes(el->triad[k], model_section(m, model_kind(m, el->kind)->section),
                                axes);
        weight_centre(m, load, el, k, centre);
        const applied what = of_vertex(s, el->vertex[k], &one, scale * density_of(m, load, el),
                                       load->axes == SCENE_AXES_MEMBER ? axes : NULL, centre);
        take(context, &what);
    }
}

/* Returns the distance [m] between the nodes of a tension load. e: unit vector from the first node
 * to the second. */
static double line_of(const model *m, const model_state *s, const scene_load *load, double e[3])
{
    double from[3], to[3];
    kinematics_position(m, s, load->where, from);
    kinematics_position(m, s, load->towards, to);
    for (int i = 0; i < 3; i++)
        e[i] = to[i] - from[i];
    const double length = vec3_norm(e);
    for (int i = 0; i < 3; i++)
        e[i] /= length;
    return length;
}

void applied_each(const model *m, const model_state *s, const scene_load *load, double scale,
                  void (*take)(void *context, const applied *), void *context)
{
    if (load->towards != SCENE_NONE) {
        applied first = {.vertex = load->where}, second = {.vertex = load->towards};
        line_of(m, s, load, first.F);
        for (int i = 0; i < 3; i++) {
            first.F[i] *= scale * load->tension;
            second.F[i] = -first.F[i];
        }
        take(context, &first);
        take(context, &second);
        return;
    }
    if (!scene_load_along(load)) {
        static const double none[3] = {0, 0, 0};
        const applied one = load->kind == SCENE_WEIGHT
                                ? of_weight(m, s, load, scale)
                                : of_vertex(s, load->where, load, scale, NULL, none);
        take(context, &one);
        return;
    }
    for (int i = model_first_element(m, load->where); i < model_first_element(m, load->where + 1);
         i++)
        applied_element(m, s, load, scale, i, take, context);
}

typedef struct entries {
    const model *m;
    const model_state *s;
    loads_entry take;
    void *to;
} entries;

static void add_following(const entries *all, const mesh_vertex *body, const double F[6],
                          const double rho[3], double b[3][3], const double moved[3], int column)
{
    double force[3], moment[3], arm[3];
    vec3_cross(b[column], F, force);
    vec3_cross(b[column], F + 3, moment);
    vec3_cross(rho, force, arm);
    if (body->led)
        all->take(all->to, body->coordinate[3], body->coordinate[3 + column],
                  vec3_dot(moved, force));
    kinematics_to_own(body, force);
    for (int i = 0; i < 3; i++) {
        all->take(all->to, body->coordinate[i], body->coordinate[3 + column], force[i]);
        all->take(all->to, body->coordinate[3 + i], body->coordinate[3 + column],
                  vec3_dot(b[i], moment) + vec3_dot(b[i], arm));
    }
}

typedef struct load_motion {
    int coordinate;
    int own; /* 1: coordinate of the end; 0: coordinate of its body */
    /* 1: the rotation is one of three about fixed axes, whose order has no effect */
    int chart;
    double axis[3]; /* axis of a rotation */
    double turn[3]; /* rotation of the axes of the load per unit of the coordinate */
    double shift[3];
} load_motion;

/* Computes the motions in the order in which they act on the frame of the load: position and
 * rotations of the body, rotations of the end, and shifts of the end. */
static int motions_at_release(const entries *all, const applied *what,
                              load_motion out[KINEMATICS_MOST])
{
    const mesh_release *r = release_of(all->m, what->vertex);
    const int body = model_vertex(all->m, what->vertex)->body;
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST], of_body[6 * KINEMATICS_MOST];
    const int from_body = kinematics_node_jacobian(all->m, all->s, body, 6, index, of_body),
              count =
                  kinematics_node_jacobian(all->m, all->s, what->vertex, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++) {
        load_motion *to = &out[k];
        to->coordinate = index[k];
        to->own = k >= from_body;
        for (int i = 0; i < 3; i++) {
            to->turn[i] = T[(3 + i) * count + k];
            to->axis[i] = to->own ? to->turn[i] : of_body[(3 + i) * from_body + k];
        }
        vec3_cross(to->turn, what->arm, to->shift);
        for (int i = 0; i < 3; i++)
            to->shift[i] = T[i * count + k] + (what->offset ? to->shift[i] : 0);
        to->chart = vec3_norm(to->axis) > 0 &&
                    (to->own ? r->turns == 3 : model_vertex(all->m, body)->angles == 0);
    }
    return count;
}

/* Returns the fraction of rotation e that rotates the axis of l. 1: e precedes l. 0: e follows l,
 * or the end rotates independently of its body and exactly one of e and l belongs to the end. 1/2:
 * e and l have no order. */
static double carries(const mesh_release *r, const load_motion *e, const load_motion *l)
{
    if (r->turns == 3 && e->own != l->own)
        return 0;
    return e->chart && l->chart && e->own == l->own ? 0.5 : e < l;
}

static double triple(const double a[3], const double b[3], const double c[3])
{
    double cross[3];
    vec3_cross(b, c, cross);
    return vec3_dot(a, cross);
}

static double release_entry(const mesh_release *r, const applied *what, const load_motion *i,
                            const load_motion *j)
{
    const double *F = what->F, *M = F + 3, before = carries(r, j, i);
    double value = i == j ? triple(F, i->axis, i->shift)
                          : before * triple(F, j->axis, i->shift) +
                                carries(r, i, j) * triple(F, i->axis, j->shift);
    value += i == j ? 0 : before * triple(M, j->axis, i->turn);
    if (what->follower)
        value += triple(i->shift, j->turn, F) + triple(i->turn, j->turn, M);
    return value;
}

static void add_stiffness_at_release(const entries *all, const applied *what)
{
    load_motion motion[KINEMATICS_MOST];
    const int count = motions_at_release(all, what, motion);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            all->take(
                all->to, motion[i].coordinate, motion[j].coordinate,
                release_entry(release_of(all->m, what->vertex), what, &motion[i], &motion[j]));
}

static void add_stiffness(void *context, const applied *what)
{
    const entries *all = context;
    const double *F = what->F;
    if (release_of(all->m, what->vertex) != NULL) {
        add_stiffness_at_release(all, what);
        return;
    }
    const mesh_vertex *v = model_vertex(all->m, what->vertex),
                      *body = model_vertex(all->m, v->body);
    double rho[3], D[9], moment[3] = {0, 0, 0}, b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                         moved[3] = {0, 0, 0};
    if (body->led) {
        double inward[3];
        kinematics_arm(all->m, all->s, v->body, moved);
        vec3_cross(body->axis[0], moved, inward);
        all->take(all->to, body->coordinate[3], body->coordinate[3], vec3_dot(F, inward));
    }
    if (v->body == what->vertex && !what->offset && !what->follower && F[3] == 0 && F[4] == 0 &&
        F[5] == 0)
        return;
    kinematics_offset(all->m, all->s, what->vertex, rho);
    if (what->offset)
        for (int i = 0; i < 3; i++)
            rho[i] += what->arm[i];
    const double dot = vec3_dot(F, rho);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            D[3 * i + j] = (F[i] * rho[j] + rho[i] * F[j]) / 2 - (i == j ? dot : 0);
    if (body->angles > 0) {
        kinematics_axes(all->m, all->s, v->body, b);
        vec3_cross(rho, F, moment);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double Db[3], cross[3];
            mat3_mul_vec(D, b[j], Db);
            vec3_cross(b[j], b[i], cross);
            double value = vec3_dot(b[i], Db);
            if (body->angles > 0)
                value += (i > j ? 1 : -1) * vec3_dot(moment, cross) / 2 +
                         (j < i ? vec3_dot(F + 3, cross) : 0);
            else
                value += vec3_dot(F + 3, cross) / 2;
            all->take(all->to, body->coordinate[3 + i], body->coordinate[3 + j], value);
        }
    if (what->follower)
        for (int j = 0; j < 3; j++)
            add_following(all, body, F, rho, b, moved, j);
}

static void add_turning(const entries *all, const scene_load *load, double tension)
{
    const int node[] = {load->where, load->towards};
    int index[2 * KINEMATICS_MOST], count = 0;
    double e[3], apart[2 * KINEMATICS_MOST][3];
    const double length = line_of(all->m, all->s, load, e);
    for (int k = 0; k < 2; k++) {
        double T[6 * KINEMATICS_MOST];
        const int n =
            kinematics_node_jacobian(all->m, all->s, node[k], KINEMATICS_MOST, index + count, T);
        for (int c = 0; c < n; c++)
            for (int i = 0; i < 3; i++)
                apart[count + c][i] = (k == 0 ? -1 : 1) * T[i * n + c];
        count += n;
    }
    for (int a = 0; a < count; a++)
        for (int b = 0; b < count; b++)
            all->take(
                all->to, index[a], index[b],
                -tension / length *
                    (vec3_dot(apart[a], apart[b]) - vec3_dot(e, apart[a]) * vec3_dot(e, apart[b])));
}

void applied_stiffness(const model *m, const model_state *s, const scene_load *load, double scale,
                       loads_entry take, void *to)
{
    entries all = {m, s, take, to};
    applied_each(m, s, load, scale, add_stiffness, &all);
    if (load->towards != SCENE_NONE)
        add_turning(&all, load, scale * load->tension);
}
