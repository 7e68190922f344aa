/* Members whose stresses gain eta S0 e': strains of the stages have the rates
 *   e_i' = 1/h sum_j B_ij (e_j - e_0),
 * which couple all three in every damped element. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/damping.h"
#include "harness/time/radau_impl.h"

/* Of one element in one stage. */
typedef struct damped {
    double J[ELEMENT_MAX_STRAINS * MODEL_MAX_COORDINATES]; /* by the model's coordinates */
    double gained[ELEMENT_MAX_STRAINS];                    /* strains since the begin */
} damped;

static void take(radau *r, const instant *from, int stage, int element, damped *out)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    const size_t first = (size_t)element * (size_t)model_strains(m);
    const model_slot w = linearise_slot(m, &r->stage[stage].memory, element);
    for (int k = 0; k < model_strains(m); k++) {
        double *row = out->J + k * el->columns;
        memset(row, 0, (size_t)el->columns * sizeof *row);
        memcpy(row, w.J + k * model_own_coordinates(m),
               (size_t)model_own_coordinates(m) * sizeof *row);
        eliminate_forces(m, r->stage[stage].state, el, row);
        out->gained[k] = r->stage[stage].state->e[first + (size_t)k] + w.incompatibility[k] -
                         from->state->e[first + (size_t)k];
    }
}

/* eta S0 e' of a stage joins the stress that its element has linearised, and its forces. */
static void add_stress(radau *r, const damped all[STAGES], double h, double eta, const double S[],
                       int stage, int element)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    double rate[ELEMENT_MAX_STRAINS] = {0}, more[ELEMENT_MAX_STRAINS],
           force[MODEL_MAX_COORDINATES] = {0};
    for (int j = 0; j < STAGES; j++)
        for (int k = 0; k < model_strains(m); k++)
            rate[k] += eta * r->B[STAGES * stage + j] / h * all[j].gained[k];
    dense_mul_vec(model_strains(m), model_strains(m), S, rate, more);
    const model_slot w = linearise_slot(m, &r->stage[stage].memory, element);
    for (int k = 0; k < model_strains(m); k++)
        w.sigma[k] += more[k];
    dense_add_transpose_mul(el->columns, model_strains(m), 1, all[stage].J, more, force);
    for (int c = 0; c < el->columns; c++)
        if (el->index[c] != NONE && el->index[c] < r->free)
            r->residual[(size_t)stage * (size_t)r->free + (size_t)el->index[c]] -= force[c];
}

/* J_i^T S0 J_k in all blocks. */
static void add_blocks(radau *r, const damped all[STAGES], double h, double eta, const double S[],
                       int element)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    const int n = el->columns;
    for (int k = 0; k < STAGES; k++) {
        double SJ[ELEMENT_MAX_STRAINS * MODEL_MAX_COORDINATES];
        dense_mul(model_strains(m), model_strains(m), n, S, all[k].J, SJ);
        for (int i = 0; i < STAGES; i++) {
            const double part = eta * r->B[STAGES * i + k] / h;
            double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES] = {0};
            dense_add_transpose_mul(n, model_strains(m), n, all[i].J, SJ, K);
            for (int row = 0; row < n; row++)
                for (int column = 0; column < n; column++)
                    stages_add(&r->S, i, k, el->index[row], el->index[column],
                               part * K[n * row + column]);
        }
    }
}

void radau_damp(radau *r, int fresh, const instant *from, double h)
{
    const model *m = r->of.c->model;
    const size_t n = (size_t)model_strains(m);
    for (int i = 0; i < model_elements(m) && r->of.c->run->damping != NULL; i++) {
        const double eta = model_scene(m)->member[model_element(m, i)->member].damping;
        const double *S =
            r->of.c->run->damping->stiffness + (size_t)model_element(m, i)->kind * n * n;
        damped all[STAGES];
        if (eta == 0)
            continue;
        for (int stage = 0; stage < STAGES; stage++)
            take(r, from, stage, i, &all[stage]);
        for (int stage = 0; stage < STAGES; stage++)
            add_stress(r, all, h, eta, S, stage, i);
        if (fresh)
            add_blocks(r, all, h, eta, S, i);
    }
}

/* out = sum_j weight_j (e_j - e_0) */
static void sum_strains(const radau *r, const instant *from, const double weight[STAGES],
                        double out[])
{
    const model *m = r->of.c->model;
    const size_t count = (size_t)model_elements(m) * (size_t)model_strains(m);
    for (size_t k = 0; k < count; k++) {
        out[k] = 0;
        for (int j = 0; j < STAGES; j++)
            out[k] += weight[j] * (r->stage[j].state->e[k] - from->state->e[k]);
    }
}

double radau_dissipated(const radau *r, const instant *from, double h, double room[])
{
    double sum = 0;
    for (int i = 0; i < STAGES && r->of.c->run->damping != NULL; i++) {
        double weight[STAGES];
        for (int j = 0; j < STAGES; j++)
            weight[j] = r->B[STAGES * i + j] / h;
        sum_strains(r, from, weight, room);
        sum += h * r->weights[i] * damping_power(&r->of.c->eq, room);
    }
    return sum;
}

void radau_damp_error(const radau *r, const instant *from, double h, const double e[STAGES],
                      double g, double room[])
{
    double weight[STAGES];
    if (r->of.c->run->damping == NULL)
        return;
    for (int j = 0; j < STAGES; j++)
        weight[j] = -e[j] / h;
    sum_strains(r, from, weight, room);
    damping_follow(&r->of.c->eq, g, room, from->state->e);
}
