#include "harness/newton/newton_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* Largest asymmetry of the stiffness of a moment that is a rounding error, relative to the moment.
 */
static const double potential = 1e-12;

/* Returns bits LUMPS_* of an analysis. In a motion with lumped mass, weights are lumped at the
 * nodes of elements; with the conserving scheme, all loads are. An analysis from which such a
 * motion starts lumps the same loads. */
static int lumps_of(const model *m, int analysis)
{
    const scene *s = model_scene(m);
    const scene_analysis *a = &s->analysis[analysis];
    int lumps = LUMPS_NOTHING;
    if (a->kind == SCENE_MOTION && !model_spreads(m, analysis))
        lumps = a->of.motion.scheme == SCENE_CONSERVING ? LUMPS_LOADS : LUMPS_WEIGHTS;
    for (int later = analysis + 1; later < s->analyses; later++) {
        const int then =
            s->analysis[later].follows == analysis ? lumps_of(m, later) : LUMPS_NOTHING;
        lumps = then > lumps ? then : lumps;
    }
    return lumps;
}

loading loading_of(const model *m, int analysis)
{
    const scene *s = model_scene(m);
    const scene_analysis *own = &s->analysis[analysis],
                         *a = own->follows == SCENE_NONE || own->kind == SCENE_MOTION
                                  ? own
                                  : &s->analysis[own->follows];
    const scene_rotating_frame *frame = scene_rotating_frame_of(a);
    const int instant = !isnan(scene_instant_of(s, analysis));
    loading l = {.in_time = own->kind == SCENE_MOTION || instant,
                 .held_path = 1,
                 .acting = scene_acting_of(s, analysis)};
    l.lumps = lumps_of(m, instant ? own->follows : analysis);
    l.rotation_follows_path = a->kind == SCENE_ROTATION;
    if (frame == NULL)
        return l;
    memcpy(l.frame.omega, frame->omega, sizeof l.frame.omega);
    memcpy(l.frame.centre, frame->centre, sizeof l.frame.centre);
    l.rotates = frame->omega[0] != 0 || frame->omega[1] != 0 || frame->omega[2] != 0;
    return l;
}

double loads_driver_value(const equations *eq, const scene_driver *d, double path)
{
    double at[3];
    loads_driver_rates(eq, d, path, at);
    return at[0];
}

void loads_driver_rates(const equations *eq, const scene_driver *d, double path, double out[3])
{
    out[0] = out[1] = out[2] = 0;
    if (eq->loading.unloaded)
        return;
    if (!eq->loading.in_time)
        out[0] = along_path_value(d, path);
    else if (d->function.pieces > 0)
        function_at(&d->function, path, out);
    else
        out[0] = along_path_value(d, eq->loading.held_path);
    for (int i = 0; d->load_case != SCENE_NONE && i < 3; i++)
        out[i] *= scene_acting_factor(model_scene(eq->m), eq->loading.acting, d->load_case);
}

typedef struct sum_of_loads {
    const model *m;
    const model_state *s;
    double *out;
} sum_of_loads;

static void add_applied(void *context, const applied *what)
{
    const sum_of_loads *sum = context;
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST], F[6], moment[3];
    const int n = kinematics_node_jacobian(sum->m, sum->s, what->vertex, KINEMATICS_MOST, index, T);
    memcpy(F, what->F, sizeof F);
    if (what->offset) {
        vec3_cross(what->arm, F, moment);
        for (int i = 0; i < 3; i++)
            F[3 + i] += moment[i];
    }
    for (int k = 0; k < n; k++)
        for (int i = 0; i < 6; i++)
            sum->out[index[k]] += T[i * n + k] * F[i];
}

static void add_at_vertices(const model *m, const model_state *s, const scene_load *load,
                            double scale, double out[])
{
    sum_of_loads sum = {m, s, out};
    applied_each(m, s, load, scale, add_applied, &sum);
}

static void add_within(const equations *eq, const model_state *s, const scene_load *load,
                       double scale, double out[])
{
    const model *m = eq->m;
    for (int i = model_first_element(m, load->where); i < model_first_element(m, load->where + 1);
         i++) {
        node_state x[ELEMENT_MAX_NODES];
        double forces[MODEL_MAX_COORDINATES] = {0};
        kinematics_gather(m, s, model_element(m, i), x);
        if (!distributed_add_one(eq, s, x, i, load, scale, forces, NULL))
            continue;
        eliminate_forces(m, s, model_element(m, i), forces);
        assemble_vector(model_element(m, i), forces, out);
    }
}

