/* Mixed linearisation (N section 4): with J = de/dx and the independent e and sigma,
 *   de = D(x) - e + J dx,   sigma + dsigma = P'(e) + P''(e) de,
 * condensed element by element, so that stiff modes make no huge false stresses on the way. */
#include "harness/equations/linearise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/equations/ahead.h"
#include "harness/equations/chunk.h"
#include "harness/equations/equations_impl.h"
#include "harness/equations/loads.h"
#include "harness/model/discrete.h"

/* e, sigma of an element from D(x): displacement-only Newton. */
static status compatible_element(model *m, model_state *s, int i)
{
    const mesh_element *el = &m->element[i];
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, s, el, x);
    double *e = &s->e[(size_t)i * (size_t)m->strains],
           *sigma = &s->sigma[(size_t)i * (size_t)m->strains];
    ahead_strain(m, i, x, &(strain_output){.e = e});
    m->counters.strain_evaluations++;
    m->counters.stress_evaluations++;
    return ahead_stress(m, i, e, &s->inner[(size_t)i * (size_t)m->inner],
                        &(stress_output){.sigma = sigma});
}

status linearise_make_compatible(model *m, model_state *s, fault *f)
{
    status outcome = STATUS_OK;
    ahead_strains(m, s, AHEAD_E, NULL);
    ahead_stresses(m, NULL, s->inner);
    for (int i = 0; i < m->elements && outcome == STATUS_OK; i++) {
        outcome = compatible_element(m, s, i);
        if (outcome != STATUS_OK)
            fault_set(f, outcome, "element %d of member %d: outside what %s can evaluate", i,
                      m->element[i].member, m->type->name);
    }
    ahead_end(m);
    return outcome;
}

static double incompatibility_of(const model *m, const model_slot *w, double length)
{
    double largest = 0;
    for (int k = 0; k < m->strains; k++)
        largest = fmax(largest, fabs(w->incompatibility[k]) / length);
    return largest;
}

/* Internal less centrifugal forces of an element that was evaluated and, where wanted, their
 * tangent (K has H); both in model coordinates. */
static status element_equations(model *m, const model_state *s, const chunk_element *of,
                                int tangent, double path, element_part *part)
{
    const int i = of->index;
    const mesh_element *el = &m->element[i];
    const model_slot w = linearise_slot(m, i);
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    double present[ELEMENT_MAX_COORDINATES] = {0}; /* conjugate to sigma, which H belongs to */
    double *force = part->force, *K = part->K;
    if (of->outcome != STATUS_OK)
        return fault_set(&part->why, of->outcome,
                         "element %d of member %d: outside what %s can evaluate", i, el->member,
                         m->type->name);
    memset(force, 0, (size_t)m->coordinates * sizeof *force);
    if (m->rotates) {
        TRY(rotating_frame_add(m, of->x, i, path, force, tangent ? K : NULL, &part->why));
        memcpy(present, force, (size_t)m->coordinates * sizeof *force);
    }
    dense_add_transpose_mul(m->coordinates, m->strains, 1, w.J, w.sigma, force);
    if (tangent) {
        dense_add_congruence(m->strains, m->coordinates, w.J, w.C, K, work);
        if (!el->plain)
            dense_add_transpose_mul(m->coordinates, m->strains, 1, w.J,
                                    &s->sigma[(size_t)i * (size_t)m->strains], present);
        eliminate_matrix(m, s, el, present, K);
    }
    eliminate_forces(m, s, el, force);
    part->incompatibility = incompatibility_of(m, &w, m->kind[el->kind].length);
    return STATUS_OK;
}

/* force += K drive for the element's prescribed coordinates. */
static void add_driven(const model *m, const mesh_element *el, const double drive[],
                       const double K[], double force[])
{
    const int n = el->columns;
    for (int j = 0; j < n; j++) {
        const double step = el->index[j] >= m->free ? drive[el->index[j]] : 0;
        if (step == 0)
            continue;
        for (int i = 0; i < n; i++)
            force[i] += K[i * n + j] * step;
    }
}

/* Columns of the unknowns of conditions. */
static void add_columns(const model *m, const mesh_element *el, const double K[],
                        model_linearisation *lin)
{
    const int n = el->columns;
    for (int c = 0; c < lin->conditions; c++) {
        double *column = lin->column + c * (m->free + m->driven);
        for (int j = 0; j < n; j++) {
            if (el->index[j] != lin->condition[c].unknown)
                continue;
            for (int i = 0; i < n; i++)
                if (el->index[i] != NONE)
                    column[el->index[i]] += K[i * n + j];
        }
    }
}

/* What the threads of a team share. */
typedef struct shared_loop {
    model *m;
    const model_state *s;
    int tangent;
    double path;
} shared_loop;

/* The parts of elements [first, end), at most CHUNK_WINDOW, into part[0], ... */
static void fill_window(const shared_loop *loop, int first, int end, element_part part[])
{
    unsigned char done[CHUNK_WINDOW] = {0};
    int index[CHUNK_MOST], count;
    while ((count = chunk_next(loop->m, first, end, done, index)) > 0) {
        chunk_element element[CHUNK_MOST];
        for (int k = 0; k < count; k++) {
            element[k].index = index[k];
            element[k].H = loop->tangent ? part[index[k] - first].K : NULL;
        }
        chunk_evaluate(loop->m, loop->s, count, element);
        for (int k = 0; k < count; k++) {
            element_part *p = &part[index[k] - first];
            p->outcome =
                element_equations(loop->m, loop->s, &element[k], loop->tangent, loop->path, p);
        }
    }
}

