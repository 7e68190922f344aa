#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/shared/masses.h"

int deformable_count(const conserving *s)
{
    return model_elements(s->of.c->model) + model_springs(s->of.c->model);
}

int deformable_together(const conserving *s, int first)
{
    const model *m = s->of.c->model;
    const int most = chunk_size(m);
    int count = 1;
    while (count < most && first + count < model_elements(m) &&
           model_element(m, first + count)->kind == model_element(m, first)->kind)
        count++;
    return count;
}

deformable deformable_at(const conserving *s, const motion_state *from, model_state *now, int i)
{
    const model *m = s->of.c->model;
    const size_t at = (size_t)i, n = (size_t)s->strains, first = at * (size_t)model_strains(m);
    const int spring = i - model_elements(m);
    deformable of = {
        .index = i, .W = s->W + at * n * n, .C_before = s->C + at * n * n, .d = s->d + at * n};
    if (spring < 0) {
        of.el = model_element(m, i);
        of.strains = model_strains(m);
        of.before = (s->elastic != NULL ? s->elastic : from->state->sigma) + first;
        of.e = now->e + first;
        of.sigma = now->sigma + first;
        of.length = model_kind(m, of.el->kind)->length;
        of.V = run_damping_of(s->of.c->run->damping, m, i);
    } else {
        double *own = s->spring + (size_t)(4 * SPRING_STRAINS * spring);
        of.spring = model_discrete(m, model_discretes(m) - model_springs(m) + spring);
        of.el = &of.spring->el;
        of.strains = SPRING_STRAINS;
        of.e = own;
        of.sigma = own + SPRING_STRAINS;
        of.before = own + 2 * SPRING_STRAINS;
        of.first = own + 3 * SPRING_STRAINS;
        of.V = scene_spring_damps(of.spring->spring) ? of.spring->spring->damping : NULL;
        of.length = model_length(m);
    }
    of.coordinates = NODE_COORDINATES * of.el->nodes;
    of.J = s->slot + at * (size_t)s->slot_size;
    of.C = of.J + of.strains * of.coordinates;
    of.present = of.C + of.strains * of.strains;
    of.gap_e = of.present + of.strains;
    of.gap_d = of.gap_e + of.strains;
    of.memory = of.gap_d + of.strains;
    return of;
}

static void place_turn(const model *m, const double at[DEFORMABLE_POINTS], const motion_state *from,
                       const model_state *now, deformable_values *v)
{
    if (v->of.spring == NULL)
        return;
    const int spring = v->of.index - model_elements(m);
    const double *first = turns_of_spring(m, from->state, spring),
                 *last = turns_of_spring(m, now, spring);
    for (int i = 0; i < 3; i++) {
        for (int g = 0; g < DEFORMABLE_POINTS; g++)
            v->turn[g][i] = (1 - at[g]) * first[i] + at[g] * last[i];
        v->turn[DEFORMABLE_POINTS][i] = last[i];
    }
}

static void place_nodes(const conserving *s, const motion_state *from, const model_state *now,
                        deformable_values *v)
{
    static const double at[DEFORMABLE_POINTS] = {0.21132486540518711775, 0.78867513459481288225};
    const model *m = s->of.c->model;
    const mesh_element *el = v->of.el;
    double dr[ELEMENT_MAX_NODES][3], c[ELEMENT_MAX_NODES][3], da[ELEMENT_MAX_NODES];
    kinematics_gather(m, from->state, el, v->first);
    kinematics_gather(m, now, el, v->last);
    for (int j = 0; j < el->nodes; j++) {
        frame_motion_step(s, from->state, now, el->vertex[j], dr[j], c[j]);
        da[j] = el->warp[j] == NONE ? 0 : s->step[model_warp(m, el->warp[j])];
    }
    cayley_begin(el->nodes, el->nodes == 1, v->first, dr, c, da, &v->step);
    for (int g = 0; g < DEFORMABLE_POINTS; g++)
        cayley_between(&v->step, at[g], &v->point[g]);
    place_turn(m, at, from, now, v);
}

