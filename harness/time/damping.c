#include "harness/time/damping.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/forms.h"

int damping_acts(const scene *s)
{
    for (int i = 0; i < s->members; i++)
        if (s->member[i].damping > 0)
            return 1;
    return 0;
}

status damping_begin(const equations *eq, run_damping *d, fault *f)
{
    const model *m = eq->m;
    const size_t n = (size_t)model_strains(m), all = (size_t)model_elements(m) * n;
    memset(d, 0, sizeof *d);
    if (!damping_acts(model_scene(m)))
        return STATUS_OK;
    d->stiffness = calloc((size_t)model_kinds(m) * n * n + 1, sizeof *d->stiffness);
    d->none = calloc(all + 1, sizeof *d->none);
    if (d->stiffness == NULL || d->none == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for damping");
    for (int i = 0; i < model_elements(m); i++) {
        const int kind = model_element(m, i)->kind;
        const status outcome =
            model_type(m)->stress(model_kind(m, kind)->data, kinematics_rest(m)->e + (size_t)i * n,
                                  kinematics_rest(m)->inner + (size_t)i * (size_t)model_inner(m),
                                  &(stress_output){.C = d->stiffness + (size_t)kind * n * n});
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "element %d: outside what %s can evaluate", i,
                             model_type(m)->name);
    }
    eq->run->damping = d;
    damping_follow(eq, 0, d->none, d->none);
    return STATUS_OK;
}

void damping_end(const equations *eq, run_damping *d)
{
    eq->run->damping = NULL;
    free(d->stiffness);
    free(d->none);
}

void damping_follow(const equations *eq, double g, const double known[], const double from[])
{
    if (eq->run->damping == NULL)
        return;
    eq->run->damping->g = g;
    eq->run->damping->known = known;
    eq->run->damping->from = from;
}

status damping_matrix(const equations *eq, const model_state *s, sparse *C, fault *f)
{
    const model *m = eq->m;
    enum { X = MODEL_MAX_COORDINATES, E = ELEMENT_MAX_STRAINS };
    const mesh_pattern *p = assemble_of(eq->run->patterns, C);
    run_damping *const before = eq->run->damping;
    run_damping d;
    sparse_zero(C);
    eq->run->damping = NULL;
    const status begun = damping_begin(eq, &d, f);
    for (int i = 0; begun == STATUS_OK && eq->run->damping != NULL && i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        const double eta = model_scene(m)->member[el->member].damping;
        const size_t n = (size_t)model_strains(m);
        node_state x[ELEMENT_MAX_NODES];
        double J[E * ELEMENT_MAX_COORDINATES], S[E * E], A[X * X] = {0}, work[E * X];
        if (eta == 0)
            continue;
        kinematics_gather(m, s, el, x);
        model_type(m)->strain(model_kind(m, el->kind)->data, x, &(strain_output){.J = J});
        for (size_t k = 0; k < n * n; k++)
            S[k] = eta * d.stiffness[(size_t)el->kind * n * n + k];
        dense_add_congruence(model_strains(m), model_own_coordinates(m), J, S, A, work);
        eliminate_matrix(m, s, el, NULL, A);
        assemble_matrix(p, i, A, C);
    }
    damping_end(eq, &d);
    eq->run->damping = before;
    return begun;
}

/* Increments that the rates would be of an instant: those of rotations in fixed axes. */
static void in_space(const model *m, const model_state *s, const double v[], double out[])
{
    memcpy(out, v, (size_t)model_all_coordinates(m) * sizeof *out);
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        double R[9], own[3], turned[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY)
            continue;
        rotation_matrix(&s->q[4 * i], R);
        for (int k = 0; k < 3; k++)
            own[k] = v[at[k]];
        mat3_mul_vec(R, own, turned);
        for (int k = 0; k < 3; k++)
            out[at[k]] = turned[k];
    }
}

status damping_rates(const model *m, const model_state *s, const double v[], double rate[],
                     fault *f)
{
    double *dx = calloc((size_t)model_all_coordinates(m) + 1, sizeof *dx);
    if (dx == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for damping");
    in_space(m, s, v, dx);
    for (int i = 0; i < model_elements(m); i++) {
        node_state x[ELEMENT_MAX_NODES];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], local[ELEMENT_MAX_COORDINATES];
        kinematics_gather(m, s, model_element(m, i), x);
        model_type(m)->strain(model_kind_of(m, i)->data, x, &(strain_output){.J = J});
        kinematics_local(m, s, model_element(m, i), dx, local);
        dense_mul_vec(model_strains(m), model_own_coordinates(m), J, local,
                      rate + (size_t)i * (size_t)model_strains(m));
    }
    free(dx);
    return STATUS_OK;
}

status damping_now(const equations *eq, instant *now, fault *f)
{
    const model *m = eq->m;
    if (now->strain == NULL)
        return STATUS_OK;
    TRY(damping_rates(m, now->state, now->v, now->strain, f));
    memset(now->strain2, 0, (size_t)(model_elements(m) * model_strains(m)) * sizeof *now->strain2);
    damping_follow(eq, 0, now->strain, kinematics_strains(now->state));
    return STATUS_OK;
}

double damping_power(const equations *eq, const double rate[])
{
    const model *m = eq->m;
    const size_t n = (size_t)model_strains(m);
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++)
        sum +=
            model_scene(m)->member[model_element(m, i)->member].damping *
            dense_quadratic(model_strains(m),
                            eq->run->damping->stiffness + (size_t)model_element(m, i)->kind * n * n,
                            rate + (size_t)i * n);
    return sum;
}