void loads_add_one(const equations *eq, const model_state *s, const scene_load *load, double scale,
                   double out[])
{
    const model *m = eq->m;
    if (distributed_spreads(eq, load))
        add_within(eq, s, load, scale, out);
    else
        add_at_vertices(m, s, load, scale, out);
}

void loads_add_at_vertices(const equations *eq, const model_state *s, double path, double out[])
{
    const model *m = eq->m;
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        if (!distributed_spreads(eq, load))
            add_at_vertices(m, s, load, applied_factor(eq, load, path), out);
    }
}

void loads_add(const equations *eq, const model_state *s, double path, double out[])
{
    const model *m = eq->m;
    for (int i = 0; i < model_scene(m)->loads; i++)
        loads_add_one(eq, s, &model_scene(m)->load[i],
                      applied_factor(eq, &model_scene(m)->load[i], path), out);
}

static status tangent_of(const equations *eq, const model_state *s, const node_state x[],
                         int element, double C[])
{
    const model *m = eq->m;
    const int rest = s == kinematics_rest(m);
    double sigma[ELEMENT_MAX_STRAINS];
    stress_output out = {.sigma = sigma, .C = C, .history = model_history_of(m, s, element)};
    status outcome;
    if (model_takes_loads(m) && !rest &&
        distributed_stress(eq, s, x, element, s->path, &out, &outcome))
        return outcome;
    return model_type(m)->stress(rest ? model_kind_of(m, element)->data
                                      : free_strain_data(eq, element, s->path),
                                 &s->e[(size_t)element * (size_t)model_strains(m)],
                                 &s->inner[(size_t)element * (size_t)model_inner(m)], &out);
}

void loads_add_temperature(const equations *eq, const model_state *s, const scene_load *load,
                           double scale, double out[])
{
    const model *m = eq->m;
    enum { S = ELEMENT_MAX_STRAINS };
    if (load->kind != SCENE_TEMPERATURE)
        return;
    for (int i = model_first_element(m, load->where); i < model_first_element(m, load->where + 1);
         i++) {
        const mesh_element *el = model_element(m, i);
        double e[S], sigma[S], C[S * S], J[S * ELEMENT_MAX_COORDINATES],
            force[MODEL_MAX_COORDINATES] = {0};
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, el, x);
        if (!free_strain_by_load(eq, s, i, load, scale, e) ||
            tangent_of(eq, s, x, i, C) != STATUS_OK)
            continue;
        dense_mul_vec(model_strains(m), model_strains(m), C, e, sigma);
        model_type(m)->strain(model_kind(m, el->kind)->data, x,
                              &(strain_output){.J = J, .history = model_history_of(m, s, i)});
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J, sigma, force);
        eliminate_forces(m, s, el, force);
        assemble_vector(el, force, out);
    }
}

void loads_rate(const equations *eq, const model_state *s, double path, double out[])
{
    const model *m = eq->m;
    memset(out, 0, (size_t)model_all_coordinates(m) * sizeof *out);
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        loads_add_one(eq, s, load, applied_rate(eq, load, path), out);
        loads_add_temperature(eq, s, load, applied_rate(eq, load, path), out);
    }
}

void loads_stiffness_at_vertices(const equations *eq, const model_state *s, double path,
                                 loads_entry take, void *context)
{
    const model *m = eq->m;
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        if (!distributed_spreads(eq, load))
            applied_stiffness(m, s, load, applied_factor(eq, load, path), take, context);
    }
}

static void into_sparse(void *K, int row, int column, double value)
{
    assemble_subtract(K, row, column, value);
}

void loads_subtract_at_vertices(const equations *eq, const model_state *s, double path, sparse *K)
{
    loads_stiffness_at_vertices(eq, s, path, into_sparse, K);
}