static const node_state *nodes_of(const deformable_values *v, int point)
{
    return point < DEFORMABLE_POINTS ? v->point[point].x : v->last;
}

/* Returns the outputs to be computed at a point: e and J at the end of the step (point
 * DEFORMABLE_POINTS), and J and H at the points before it. */
static strain_output wanted(deformable_values *v, int point)
{
    return point < DEFORMABLE_POINTS
               ? (strain_output){.J = v->J[point], .s = v->middle, .H = v->H[point]}
               : (strain_output){.e = v->D, .J = v->of.J};
}

static void strains_alone(const model *m, int point, deformable_values *v)
{
    strain_output out = wanted(v, point);
    if (v->of.spring != NULL)
        spring_strain(v->of.el->nodes, nodes_of(v, point), v->turn[point], &out);
    else
        model_type(m)->strain(model_kind(m, v->of.el->kind)->data, nodes_of(v, point), &out);
}

static void strains_together(const model *m, int point, int count, deformable_values v[])
{
    const element_data *data[CHUNK_MOST];
    node_state x[CHUNK_MOST * ELEMENT_MAX_NODES];
    strain_output out[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        data[k] = model_kind(m, v[k].of.el->kind)->data;
        memcpy(x + k * model_nodes(m), nodes_of(&v[k], point), (size_t)model_nodes(m) * sizeof *x);
        out[k] = wanted(&v[k], point);
    }
    model_type(m)->strain_many(count, data, x, out);
}

/* J <- J T_c in the columns of rotations */
static void behind_turns(const deformable *of, const cayley_step *step)
{
    for (int j = 0; j < step->nodes; j++) {
        double T[9];
        cayley_tangent(step->c[j], T);
        for (int r = 0; r < of->strains; r++) {
            double *at = of->J + r * of->coordinates + NODE_COORDINATES * j + 3, row[3];
            mat3_transpose_mul_vec(T, at, row);
            memcpy(at, row, sizeof row);
        }
    }
}

void deformable_evaluate(const conserving *s, const motion_state *from, const model_state *now,
                         int count, deformable_values v[])
{
    const model *m = s->of.c->model;
    for (int k = 0; k < count; k++)
        place_nodes(s, from, now, &v[k]);
    for (int point = 0; point <= DEFORMABLE_POINTS; point++) {
        if (count > 1)
            strains_together(m, point, count, v);
        else
            strains_alone(m, point, v);
        s->of.c->run->counters.strain_evaluations += v->of.spring == NULL ? count : 0;
    }
    for (int k = 0; k < count; k++) {
        if (v[k].of.spring == NULL)
            free_strain_subtract(&s->of.c->eq, v[k].of.index, now->path, v[k].D);
        behind_turns(&v[k].of, &v[k].step);
    }
}

static void add_at(const double rho[3], const double F[6], double out[6])
{
    double moment[3];
    vec3_cross(rho, F, moment);
    for (int i = 0; i < 6; i++)
        out[i] += F[i] + (i < 3 ? 0 : moment[i - 3]);
}

/* Adds to F[6] the inertia forces of elements with consistent mass on the body `node`, with moments
 * about `place`. */
static void add_spread(const model *m, const model_state *s,
                       const inertia_resultants_motion *motion, int node, const double place[3],
                       double F[6])
{
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        double taken[ELEMENT_MAX_COORDINATES], rho[3];
        for (int k = 0, known = 0; k < el->nodes; k++) {
            if (model_vertex(m, el->vertex[k])->body != node)
                continue;
            if (!known++)
                consistent_mass_force(m, i, s, motion->v, motion->a, taken);
            kinematics_position(m, s, el->vertex[k], rho);
            for (int c = 0; c < 3; c++)
                rho[c] -= place[c];
            add_at(rho, taken + NODE_COORDINATES * k, F);
        }
    }
}

