#include "harness/time/deformable.h"

#include <string.h>

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/place.h"

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

deformable deformable_at(const conserving *s, const instant *from, model_state *now, int i)
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
        of.damping =
            s->of.c->run->damping != NULL ? model_scene(m)->member[of.el->member].damping : 0;
        if (of.damping > 0)
            of.S = s->of.c->run->damping->stiffness +
                   (size_t)of.el->kind * (size_t)model_strains(m) * (size_t)model_strains(m);
    } else {
        double *own = s->spring + (size_t)(3 * SPRING_STRAINS * spring);
        of.spring = model_discrete(m, model_discretes(m) - model_springs(m) + spring);
        of.el = &of.spring->el;
        of.strains = SPRING_STRAINS;
        of.e = own;
        of.sigma = own + SPRING_STRAINS;
        of.before = own + 2 * SPRING_STRAINS;
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

static void place_turn(const model *m, const double at[DEFORMABLE_POINTS], const instant *from,
                       const model_state *now, evaluation *v)
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

/* The step, and the states that strains are asked of. */
static void place_nodes(const conserving *s, const instant *from, const model_state *now,
                        evaluation *v)
{
    static const double at[DEFORMABLE_POINTS] = {0.21132486540518711775, 0.78867513459481288225};
    const model *m = s->of.c->model;
    const mesh_element *el = v->of.el;
    double dr[ELEMENT_MAX_NODES][3], c[ELEMENT_MAX_NODES][3], da[ELEMENT_MAX_NODES];
    kinematics_gather(m, from->state, el, v->first);
    kinematics_gather(m, now, el, v->last);
    for (int j = 0; j < el->nodes; j++) {
        place_step(s, from->state, now, el->vertex[j], dr[j], c[j]);
        da[j] = el->warp[j] == NONE ? 0 : s->step[model_warp(m, el->warp[j])];
    }
    cayley_begin(el->nodes, el->nodes == 1, v->first, dr, c, da, &v->step);
    for (int g = 0; g < DEFORMABLE_POINTS; g++)
        cayley_between(&v->step, at[g], &v->point[g]);
    place_turn(m, at, from, now, v);
}

/* At the end (point DEFORMABLE_POINTS): e and J; between: J and H. */
static const node_state *nodes_of(const evaluation *v, int point)
{
    return point < DEFORMABLE_POINTS ? v->point[point].x : v->last;
}

static strain_output wanted(evaluation *v, int point)
{
    return point < DEFORMABLE_POINTS
               ? (strain_output){.J = v->J[point], .s = v->middle, .H = v->H[point]}
               : (strain_output){.e = v->D, .J = v->of.J};
}

static void strains_alone(const model *m, int point, evaluation *v)
{
    strain_output out = wanted(v, point);
    if (v->of.spring != NULL)
        spring_strain(v->of.el->nodes, nodes_of(v, point), v->turn[point], &out);
    else
        model_type(m)->strain(model_kind(m, v->of.el->kind)->data, nodes_of(v, point), &out);
}

static void strains_together(const model *m, int point, int count, evaluation v[])
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

/* J <- J T_c on the columns of rotations. */
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

void deformable_evaluate(const conserving *s, const instant *from, const model_state *now,
                         int count, evaluation v[])
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
    for (int k = 0; k < count; k++)
        behind_turns(&v[k].of, &v[k].step);
}
