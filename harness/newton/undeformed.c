#include "harness/newton/newton_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"

enum { LARGE = 1000, FIRST_ROOM = 16 };

static size_t size_of(const model *m)
{
    return (size_t)model_strains(m) * (size_t)(model_own_coordinates(m) + model_strains(m) + 1);
}

static status begin(const equations *eq, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    if (u->of != NULL)
        return STATUS_OK;
    u->room = model_elements(m) < LARGE ? model_elements(m) : FIRST_ROOM;
    u->of = malloc(((size_t)model_elements(m) + 1) * sizeof *u->of);
    u->value = malloc((size_t)u->room * size_of(m) * sizeof *u->value + 1);
    if (u->of == NULL || u->value == NULL) {
        free(u->of);
        free(u->value);
        u->of = NULL;
        u->value = NULL;
        return fault_memory(f, "the undeformed elements");
    }
    for (int i = 0; i < model_elements(m); i++)
        u->of[i] = NONE;
    return STATUS_OK;
}

/* Returns 1 if element i has the same derivatives as the last stored element. Triads may differ by
 * the rounding of the positions from which they are computed. */
static int alike(const equations *eq, int i)
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i),
                       *last = model_element(m, eq->run->undeformed.last);
    if (eq->run->undeformed.count == 0 || model_elements(m) < LARGE || el->kind != last->kind)
        return 0;
    const double same = 1e-12 + 8 * DBL_EPSILON *
                                    vec3_norm(model_vertex(m, el->vertex[0])->position) /
                                    model_kind(m, el->kind)->length;
    for (int k = 0; k < model_nodes(m); k++)
        for (int j = 0; j < 9; j++)
            if (!(fabs(el->triad[k][j] - last->triad[k][j]) <= same))
                return 0;
    return 1;
}

static int is_strained(const model *m, int i)
{
    return vec3_norm(model_kind_of(m, i)->strain) + vec3_norm(model_kind_of(m, i)->free) > 0;
}

/* Computes C at zero strain, and the initial stresses. Geometric stiffnesses contain the effect of
 * these stresses. */
static status evaluate_strained(const model *m, int i, const double e[], const double inner[],
                                double C[], double initial[])
{
    static const double none[ELEMENT_MAX_STRAINS];
    double own[ELEMENT_MAX_STRAINS], own_free[ELEMENT_MAX_STRAINS], strain[ELEMENT_MAX_STRAINS];
    TRY(model_type(m)->stress(
        model_kind_of(m, i)->data, none, inner,
        &(stress_output){
            .sigma = initial, .C = C, .history = model_history_of(m, kinematics_rest(m), i)}));
    free_strain_own(m, i, own_free);
    for (int k = 0; k < model_strains(m); k++)
        strain[k] = e[k] - own_free[k];
    dense_mul_vec(model_strains(m), model_strains(m), C, strain, own);
    for (int k = 0; k < model_strains(m); k++)
        initial[k] += own[k];
    return STATUS_OK;
}

static status make_symmetric(const model *m, double C[], fault *f)
{
    const int n = model_strains(m);
    double most = 0, apart = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double *const one = &C[i * n + j], *const other = &C[j * n + i];
            most = fmax(most, fabs(*one));
            apart = fmax(apart, fabs(*one - *other));
            *one = *other = (*one + *other) / 2;
        }
    return apart <= 1e-7 * most
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "the stiffness of an undeformed element of %s is not symmetric, which "
                           "linear analyses require; follow a static path or a motion",
                           model_formulation(m));
}

static status evaluate(const equations *eq, int i, double J[], double C[], double initial[])
{
    const model *m = eq->m;
    double e[ELEMENT_MAX_STRAINS] = {0}, none[1] = {0};
    const double *inner =
        model_inner(m) > 0 ? &kinematics_rest(m)->inner[(size_t)i * (size_t)model_inner(m)] : none;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), model_element(m, i), x);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    ahead_strain(
        eq, i, x,
        &(strain_output){.e = e, .J = J, .history = model_history_of(m, kinematics_rest(m), i)});
    if (is_strained(m, i))
        return evaluate_strained(m, i, e, inner, C, initial);
    return ahead_stress(
        eq, i, model_kind_of(m, i)->data, e, inner,
        &(stress_output){.C = C, .history = model_history_of(m, kinematics_rest(m), i)});
}