static void fill_parts(void *context, int first, int end)
{
    const shared_loop *loop = context;
    for (int i = first; i < end; i += CHUNK_WINDOW)
        fill_window(loop, i, i + CHUNK_WINDOW < end ? i + CHUNK_WINDOW : end, &loop->m->part[i]);
}

/* Parts that are kept at a time without a team, at m->window; one where there is no memory. */
static int window_of(model *m)
{
    const int wanted = m->elements < CHUNK_WINDOW ? m->elements : CHUNK_WINDOW;
    if (chunk_size(m) == 1)
        return 1;
    if (m->window == NULL)
        m->window = malloc((size_t)wanted * sizeof *m->window);
    return m->window != NULL ? wanted : 1;
}

/* The element's equations into those of the model, but for K. */
static void add_part(model *m, const mesh_element *el, element_part *part, model_linearisation *lin)
{
    if (lin->drive != NULL)
        add_driven(m, el, lin->drive, part->K, part->force);
    add_columns(m, el, part->K, lin);
    phases_lap(&m->phases, PHASE_ELEMENTS);
    for (int k = 0; k < el->columns; k++)
        part->force[k] = -part->force[k];
    assemble_vector(el, part->force, lin->residual);
    lin->incompatibility = fmax(lin->incompatibility, part->incompatibility);
}

static status add_discrete(model *m, const model_state *s, model_linearisation *lin, fault *f)
{
    for (int i = 0; i < m->discretes; i++) {
        element_part part = {.incompatibility = 0};
        TRY(discrete_equations(m, s, &m->discrete[i], lin->path, part.force, part.K, f));
        add_part(m, &m->discrete[i].el, &part, lin);
        if (lin->K != NULL)
            assemble_discrete(&m->discrete[i].el, part.K, lin->K);
    }
    return STATUS_OK;
}

static status linearise_elements(model *m, const model_state *s, model_linearisation *lin, fault *f)
{
    element_part own, *part = m->part;
    const shared_loop loop = {m, s, lin->K != NULL || lin->drive != NULL || lin->conditions > 0,
                              lin->path};
    const mesh_pattern *p =
        lin->K == NULL ? NULL : &m->pattern[lin->K->row == m->pattern[1].matrix.row];
    const int together = m->team != NULL && !m->rotates; /* inertia counts its evaluations */
    const int window = together ? m->elements : window_of(m);
    memset(lin->residual, 0, (size_t)(m->free + m->driven) * sizeof *lin->residual);
    lin->incompatibility = 0;
    if (lin->conditions > 0)
        memset(lin->column, 0,
               (size_t)(lin->conditions * (m->free + m->driven)) * sizeof *lin->column);
    if (lin->K != NULL)
        sparse_zero(lin->K);
    if (together)
        team_run(m->team, m->elements, fill_parts, (void *)&loop);
    else
        part = window > 1 ? m->window : &own;
    for (int i = 0; i < m->elements; i++) {
        if (!together && i % window == 0)
            fill_window(&loop, i, i + window < m->elements ? i + window : m->elements, part);
        element_part *one = &part[i % window];
        m->counters.strain_evaluations++;
        m->counters.stress_evaluations++;
        if (one->outcome != STATUS_OK)
            return fault_set(f, one->outcome, "%s", one->why.text);
        add_part(m, &m->element[i], one, lin);
        if (p != NULL)
            assemble_matrix(p, i, one->K, lin->K);
        phases_lap(&m->phases, PHASE_ASSEMBLY);
    }
    TRY(add_discrete(m, s, lin, f));
    loads_add(m, s, lin->path, lin->residual);
    if (lin->K != NULL)
        loads_subtract_stiffness(m, s, lin->path, lin->K);
    phases_lap(&m->phases, PHASE_ASSEMBLY);
    return STATUS_OK;
}

status linearise_state(model *m, const model_state *s, model_linearisation *lin, fault *f)
{
    const int tangent = lin->K != NULL || lin->drive != NULL || lin->conditions > 0;
    ahead_strains(m, s, AHEAD_E | AHEAD_J | (tangent ? AHEAD_H : 0), s->sigma);
    ahead_stresses(m, s->e, s->inner);
    const status outcome = linearise_elements(m, s, lin, f);
    ahead_end(m);
    return outcome;
}

void linearise_node_force(model *m, const model_state *s, int node, double F[6])
{
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < m->elements; i++) {
        const mesh_element *el = &m->element[i];
        for (int k = 0; k < m->nodes; k++) {
            if (m->vertex[el->vertex[k]].body != node)
                continue;
            node_state x[ELEMENT_MAX_NODES];
            double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
                force[ELEMENT_MAX_COORDINATES] = {0}, rho[3], moment[3];
            kinematics_gather(m, s, el, x);
            m->type->strain(m->kind[el->kind].data, x, &(strain_output){.J = J});
            dense_add_transpose_mul(m->coordinates, m->strains, 1, J,
                                    &s->sigma[(size_t)i * (size_t)m->strains], force);
            rotating_frame_add(m, x, i, s->path, force, NULL,
                               NULL); /* never fails in a state that has been reached */
            kinematics_offset(m, s, el->vertex[k], rho);
            vec3_cross(rho, force + NODE_COORDINATES * k, moment);
            for (int c = 0; c < 3; c++) {
                F[c] += force[NODE_COORDINATES * k + c];
                F[3 + c] +=
                    force[NODE_COORDINATES * k + 3 + c] + (el->vertex[k] == node ? 0 : moment[c]);
            }
        }
    }
    discrete_node_force(m, s, node, F);
}