void loads_subtract_stiffness(const equations *eq, const model_state *s, double path, sparse *K)
{
    const model *m = eq->m;
    loads_subtract_at_vertices(eq, s, path, K);
    for (int i = 0; i < model_elements(m); i++) {
        node_state x[ELEMENT_MAX_NODES];
        const size_t n = (size_t)model_own_coordinates(m);
        double forces[ELEMENT_MAX_COORDINATES] = {0},
               part[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        memset(part, 0, n * n * sizeof *part);
        kinematics_gather(m, s, model_element(m, i), x);
        if (!distributed_add(eq, s, x, i, path, forces, part))
            continue;
        for (int k = 0; k < model_own_coordinates(m); k++)
            forces[k] = -forces[k];
        eliminate_matrix(m, s, model_element(m, i), forces, part);
        assemble_matrix(assemble_of(eq->run->patterns, K), i, part, K);
    }
}

/* Largest number of stiffness entries of a load at free coordinates; all of them belong to one
 * body. */
enum { MOST_ENTRIES = 64 };
typedef struct entries_of_load {
    int free, count, row[MOST_ENTRIES], column[MOST_ENTRIES];
    double value[MOST_ENTRIES];
} entries_of_load;

static void into_list(void *context, int row, int column, double value)
{
    entries_of_load *e = context;
    if (row < 0 || column < 0 || row >= e->free || column >= e->free || e->count == MOST_ENTRIES)
        return;
    e->row[e->count] = row;
    e->column[e->count] = column;
    e->value[e->count++] = value;
}

static double skew_of(const entries_of_load *e)
{
    double largest = 0;
    for (int i = 0; i < e->count; i++) {
        double sum = 0;
        for (int k = 0; k < e->count; k++) {
            const int same = e->row[k] == e->row[i] && e->column[k] == e->column[i],
                      turned = e->row[k] == e->column[i] && e->column[k] == e->row[i];
            sum += (same - turned) * e->value[k];
        }
        largest = fmax(largest, fabs(sum));
    }
    return largest;
}

status loads_have_potential(const equations *eq, const model_state *s, double path, fault *f)
{
    const model *m = eq->m;
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        entries_of_load e = {.free = model_unknowns(m)};
        if (load->kind != SCENE_MOMENT)
            continue;
        applied_stiffness(m, s, load, applied_factor(eq, load, path), into_list, &e);
        if (skew_of(&e) > potential * vec3_norm(load->vector))
            return fault_set(
                f, STATUS_REFUSED,
                "%s, a moment about fixed axes, has no potential at %s, which is free to rotate "
                "about two perpendicular axes; fix one of these rotations, or follow a static path",
                scene_called(model_scene(m), SCENE_LOADS, i).text,
                scene_called(model_scene(m), SCENE_NODES, load->where).text);
    }
    return STATUS_OK;
}

void loads_release_moment(const model *m, const model_state *s, int node, const double M[3],
                          sparse *K)
{
    const mesh_vertex *v = model_vertex(m, node);
    double b[3][3];
    if (v->angles == 0)
        return;
    kinematics_axes(m, s, node, b);
    for (int i = 0; i < v->angles; i++)
        for (int j = i + 1; j < v->angles; j++) {
            double cross[3];
            vec3_cross(b[i], b[j], cross);
            assemble_subtract(K, v->coordinate[3 + i], v->coordinate[3 + j],
                              vec3_dot(M, cross) / 2);
            assemble_subtract(K, v->coordinate[3 + j], v->coordinate[3 + i],
                              vec3_dot(M, cross) / 2);
        }
}

typedef struct sum_at_node {
    const equations *eq;
    const model *m;
    const model_state *s;
    int node;
    double *F; /* [6] */
} sum_at_node;

static void add_at_node(void *context, const applied *what)
{
    const sum_at_node *sum = context;
    double rho[3], moment[3];
    if (model_vertex(sum->m, what->vertex)->body != sum->node)
        return;
    kinematics_offset(sum->m, sum->s, what->vertex, rho);
    if (what->offset)
        for (int k = 0; k < 3; k++)
            rho[k] += what->arm[k];
    vec3_cross(rho, what->F, moment);
    const int away = what->vertex != sum->node || what->offset;
    for (int k = 0; k < 6; k++)
        sum->F[k] += what->F[k] + (k >= 3 && away ? moment[k - 3] : 0);
}

