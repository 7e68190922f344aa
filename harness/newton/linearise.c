/* Mixed linearisation (N section 4). With J = de/dx and independent e and sigma: de = D(x) - e + J
 * dx, sigma + dsigma = P'(e) + P''(e) de. The equations are condensed per element. */
#include "harness/newton/newton_impl.h"

#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/vec3.h"

static status compatible_element(const equations *eq, model_state *s, int i)
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, s, el, x);
    double *e = &s->e[(size_t)i * (size_t)model_strains(m)],
           *sigma = &s->sigma[(size_t)i * (size_t)model_strains(m)];
    ahead_strain(eq, i, x, &(strain_output){.e = e, .history = model_history_of(m, s, i)});
    free_strain_subtract(eq, i, s->path, e);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    status outcome;
    if (model_takes_loads(m) &&
        distributed_stress(eq, s, x, i, s->path, &(stress_output){.sigma = sigma}, &outcome))
        return outcome;
    return ahead_stress(eq, i, free_strain_data(eq, i, s->path), e,
                        &s->inner[(size_t)i * (size_t)model_inner(m)],
                        &(stress_output){.sigma = sigma, .history = model_history_of(m, s, i)});
}

status linearise_make_compatible(const equations *eq, model_state *s, fault *f)
{
    const model *m = eq->m;
    status outcome = STATUS_OK;
    ahead_strains(eq, s, AHEAD_E, NULL);
    if (!model_frees(m))
        ahead_stresses(eq, s, NULL, s->inner);
    for (int i = 0; i < model_elements(m) && outcome == STATUS_OK; i++) {
        outcome = compatible_element(eq, s, i);
        if (outcome != STATUS_OK)
            fault_set(f, outcome,
                      "element %d of %s: its state is outside the range that %s can evaluate; use "
                      "smaller steps or more elements",
                      i,
                      scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text,
                      model_type(m)->name);
    }
    ahead_end(eq);
    return outcome;
}

static double incompatibility_of(const model *m, const model_slot *w, double length)
{
    double largest = 0;
    for (int k = 0; k < model_strains(m); k++)
        largest = fmax(largest, fabs(w->incompatibility[k]) / length);
    return largest;
}

/* Adds the force and K of an evaluated element; K contains H. Subtracts centrifugal forces.
 * present: J^T sigma, with the stresses of the state, for which H was computed, minus the
 * centrifugal forces; without J^T sigma if `tangent` is 0 or the element is plain. */
static status add_material(const equations *eq, const linear_memory *memory, const model_state *s,
                           const chunk_element *of, int tangent, double path, double present[],
                           element_part *part)
{
    const model *m = eq->m;
    const int i = of->index;
    const model_slot w = linearise_slot(m, memory, i);
    const size_t size = (size_t)model_own_coordinates(m) * sizeof *present;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    memset(part->force, 0, size);
    if (eq->loading.rotates)
        TRY(rotating_frame_add(eq, of->x, i, path, part->force, tangent ? part->K : NULL,
                               &part->why));
    memcpy(present, part->force, size);
    dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, w.J, w.sigma,
                            part->force);
    if (tangent)
        dense_add_congruence(model_strains(m), model_own_coordinates(m), w.J, w.C, part->K, work);
    if (tangent && !model_element(m, i)->plain)
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, w.J,
                                &s->sigma[(size_t)i * (size_t)model_strains(m)], present);
    return STATUS_OK;
}

static void subtract_loads(const equations *eq, const linear_memory *memory, chunk_element *of,
                           int tangent, double path, element_part *part)
{
    const model *m = eq->m;
    const model_slot w = linearise_slot(m, memory, of->index);
    double forces[ELEMENT_MAX_COORDINATES] = {0}, *K = tangent ? part->K : NULL;
    const int acts = distributed_add_field(eq, of->x, of->index, path, forces, K);
    if (of->along.acts)
        distributed_add_taken(m, &of->along.out, w.J, w.incompatibility, forces, K);
    else if (!acts)
        return;
    for (int k = 0; k < model_own_coordinates(m); k++) {
        part->force[k] -= forces[k];
        of->present[k] -= tangent ? forces[k] : 0;
    }
}

