#include "harness/time/damping.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/kinematics.h"
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
    const size_t n = (size_t)m->strains, all = (size_t)m->elements * n;
    memset(d, 0, sizeof *d);
    if (!damping_acts(m->scene))
        return STATUS_OK;
    d->stiffness = calloc((size_t)m->kinds * n * n + 1, sizeof *d->stiffness);
    d->none = calloc(all + 1, sizeof *d->none);
    if (d->stiffness == NULL || d->none == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for damping");
    for (int i = 0; i < m->elements; i++) {
        const int kind = m->element[i].kind;
        const status outcome =
            m->type->stress(m->kind[kind].data, m->rest->e + (size_t)i * n,
                            m->rest->inner + (size_t)i * (size_t)m->inner,
                            &(stress_output){.C = d->stiffness + (size_t)kind * n * n});
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "element %d: outside what %s can evaluate", i,
                             m->type->name);
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
    for (int i = 0; begun == STATUS_OK && eq->run->damping != NULL && i < m->elements; i++) {
        const mesh_element *el = &m->element[i];
        const double eta = m->scene->member[el->member].damping;
        const size_t n = (size_t)m->strains;
        node_state x[ELEMENT_MAX_NODES];
        double J[E * ELEMENT_MAX_COORDINATES], S[E * E], A[X * X] = {0}, work[E * X];
        if (eta == 0)
            continue;
        kinematics_gather(m, s, el, x);
        m->type->strain(m->kind[el->kind].data, x, &(strain_output){.J = J});
        for (size_t k = 0; k < n * n; k++)
            S[k] = eta * d.stiffness[(size_t)el->kind * n * n + k];
        dense_add_congruence(m->strains, m->coordinates, J, S, A, work);
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
    memcpy(out, v, (size_t)(m->free + m->driven) * sizeof *out);
    for (int i = 0; i < m->vertices; i++) {
        const int *at = &m->vertex[i].coordinate[SCENE_RX];
        double R[9], own[3], turned[3];
        if ((m->vertex[i].body != i && i < m->first_release) || forms_of(m, i) != FORM_BODY)
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
    double *dx = calloc((size_t)(m->free + m->driven) + 1, sizeof *dx);
    if (dx == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for damping");
    in_space(m, s, v, dx);
    for (int i = 0; i < m->elements; i++) {
        node_state x[ELEMENT_MAX_NODES];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], local[ELEMENT_MAX_COORDINATES];
        kinematics_gather(m, s, &m->element[i], x);
        m->type->strain(m->kind[m->element[i].kind].data, x, &(strain_output){.J = J});
        kinematics_local(m, s, &m->element[i], dx, local);
        dense_mul_vec(m->strains, m->coordinates, J, local, rate + (size_t)i * (size_t)m->strains);
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
    memset(now->strain2, 0, (size_t)(m->elements * m->strains) * sizeof *now->strain2);
    damping_follow(eq, 0, now->strain, kinematics_strains(now->state));
    return STATUS_OK;
}

double damping_power(const equations *eq, const double rate[])
{
    const model *m = eq->m;
    const size_t n = (size_t)m->strains;
    double sum = 0;
    for (int i = 0; i < m->elements; i++)
        sum += m->scene->member[m->element[i].member].damping *
               dense_quadratic(m->strains,
                               eq->run->damping->stiffness + (size_t)m->element[i].kind * n * n,
                               rate + (size_t)i * n);
    return sum;
}