static status grow(const equations *eq, fault *f)
{
    run_undeformed *u = &eq->run->undeformed;
    if (u->count < u->room)
        return STATUS_OK;
    double *more = realloc(u->value, 2 * (size_t)u->room * size_of(eq->m) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "the undeformed elements");
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
        double *J = u->value + (size_t)u->count * size_of(m),
               *C = J + model_strains(m) * model_own_coordinates(m);
        const status outcome = evaluate(eq, i, J, C, C + model_strains(m) * model_strains(m));
        if (outcome != STATUS_OK)
            return fault_set(
                f, outcome,
                "element %d of %s: its undeformed state is outside the range that %s can evaluate; "
                "use more elements",
                i, scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text,
                model_type(m)->name);
        if (model_absolute(m))
            TRY(make_symmetric(m, C, f));
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
    out->C = out->J + model_strains(m) * model_own_coordinates(m);
    out->initial = is_strained(m, i) ? out->C + model_strains(m) * model_strains(m) : NULL;
    return STATUS_OK;
}

void undeformed_begin(const equations *eq)
{
    const model *m = eq->m;
    if (eq->run->undeformed.of != NULL)
        return;
    ahead_strains(eq, kinematics_rest(m), AHEAD_E | AHEAD_J, NULL);
    ahead_stresses(eq, kinematics_rest(m), NULL, kinematics_rest(m)->inner);
}

enum { X = ELEMENT_MAX_COORDINATES, SIX = SPRING_STRAINS };

static const mesh_discrete *spring_of(const model *m, int i)
{
    return model_discrete(m, model_discretes(m) - model_springs(m) + i);
}

static void springs_evaluate(const model *m, const mesh_discrete *d, const double sigma[],
                             double J[], double H[])
{
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), &d->el, x);
    spring_strain(d->el.nodes, x, NULL, &(strain_output){.J = J, .s = sigma, .H = H});
}

static void strains(const model *m, const mesh_discrete *d, const double x[], double e[SIX])
{
    double J[SIX * X], local[X];
    springs_evaluate(m, d, NULL, J, NULL);
    kinematics_local(m, kinematics_rest(m), &d->el, x, local);
    dense_mul_vec(SIX, NODE_COORDINATES * d->el.nodes, J, local, e);
}

void linear_springs_stiffness(const model *m, sparse *K)
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], k[X * X], work[SIX * X], S[SIX * SIX];
        memset(k, 0, (size_t)(d->el.columns * d->el.columns) * sizeof *k);
        springs_evaluate(m, d, NULL, J, NULL);
        spring_at_rest(d->spring, S);
        dense_add_congruence(SIX, NODE_COORDINATES * d->el.nodes, J, S, k, work);
        eliminate_matrix(m, kinematics_rest(m), &d->el, NULL, k);
        assemble_discrete(&d->el, k, K);
    }
}

void linear_springs_stresses(const model *m, const double x[], double sigma[])
{
    for (int i = 0; i < model_springs(m); i++) {
        double e[SIX], S[SIX * SIX];
        strains(m, spring_of(m, i), x, e);
        spring_at_rest(spring_of(m, i)->spring, S);
        dense_mul_vec(SIX, SIX, S, e, &sigma[SIX * i]);
    }
}

void linear_springs_forces(const model *m, const double sigma[], double f[])
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], force[X] = {0};
        springs_evaluate(m, d, NULL, J, NULL);
        dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, &sigma[SIX * i], force);
        eliminate_forces(m, kinematics_rest(m), &d->el, force);
        assemble_vector(&d->el, force, f);
    }
}

