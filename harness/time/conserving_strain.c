/* Strains and stresses of all elements and springs, and the number that makes their work exact. */
#include <math.h>
#include <string.h>

#include "cases/scene/names.h"
#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/deformable.h"

static const double *inner_of(const model *m, const model_state *s, int i)
{
    static const double none[1] = {0};
    return model_inner(m) > 0 ? s->inner + (size_t)i * (size_t)model_inner(m) : none;
}

/* Of elements of one kind. */
static status middle_stress_of(const equations *eq, int count, const int index[],
                               const double *const e[], const model_state *s, stress_output out[],
                               fault *f)
{
    const model *m = eq->m;
    const element_data *data[CHUNK_MOST];
    const double *inner[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        data[k] = model_kind_of(m, index[k])->data;
        inner[k] = inner_of(m, s, index[k]);
    }
    eq->run->counters.stress_evaluations += count;
    if (count > 1 && model_type(m)->stress_many != NULL)
        model_type(m)->stress_many(count, data, e, inner, out, outcome);
    else
        for (int k = 0; k < count; k++)
            outcome[k] = model_type(m)->stress(data[k], e[k], inner[k], &out[k]);
    for (int k = 0; k < count; k++)
        if (outcome[k] != STATUS_OK)
            return fault_set(
                f, outcome[k], "element %d of %s: outside what %s can evaluate", index[k],
                scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, index[k])->member)
                    .text,
                model_type(m)->name);
    return STATUS_OK;
}

static double energy_of_spring(const deformable *of)
{
    return dense_quadratic(SPRING_STRAINS, of->W, of->e) / 2;
}

/* Stresses of a spring are its stiffness times its strains. */
static void begin_spring(conserving *s, const instant *from, int i)
{
    deformable of = deformable_at(s, from, from->state, i);
    node_state x[ELEMENT_MAX_NODES];
    memcpy(of.W, of.spring->spring->stiffness, SPRING_STRAINS * SPRING_STRAINS * sizeof *of.W);
    kinematics_gather(s->of.c->model, from->state, of.el, x);
    spring_strain(of.el->nodes, x,
                  turns_of_spring(s->of.c->model, from->state, i - model_elements(s->of.c->model)),
                  &(strain_output){.e = of.e});
    dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, of.W, of.e, of.sigma);
    memcpy(of.sigma + SPRING_STRAINS, of.sigma, SPRING_STRAINS * sizeof *of.sigma);
    s->energy[i] = energy_of_spring(&of);
}

status conserving_begin(conserving *s, const instant *from, fault *f)
{
    const model *m = s->of.c->model;
    const double *e[CHUNK_MOST] = {NULL};
    memset(s->d, 0, (size_t)deformable_count(s) * (size_t)s->strains * sizeof *s->d);
    for (int i = 0; i < model_elements(m);) {
        const int count = deformable_together(s, i);
        stress_output out[CHUNK_MOST];
        int index[CHUNK_MOST] = {0};
        for (int k = 0; k < count; k++) {
            index[k] = i + k;
            e[k] = from->state->e + (size_t)(i + k) * (size_t)model_strains(m);
            out[k] = (stress_output){
                .energy = &s->energy[i + k],
                .sigma =
                    s->elastic != NULL ? s->elastic + (size_t)((i + k) * model_strains(m)) : NULL,
                .C = deformable_at(s, from, from->state, i + k).C_before};
        }
        TRY(middle_stress_of(&s->of.c->eq, count, index, e, from->state, out, f));
        i += count;
    }
    for (int i = model_elements(m); i < deformable_count(s); i++)
        begin_spring(s, from, i);
    return STATUS_OK;
}

/* Numerator and denominator of k. */
typedef struct scalar_parts {
    double lacking, square, size;
} scalar_parts;

static void take_energy(conserving *s, const deformable *of, double energy, scalar_parts *sum)
{
    sum->lacking += energy - s->energy[of->index];
    for (int k = 0; k < of->strains; k++) {
        sum->lacking -= (of->before[k] + of->present[k]) / 2 * of->d[k];
        s->largest = fmax(s->largest, fabs(of->present[k]));
    }
    sum->square += dense_quadratic(of->strains, of->W, of->d);
    sum->size += dense_quadratic(of->strains, of->W, of->e);
}

static status stress_together(conserving *s, const instant *from, model_state *now, int first,
                              int count, scalar_parts *sum, fault *f)
{
    const model *m = s->of.c->model;
    deformable of[CHUNK_MOST];
    const double *e[CHUNK_MOST] = {NULL};
    stress_output out[CHUNK_MOST];
    double energy[CHUNK_MOST];
    int index[CHUNK_MOST] = {0};
    for (int k = 0; k < count; k++) {
        of[k] = deformable_at(s, from, now, first + k);
        index[k] = first + k;
        e[k] = of[k].e;
        out[k] = (stress_output){.energy = &energy[k],
                                 .sigma = of[k].present,
                                 .C = of[k].C,
                                 .memory = model_memory(m) > 0 ? of[k].memory : NULL};
    }
    TRY(middle_stress_of(&s->of.c->eq, count, index, e, now, out, f));
    for (int k = 0; k < count; k++) {
        for (int c = 0; c < model_strains(m) * model_strains(m); c++)
            of[k].W[c] = (of[k].C_before[c] + of[k].C[c]) / 2;
        take_energy(s, &of[k], energy[k], sum);
    }
    return STATUS_OK;
}

static void stress_spring(conserving *s, const instant *from, model_state *now, int i,
                          scalar_parts *sum)
{
    const deformable of = deformable_at(s, from, now, i);
    dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, of.W, of.e, of.present);
    memcpy(of.C, of.W, SPRING_STRAINS * SPRING_STRAINS * sizeof *of.C);
    take_energy(s, &of, energy_of_spring(&of), sum);
}

/* At the begin [J]. */
static double size_of_energy(const conserving *s, const instant *from)
{
    inertia_balance moving;
    inertia_of(s->of.c->model, s->of.masses, from->state, from->v,
               from->ends_known ? from->ends : NULL, &moving);
    double sum = moving.kinetic;
    for (int i = 0; i < deformable_count(s); i++)
        sum += fabs(s->energy[i]);
    return sum;
}

status conserving_stresses(conserving *s, const instant *from, model_state *now, int iteration,
                           fault *f)
{
    const model *m = s->of.c->model;
    const double wild = 0.3, nothing = 1e-16, rounding = 1e-12;
    scalar_parts sum = {0, 0, 0};
    s->largest = 0;
    for (int i = 0; i < model_elements(m);) {
        const int count = deformable_together(s, i);
        TRY(stress_together(s, from, now, i, count, &sum, f));
        i += count;
    }
    for (int i = model_elements(m); i < deformable_count(s); i++)
        stress_spring(s, from, now, i, &sum);
    s->denominator = sum.square;
    const int moves = fabs(sum.square) > nothing * fabs(sum.size);
    s->k = moves && iteration > 2 ? sum.lacking / sum.square : 0;
    s->wild = 0;
    if (fabs(s->k) > wild) {
        s->wild = fabs(sum.lacking) > rounding * size_of_energy(s, from);
        s->k = 0;
    }
    return STATUS_OK;
}