status inertia_resultants_node(const model *m, const model_state *s,
                               const inertia_resultants_motion *motion, int node, double F[6],
                               fault *f)
{
    frame_masses all;
    double place[3], rho[3];
    TRY(motion->spread ? frame_masses_alloc_bodies(m, &all, f) : frame_masses_alloc(m, &all, f));
    kinematics_position(m, s, node, place);
    if (motion->spread)
        add_spread(m, s, motion, node, place, F);
    for (int k = 0; k < all.masses; k++) {
        const int frame = all.mass[k].frame;
        double one[6];
        if (model_vertex(m, frame)->body != node)
            continue;
        inertia_force(m, &all.mass[k], s, motion->v, motion->a, one);
        kinematics_position(m, s, frame, rho);
        for (int i = 0; i < 3; i++)
            rho[i] -= place[i];
        add_at(rho, one, F);
    }
    frame_masses_free(&all);
    return STATUS_OK;
}

static void force_of(const model *m, const model_state *s, const inertia_resultants_motion *motion,
                     int element, int k, double F[7], frame_mass *share)
{
    const mesh_element *el = model_element(m, element);
    double taken[ELEMENT_MAX_COORDINATES], warping;
    frame_rates r;
    frame_masses_share(m, el, k, share, &warping);
    if (motion->spread) {
        consistent_mass_force(m, element, s, motion->v, motion->a, taken);
        memcpy(F, taken + NODE_COORDINATES * k, 7 * sizeof *F);
        return;
    }
    vertex_rates(m, s, el->vertex[k], motion->v, motion->a, &r);
    inertia_force_at(share, &r, F);
    F[6] = el->warp[k] != NONE ? warping * motion->a[model_warp(m, el->warp[k])] : 0;
}

void inertia_resultants_along(const model *m, const model_state *s,
                              const inertia_resultants_motion *motion, int element,
                              double density[ELEMENT_MAX_NODES][6])
{
    const mesh_element *el = model_element(m, element);
    const double *part = motion->spread ? model_shares(m) : el->share;
    for (int k = 0; k < el->nodes; k++) {
        frame_mass share;
        double F[7];
        force_of(m, s, motion, element, k, F, &share);
        for (int i = 0; i < 6; i++)
            density[k][i] = share.mass > 0 ? F[i] / (part[k] * model_kind(m, el->kind)->length) : 0;
    }
}

/* Corrects the forces at the ends of an element whose mass is lumped at its nodes. F: for each
 * node, the force on the whole mass of the element when it moves with the node. */
static void add_couple(const model *m, const model_state *s, int element, double F[2][7],
                       double ends[2][7])
{
    const mesh_element *el = model_element(m, element);
    double place[2][3], moment[3];
    for (int e = 0; e < 2; e++)
        kinematics_position(m, s, el->vertex[e], place[e]);
    for (int e = 0; e < 2; e++) {
        const double c = el->couple[e],
                     other[3] = {place[!e][0] - place[e][0], place[!e][1] - place[e][1],
                                 place[!e][2] - place[e][2]};
        vec3_cross(other, F[e], moment);
        for (int i = 0; i < 3; i++) {
            ends[e][i] += c * (F[!e][i] - F[e][i]);
            ends[e][3 + i] += c * moment[i];
        }
    }
}

void inertia_resultants_ends(const model *m, const model_state *s,
                             const inertia_resultants_motion *motion, int element,
                             double ends[2][7])
{
    const mesh_element *el = model_element(m, element);
    double whole[2][7];
    for (int e = 0; e < 2; e++) {
        const int k = e ? el->nodes - 1 : 0;
        frame_mass share;
        double F[7];
        force_of(m, s, motion, element, k, F, &share);
        for (int i = 0; i < 7; i++) {
            ends[e][i] += F[i];
            whole[e][i] = F[i] / el->share[k];
        }
    }
    if (el->nodes == 2 && !motion->spread)
        add_couple(m, s, element, whole, ends);
}