static status element_equations(const equations *eq, const linear_memory *memory,
                                const model_state *s, chunk_element *of, int tangent, double path,
                                element_part *part)
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, of->index);
    const model_slot w = linearise_slot(m, memory, of->index);
    if (of->outcome != STATUS_OK)
        return fault_set(&part->why, of->outcome,
                         "element %d of %s: its state is outside the range that %s can evaluate; "
                         "use smaller steps or more elements",
                         of->index, scene_called(model_scene(m), SCENE_MEMBERS, el->member).text,
                         model_type(m)->name);
    if (!of->complete)
        TRY(add_material(eq, memory, s, of, tangent, path, of->present, part));
    subtract_loads(eq, memory, of, tangent, path, part);
    if (tangent)
        eliminate_matrix(m, s, el, of->present, part->K);
    eliminate_forces(m, s, el, part->force);
    part->incompatibility = incompatibility_of(m, &w, model_kind(m, el->kind)->length);
    return STATUS_OK;
}

/* Adds K drive for the prescribed coordinates of the element to `force`. */
static void add_driven(const model *m, const mesh_element *el, const double drive[],
                       const double K[], double force[])
{
    const int n = el->columns;
    for (int j = 0; j < n; j++) {
        const double step = el->index[j] >= model_unknowns(m) ? drive[el->index[j]] : 0;
        if (step == 0)
            continue;
        for (int i = 0; i < n; i++)
            force[i] += K[i * n + j] * step;
    }
}

/* Adds the columns of K for the unknown drivers of conditions. */
static void add_columns(const model *m, const mesh_element *el, const double K[],
                        model_linearisation *lin)
{
    const int n = el->columns;
    for (int c = 0; c < lin->conditions; c++) {
        double *column = lin->column + c * model_all_coordinates(m);
        for (int j = 0; j < n; j++) {
            if (el->index[j] != lin->condition[c].unknown)
                continue;
            for (int i = 0; i < n; i++)
                if (el->index[i] != NONE)
                    column[el->index[i]] += K[i * n + j];
        }
    }
}

typedef struct shared_loop {
    const equations *eq;
    const linear_memory *memory;
    const model *m;
    const model_state *s;
    model_linearisation *lin;
    const mesh_pattern *pattern; /* pattern of K; NULL: K is not requested */
    int tangent, window;
    element_part *part; /* [slots of the pool x window] equations of elements */
    status outcome;
    fault *f;
} shared_loop;

/* Returns 1 if the matrices of some of these elements are required. Without K, only those of
 * elements with prescribed coordinates are. */
static int needs_matrices(const shared_loop *loop, int count, const int index[])
{
    const model *m = loop->m;
    if (!loop->tangent || loop->lin->K != NULL)
        return loop->tangent;
    for (int k = 0; k < count; k++) {
        const mesh_element *el = model_element(m, index[k]);
        for (int j = 0; j < el->columns; j++)
            if (el->index[j] >= model_unknowns(m))
                return 1;
    }
    return 0;
}

static void fill_window(const shared_loop *loop, int first, int end, element_part part[])
{
    unsigned char done[CHUNK_WINDOW] = {0};
    int index[CHUNK_MOST], count;
    while ((count = chunk_next(loop->m, first, end, done, index)) > 0) {
        chunk_element element[CHUNK_MOST];
        const int matrices = needs_matrices(loop, count, index);
        for (int k = 0; k < count; k++) {
            element[k].index = index[k];
            element[k].force = part[index[k] - first].force;
            element[k].K = matrices ? part[index[k] - first].K : NULL;
            part[index[k] - first].matrix = matrices;
        }
        chunk_evaluate(loop->eq, loop->memory, loop->s, loop->lin->path, count, element);
        for (int k = 0; k < count; k++) {
            element_part *p = &part[index[k] - first];
            p->outcome = element_equations(loop->eq, loop->memory, loop->s, &element[k], matrices,
                                           loop->lin->path, p);
        }
    }
}

static int end_of(const shared_loop *loop, int piece)
{
    const int end = (piece + 1) * loop->window;
    return end < model_elements(loop->m) ? end : model_elements(loop->m);
}

static void fill_piece(void *context, int piece, int slot)
{
    const shared_loop *loop = context;
    fill_window(loop, piece * loop->window, end_of(loop, piece),
                loop->part + (size_t)slot * (size_t)loop->window);
}

/* Returns the number of elements whose parts are stored in eq->run->part. 0: elements are added one
 * at a time, because there is too little memory, or neither several threads nor batches are used.
 */
static int window_of(const equations *eq)
{
    const model *m = eq->m;
    const int wanted = model_elements(m) < CHUNK_WINDOW ? model_elements(m) : CHUNK_WINDOW,
              slots = eq->run->pool != NULL ? THREAD_POOL_SLOTS : 1;
    if (eq->run->pool == NULL && chunk_size(m) == 1)
        return 0;
    if (eq->run->part == NULL)
        eq->run->part = malloc((size_t)(wanted * slots) * sizeof *eq->run->part);
    return eq->run->part != NULL ? wanted : 0;
}