void linear_springs_node_force(const model *m, const double sigma[], int node, double F[6])
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], force[X] = {0}, rho[3], moment[3];
        springs_evaluate(m, d, NULL, J, NULL);
        dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, &sigma[SIX * i], force);
        for (int k = 0; k < d->el.nodes; k++) {
            const double *at = force + NODE_COORDINATES * k;
            if (model_vertex(m, d->el.vertex[k])->body != node)
                continue;
            kinematics_offset(m, kinematics_rest(m), d->el.vertex[k], rho);
            vec3_cross(rho, at, moment);
            for (int c = 0; c < 6; c++)
                F[c] += at[c] + (c >= 3 && d->el.vertex[k] != node ? moment[c - 3] : 0);
        }
    }
}

static void geometric(const model *m, const mesh_discrete *d, const double sigma[], double H[])
{
    double J[SIX * X], force[X] = {0};
    springs_evaluate(m, d, sigma, J, H);
    dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, sigma, force);
    eliminate_matrix(m, kinematics_rest(m), &d->el, force, H);
}

void linear_springs_geometric_stiffness(const model *m, const double sigma[], sparse *G)
{
    for (int i = 0; i < model_springs(m); i++) {
        double H[X * X];
        geometric(m, spring_of(m, i), &sigma[SIX * i], H);
        assemble_discrete(&spring_of(m, i)->el, H, G);
    }
}

double linear_springs_energy2(const model *m, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        double e[SIX], S[SIX * SIX];
        strains(m, spring_of(m, i), x, e);
        spring_at_rest(spring_of(m, i)->spring, S);
        sum += dense_quadratic(SIX, S, e);
    }
    return sum;
}

/* Returns a bound of the rounding error of the terms of J x, as for elements. */
double linear_springs_rounding(const model *m, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        const int n = NODE_COORDINATES * d->el.nodes;
        double J[SIX * X], local[X], e[SIX], sigma[SIX], S[SIX * SIX];
        spring_at_rest(d->spring, S);
        springs_evaluate(m, d, NULL, J, NULL);
        kinematics_local(m, kinematics_rest(m), &d->el, x, local);
        dense_mul_vec(SIX, n, J, local, e);
        dense_mul_vec(SIX, SIX, S, e, sigma);
        for (int k = 0; k < SIX; k++)
            for (int j = 0; j < n; j++)
                sum += DBL_EPSILON * 2 * fabs(sigma[k] * J[k * n + j] * local[j]);
    }
    return sum;
}

double linear_springs_geometric_energy2(const model *m, const double sigma[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_element *el = &spring_of(m, i)->el;
        double H[X * X], own[X];
        geometric(m, spring_of(m, i), &sigma[SIX * i], H);
        for (int k = 0; k < el->columns; k++)
            own[k] = el->index[k] == NONE ? 0 : x[el->index[k]];
        sum += dense_quadratic(el->columns, H, own);
    }
    return sum;
}

static size_t bytes(size_t count, size_t size)
{
    const size_t unit = _Alignof(max_align_t);
    return (count * size + unit - 1) / unit * unit;
}

static void *part(char **from, size_t count, size_t size)
{
    void *here = *from;
    *from += bytes(count, size);
    return here;
}

static int allocate(const equations *eq)
{
    const model *m = eq->m;
    const size_t n = (size_t)model_elements(m), s = (size_t)model_strains(m),
                 c = (size_t)model_own_coordinates(m), nodes = (size_t)model_nodes(m),
                 memory = (size_t)model_memory(m);
    const size_t size = bytes(1, sizeof(run_ahead)) + 3 * bytes(n, sizeof(void *)) +
                        bytes(n * nodes, sizeof(node_state)) + bytes(n, sizeof(strain_output)) +
                        bytes(n, sizeof(stress_output)) + bytes(n, sizeof(status)) +
                        2 * bytes(n * s, sizeof(double)) + bytes(n * s * c, sizeof(double)) +
                        bytes(n * c * c, sizeof(double)) + bytes(n * s * s, sizeof(double)) +
                        bytes(n * memory, sizeof(double));
    char *block = eq->run->ahead == NULL ? malloc(size) : NULL;
    if (block == NULL)
        return eq->run->ahead != NULL;
    run_ahead *a = eq->run->ahead = part(&block, 1, sizeof *a);
    memset(a, 0, sizeof *a);
    a->data = part(&block, n, sizeof(void *));
    a->at = part(&block, n, sizeof(void *));
    a->inner = part(&block, n, sizeof(void *));
    a->x = part(&block, n * nodes, sizeof *a->x);
    a->strain = part(&block, n, sizeof *a->strain);
    a->stress = part(&block, n, sizeof *a->stress);
    a->outcome = part(&block, n, sizeof *a->outcome);
    a->e = part(&block, n * s, sizeof *a->e);
    a->sigma = part(&block, n * s, sizeof *a->sigma);
    a->J = part(&block, n * s * c, sizeof *a->J);
    a->H = part(&block, n * c * c, sizeof *a->H);
    a->C = part(&block, n * s * s, sizeof *a->C);
    a->memory = part(&block, n * memory, sizeof *a->memory);
    for (int i = 0; i < model_elements(m); i++)
        a->data[i] = model_kind_of(m, i)->data;
    return 1;
}

