#include "harness/newton/undeformed.h"
#include "cases/scene/names.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/kinematics.h"
#include "harness/newton/ahead.h"
#include "harness/newton/equations_impl.h"

/* Elements of a model from which on room is worth more than the last digits of each J. */
enum { LARGE = 1000, FIRST_ROOM = 16 };

static size_t size_of(const model *m)
{
    return (size_t)m->strains * (size_t)(m->coordinates + m->strains + 1);
}

static status begin(const equations *eq, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    if (u->of != NULL)
        return STATUS_OK;
    u->room = m->elements < LARGE ? m->elements : FIRST_ROOM;
    u->of = malloc(((size_t)m->elements + 1) * sizeof *u->of);
    u->value = malloc((size_t)u->room * size_of(m) * sizeof *u->value + 1);
    if (u->of == NULL || u->value == NULL) { /* another analysis may ask again */
        free(u->of);
        free(u->value);
        u->of = NULL;
        u->value = NULL;
        return fault_set(f, STATUS_FAULT, "out of memory for the undeformed elements");
    }
    for (int i = 0; i < m->elements; i++)
        u->of[i] = NONE;
    return STATUS_OK;
}

/* Is element i as the one whose forms were kept last? Its triads are those of chords between places
 * that are rounded. */
static int alike(const equations *eq, int i)
{
    const model *m = eq->m;
    const mesh_element *el = &m->element[i], *last = &m->element[eq->run->undeformed.last];
    if (eq->run->undeformed.count == 0 || m->elements < LARGE || el->kind != last->kind)
        return 0;
    const double same = 1e-12 + 8 * DBL_EPSILON * vec3_norm(m->vertex[el->vertex[0]].position) /
                                    m->kind[el->kind].length;
    for (int k = 0; k < m->nodes; k++)
        for (int j = 0; j < 9; j++)
            if (!(fabs(el->triad[k][j] - last->triad[k][j]) <= same))
                return 0;
    return 1;
}

static int is_strained(const model *m, int i)
{
    return vec3_norm(m->kind[m->element[i].kind].strain) > 0;
}

/* C is that at no strain: what initial stresses add to it is left to geometric stiffnesses. */
static status evaluate_strained(const model *m, int i, const double e[], const double inner[],
                                double C[], double initial[])
{
    static const double none[ELEMENT_MAX_STRAINS];
    double own[ELEMENT_MAX_STRAINS];
    TRY(m->type->stress(m->kind[m->element[i].kind].data, none, inner,
                        &(stress_output){.sigma = initial, .C = C}));
    dense_mul_vec(m->strains, m->strains, C, e, own);
    for (int k = 0; k < m->strains; k++)
        initial[k] += own[k];
    return STATUS_OK;
}

static status evaluate(const equations *eq, int i, double J[], double C[], double initial[])
{
    const model *m = eq->m;
    double e[ELEMENT_MAX_STRAINS] = {0}, none[1] = {0};
    const double *inner = m->inner > 0 ? &m->rest->inner[(size_t)i * (size_t)m->inner] : none;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, m->rest, &m->element[i], x);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    ahead_strain(eq, i, x, &(strain_output){.e = e, .J = J});
    if (is_strained(m, i))
        return evaluate_strained(m, i, e, inner, C, initial);
    return ahead_stress(eq, i, e, inner, &(stress_output){.C = C});
}

/* Room for one more. */
static status grow(const equations *eq, fault *f)
{
    run_undeformed *u = &eq->run->undeformed;
    if (u->count < u->room)
        return STATUS_OK;
    double *more = realloc(u->value, 2 * (size_t)u->room * size_of(eq->m) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the undeformed elements");
    u->value = more;
    u->room *= 2;
    return STATUS_OK;
}

static status make(const equations *eq, int i, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    if (!alike(eq, i)) {
        TRY(grow(eq, f));
        double *J = u->value + (size_t)u->count * size_of(m), *C = J + m->strains * m->coordinates;
        const status outcome = evaluate(eq, i, J, C, C + m->strains * m->strains);
        if (outcome != STATUS_OK)
            return fault_set(
                f, outcome,
                "element %d of %s: its undeformed state is outside what %s can evaluate", i,
                scene_called(m->scene, SCENE_MEMBERS, m->element[i].member).text, m->type->name);
        u->last = i;
        u->count++;
    }
    u->of[i] = u->count - 1;
    return STATUS_OK;
}

status undeformed_of(const equations *eq, int i, undeformed_element *out, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    TRY(begin(eq, f));
    if (u->of[i] == NONE)
        TRY(make(eq, i, f));
    out->J = u->value + (size_t)u->of[i] * size_of(m);
    out->C = out->J + m->strains * m->coordinates;
    out->initial = is_strained(m, i) ? out->C + m->strains * m->strains : NULL;
    return STATUS_OK;
}

void undeformed_begin(const equations *eq)
{
    const model *m = eq->m;
    if (eq->run->undeformed.of != NULL)
        return;
    ahead_strains(eq, m->rest, AHEAD_E | AHEAD_J, NULL);
    ahead_stresses(eq, NULL, m->rest->inner);
}