static void add_part(const equations *eq, const mesh_element *el, element_part *part,
                     model_linearisation *lin)
{
    const model *m = eq->m;
    if (lin->drive != NULL && part->matrix)
        add_driven(m, el, lin->drive, part->K, part->force);
    if (part->matrix)
        add_columns(m, el, part->K, lin);
    phases_lap(&eq->run->phases, PHASE_ELEMENTS);
    for (int k = 0; k < el->columns; k++)
        part->force[k] = -part->force[k];
    assemble_vector(el, part->force, lin->residual);
    lin->incompatibility = fmax(lin->incompatibility, part->incompatibility);
}

static void add_discrete(const equations *eq, const model_state *s, model_linearisation *lin)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, lin->path);
    const model *m = eq->m;
    for (int i = 0; i < model_discretes(m); i++) {
        element_part part = {.matrix = 1};
        discrete_equations(m, s, model_discrete(m, i), &frame, damping_of_springs(eq->run->damping),
                           part.force, part.K);
        add_part(eq, &model_discrete(m, i)->el, &part, lin);
        if (lin->K != NULL)
            assemble_discrete(&model_discrete(m, i)->el, part.K, lin->K);
    }
}

static int take_piece(void *context, int piece, int slot)
{
    shared_loop *loop = context;
    const equations *eq = loop->eq;
    element_part *part = loop->part + (size_t)slot * (size_t)loop->window;
    for (int i = piece * loop->window; i < end_of(loop, piece); i++, part++) {
        eq->run->counters.strain_evaluations++;
        eq->run->counters.stress_evaluations++;
        loop->outcome = part->outcome;
        if (part->outcome != STATUS_OK) {
            fault_set(loop->f, part->outcome, "%s", part->why.text);
            return 0;
        }
        add_part(eq, model_element(loop->m, i), part, loop->lin);
        if (loop->pattern != NULL)
            assemble_matrix(loop->pattern, i, part->K, loop->lin->K);
        phases_lap(&eq->run->phases, PHASE_ASSEMBLY);
    }
    return 1;
}

static status linearise_elements(const equations *eq, const linear_memory *memory,
                                 const model_state *s, model_linearisation *lin, fault *f)
{
    const model *m = eq->m;
    element_part own;
    const int window = window_of(eq);
    shared_loop loop = {.eq = eq,
                        .memory = memory,
                        .m = m,
                        .s = s,
                        .lin = lin,
                        .pattern = lin->K == NULL ? NULL : assemble_of(eq->run->patterns, lin->K),
                        .tangent = lin->K != NULL || lin->drive != NULL || lin->conditions > 0,
                        .window = window > 0 ? window : 1,
                        .part = window > 0 ? eq->run->part : &own,
                        .f = f};
    thread_pool *together = window > 0 && !eq->loading.rotates ? eq->run->pool : NULL;
    memset(lin->residual, 0, (size_t)model_all_coordinates(m) * sizeof *lin->residual);
    lin->incompatibility = 0;
    if (lin->conditions > 0)
        memset(lin->column, 0,
               (size_t)(lin->conditions * model_all_coordinates(m)) * sizeof *lin->column);
    if (lin->K != NULL)
        sparse_zero(lin->K);
    thread_pool_relay(together, (model_elements(m) + loop.window - 1) / loop.window, fill_piece,
                      take_piece, &loop);
    TRY(loop.outcome);
    add_discrete(eq, s, lin);
    loads_add_at_vertices(eq, s, lin->path, lin->residual);
    if (lin->K != NULL) {
        loads_subtract_at_vertices(eq, s, lin->path, lin->K);
        linearise_add_held_moments(eq, s, lin->path, lin->K);
    }
    phases_lap(&eq->run->phases, PHASE_ASSEMBLY);
    return STATUS_OK;
}

status linearise_state(const equations *eq, const linear_memory *memory, const model_state *s,
                       model_linearisation *lin, fault *f)
{
    const int tangent = lin->K != NULL || lin->drive != NULL || lin->conditions > 0;
    ahead_strains(eq, s, AHEAD_E | AHEAD_J | (tangent ? AHEAD_H : 0), s->sigma);
    ahead_stresses(eq, s, s->e, s->inner);
    const status outcome = linearise_elements(eq, memory, s, lin, f);
    ahead_end(eq);
    return outcome;
}