void ahead_strains(const equations *eq, const model_state *s, int what, const double sigma[])
{
    const model *m = eq->m;
    if (model_type(m)->strain_many == NULL || model_type(m)->lanes > 0 || model_elements(m) == 0 ||
        !allocate(eq))
        return;
    run_ahead *a = eq->run->ahead;
    const int n = model_strains(m), c = model_own_coordinates(m);
    for (int i = 0; i < model_elements(m); i++) {
        kinematics_gather(m, s, model_element(m, i), a->x + i * model_nodes(m));
        a->strain[i] = (strain_output){.e = what & AHEAD_E ? a->e + i * n : NULL,
                                       .J = what & AHEAD_J ? a->J + i * n * c : NULL,
                                       .s = what & AHEAD_H ? sigma + i * n : NULL,
                                       .H = what & AHEAD_H ? a->H + i * c * c : NULL,
                                       .history = model_history_of(m, s, i)};
    }
    model_type(m)->strain_many(model_elements(m), a->data, a->x, a->strain);
    a->what = what;
}

void ahead_stresses(const equations *eq, const model_state *s, const double e[],
                    const double inner[])
{
    const model *m = eq->m;
    if (model_type(m)->stress_many == NULL || model_type(m)->lanes > 0 || model_elements(m) == 0 ||
        !allocate(eq))
        return;
    run_ahead *a = eq->run->ahead;
    const int n = model_strains(m);
    if (e == NULL && !(a->what & AHEAD_E))
        return;
    for (int i = 0; i < model_elements(m); i++) {
        a->at[i] = (e != NULL ? e : a->e) + i * n;
        a->inner[i] = inner + i * model_inner(m);
        a->stress[i] =
            (stress_output){.sigma = a->sigma + i * n,
                            .C = a->C + i * n * n,
                            .memory = model_memory(m) > 0 ? a->memory + i * model_memory(m) : NULL,
                            .history = model_history_of(m, s, i)};
    }
    model_type(m)->stress_many(model_elements(m), a->data, a->at, a->inner, a->stress, a->outcome);
    a->stresses = 1;
}

void ahead_end(const equations *eq)
{
    if (eq->run->ahead != NULL)
        eq->run->ahead->what = eq->run->ahead->stresses = 0;
}

static void copy(double *to, const double *from, int count)
{
    if (to != NULL)
        memcpy(to, from, (size_t)count * sizeof *to);
}

void ahead_copy_strain(const equations *eq, int i, const strain_output *out)
{
    const model *m = eq->m;
    const run_ahead *a = eq->run->ahead;
    const int n = model_strains(m), c = model_own_coordinates(m);
    copy(out->e, a->e + i * n, n);
    copy(out->J, a->J + i * n * c, n * c);
    if (out->s != NULL)
        copy(out->H, a->H + i * c * c, c * c);
}

status ahead_copy_stress(const equations *eq, int i, const stress_output *out)
{
    const model *m = eq->m;
    const run_ahead *a = eq->run->ahead;
    const int n = model_strains(m);
    copy(out->sigma, a->sigma + i * n, n);
    copy(out->C, a->C + i * n * n, n * n);
    copy(out->memory, a->memory + i * model_memory(m), model_memory(m));
    return a->outcome[i];
}