static void add_element_at_node(sum_at_node *sum, int element, double path)
{
    const model *m = sum->m;
    const mesh_element *el = model_element(m, element);
    double forces[ELEMENT_MAX_COORDINATES] = {0};
    node_state x[ELEMENT_MAX_NODES];
    int meets = 0;
    for (int k = 0; k < model_nodes(m); k++)
        meets |= model_vertex(m, el->vertex[k])->body == sum->node;
    if (!meets)
        return;
    kinematics_gather(m, sum->s, el, x);
    if (!distributed_add(sum->eq, sum->s, x, element, path, forces, NULL))
        return;
    for (int k = 0; k < model_nodes(m); k++) {
        if (model_vertex(m, el->vertex[k])->body != sum->node)
            continue;
        applied one = {.vertex = el->vertex[k]};
        memcpy(one.F, forces + NODE_COORDINATES * k, sizeof one.F);
        add_at_node((void *)sum, &one);
    }
}

void loads_at_node(const equations *eq, const model_state *s, double path, int node, double F[6])
{
    const model *m = eq->m;
    sum_at_node sum = {eq, m, s, node, F};
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        if (!distributed_spreads(eq, load))
            applied_each(m, s, load, applied_factor(eq, load, path), add_at_node, &sum);
    }
    for (int i = 0; i < model_elements(m); i++)
        add_element_at_node(&sum, i, path);
}

double loads_reaction(const model *m, int node, int component, const double elements[6],
                      const double loads[6])
{
    const int along = component % 3, first = component - along;
    double R[9], sum = 0;
    if (!scene_node_axes(&model_scene(m)->node[node], R))
        return elements[component] - loads[component];
    for (int i = 0; i < 3; i++)
        sum += R[3 * i + along] * (elements[first + i] - loads[first + i]);
    return sum;
}

void loads_drive(const equations *eq, const model_state *s, double path, double dx[])
{
    const model *m = eq->m;
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_scene(m)->driver[d].value != NULL &&
            model_driver_coordinate(m, d) >= model_unknowns(m))
            dx[model_driver_coordinate(m, d)] =
                loads_driver_value(eq, &model_scene(m)->driver[d], path) - s->driver[d];
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        const mesh_vertex *v = model_vertex(m, i);
        if (v->vector_driver[0] == NONE || v->body != i)
            continue;
        double target[3], q[4], turn[3];
        for (int k = 0; k < 3; k++)
            target[k] = loads_driver_value(eq, &model_scene(m)->driver[v->vector_driver[k]], path);
        rotation_exp(target, q);
        rotation_between(&s->q[4 * i], q, turn);
        for (int k = 0; k < 3; k++)
            dx[v->coordinate[3 + k]] = turn[k];
    }
}

int loads_conditions(const equations *eq, const model_state *s, double path,
                     model_condition out[MODEL_MAX_CONDITIONS])
{
    const model *m = eq->m;
    int count = 0;
    for (int d = 0; d < model_scene(m)->drivers && count < MODEL_MAX_CONDITIONS; d++) {
        const scene_driver *u = &model_scene(m)->driver[d];
        if (u->value != NULL || model_driver_coordinate(m, d) == NONE)
            continue;
        out[count].unknown = model_driver_coordinate(m, d);
        out[count].coordinate = model_driver_coordinate(m, u->condition_driver);
        out[count++].increment =
            loads_driver_value(eq, &model_scene(m)->driver[u->condition_driver], path) -
            s->driver[u->condition_driver];
    }
    return count;
}

void loads_reference(const equations *eq, double path, double f[])
{
    const model *m = eq->m;
    memset(f, 0, (size_t)model_all_coordinates(m) * sizeof *f);
    loads_add(eq, kinematics_rest(m), path, f);
}

int loads_begin(const equations *eq)
{
    const model *m = eq->m;
    int begin = 0;
    for (int i = 0; i < model_scene(m)->loads; i++)
        begin |= applied_factor(eq, &model_scene(m)->load[i], 0) != 0;
    for (int d = 0; d < model_scene(m)->drivers; d++)
        begin |= model_scene(m)->driver[d].value != NULL &&
                 loads_driver_value(eq, &model_scene(m)->driver[d], 0) != 0;
    return begin;
}