void linearise_node_force(const equations *eq, const model_state *s, const double sigma[], int node,
                          double F[6])
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    const double *stress = sigma != NULL ? sigma : s->sigma;
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        for (int k = 0; k < model_nodes(m); k++) {
            if (model_vertex(m, el->vertex[k])->body != node)
                continue;
            node_state x[ELEMENT_MAX_NODES];
            double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
                force[ELEMENT_MAX_COORDINATES] = {0}, rho[3], moment[3];
            kinematics_gather(m, s, el, x);
            model_type(m)->strain(model_kind(m, el->kind)->data, x,
                                  &(strain_output){.J = J, .history = model_history_of(m, s, i)});
            dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                    &stress[(size_t)i * (size_t)model_strains(m)], force);
            rotating_frame_add(eq, x, i, s->path, force, NULL, NULL);
            kinematics_offset(m, s, el->vertex[k], rho);
            vec3_cross(rho, force + NODE_COORDINATES * k, moment);
            for (int c = 0; c < 3; c++) {
                F[c] += force[NODE_COORDINATES * k + c];
                F[3 + c] +=
                    force[NODE_COORDINATES * k + 3 + c] + (el->vertex[k] == node ? 0 : moment[c]);
            }
        }
    }
    discrete_node_force(m, s, &frame, node, F);
    if (sigma != NULL)
        linear_springs_node_force(m, &sigma[(size_t)model_elements(m) * (size_t)model_strains(m)],
                                  node, F);
}

/* A sum of moments at a node that is smaller, relative to its terms, is a rounding error. */
static const double least_moment = 1e-12;

/* Returns the reaction moment [N m] about the only fixed axis of a node; 0: the moment is a
 * rounding error. sigma[elements x strains]: stresses; NULL: the stresses of the state. */
static double linearise_held_moment(const equations *eq, const model_state *s, const double sigma[],
                                    double path, int node, int axis)
{
    const model *m = eq->m;
    double F[6], load[6];
    linearise_node_force(eq, s, sigma, node, F);
    loads_at_node(eq, s, path, node, load);
    const double moment = F[3 + axis] - load[3 + axis],
                 size = vec3_norm(F + 3) + vec3_norm(load + 3) +
                        model_length(m) * (vec3_norm(F) + vec3_norm(load));
    return fabs(moment) > least_moment * size ? moment : 0;
}

void linearise_add_held_moments(const equations *eq, const model_state *s, double path, sparse *K)
{
    const model *m = eq->m;
    for (int node = 0; node < model_scene(m)->nodes; node++) {
        const int h = coordinates_held_turn(m, node);
        if (h == NONE)
            continue;
        const int *coordinate = model_vertex(m, node)->coordinate + SCENE_RX,
                  i = coordinate[(h + 1) % 3], j = coordinate[(h + 2) % 3];
        const double half = linearise_held_moment(eq, s, NULL, path, node, h) / 2;
        assemble_subtract(K, i, j, -half);
        assemble_subtract(K, j, i, half);
    }
}

status linearise_held_have_potential(const equations *eq, const double sigma[], double path,
                                     fault *f)
{
    const model *m = eq->m;
    static const char *const turn[] = {"rx", "ry", "rz"};
    for (int node = 0; node < model_scene(m)->nodes; node++) {
        const int h = coordinates_held_turn(m, node);
        if (h != NONE && linearise_held_moment(eq, kinematics_rest(m), sigma, path, node, h) != 0)
            return fault_set(
                f, STATUS_REFUSED,
                "the moment that holds %s of %s, which is free to rotate about two perpendicular "
                "axes, has no potential; fix one of these rotations, or follow a static path",
                turn[h], scene_called(model_scene(m), SCENE_NODES, node).text);
    }
    return STATUS_OK;
}

void linearise_add_internal(const equations *eq, const model_state *s, int elements,
                            const int element[], double out[])
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    for (int k = 0; k < elements; k++) {
        const mesh_element *el = model_element(m, element[k]);
        node_state x[ELEMENT_MAX_NODES];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[MODEL_MAX_COORDINATES] = {0};
        kinematics_gather(m, s, el, x);
        model_type(m)->strain(
            model_kind(m, el->kind)->data, x,
            &(strain_output){.J = J, .history = model_history_of(m, s, element[k])});
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                &s->sigma[(size_t)element[k] * (size_t)model_strains(m)], force);
        eliminate_forces(m, s, el, force);
        assemble_vector(el, force, out);
    }
    for (int i = model_discretes(m) - model_springs(m); i < model_discretes(m); i++) {
        double force[MODEL_MAX_COORDINATES] = {0},
               K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
        discrete_equations(m, s, model_discrete(m, i), &frame, NULL, force, K);
        assemble_vector(&model_discrete(m, i)->el, force, out);
    }
}
