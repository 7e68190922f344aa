/* Masses of ends that are released from their nodes. The body has the velocities v and w, and the
 * node has the offset p from the body. With released rotations t about axes b, shifts s along d,
 * and q = sum d s:
 *     w_end = w + sum b t',   v_end = v + w x p + w_end x q + sum d s',
 *     w_end' = w' + sum b t'' + sum t' (angular velocity before this rotation) x b,
 *     a_end = a + w' x p + w x (w x p) + w_end' x q + w_end x (w_end x q)
 *             + 2 w_end x sum d s' + sum d s''.
 * The rates of three released rotations are the angular velocity in the axes of the end. */
#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/formulations/formulations.h"

enum { BALL = 3 };

static void add_cross(const double w[3], const double r[3], double scale, double out[3])
{
    double moved[3];
    vec3_cross(w, r, moved);
    for (int i = 0; i < 3; i++)
        out[i] += scale * moved[i];
}

static void add_cross_twice(const double w[3], const double r[3], double out[3])
{
    double once[3];
    vec3_cross(w, r, once);
    add_cross(w, once, 1, out);
}

void released_columns(const model *m, const model_state *s, int vertex, released_masses *out)
{
    const mesh_release *r = release_of(m, vertex);
    const int body = model_vertex(m, vertex)->body;
    out->count = kinematics_node_jacobian(m, s, vertex, KINEMATICS_MOST, out->index, out->T);
    out->own = out->count - (r != NULL ? r->turns + r->slides : 0);
    out->body = forms_of(m, body) == FORM_BODY ? out->own - 3 : NONE;
    out->ball = r != NULL && r->turns == BALL ? out->own : NONE;
}

/* Copies the translations (turn 0) or the rotations (turn 1) of a column of T. */
static void column_of(const released_masses *of, int column, int turn, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = of->T[(3 * turn + i) * of->count + column];
}

static void add_turns(const mesh_release *r, const released_masses *of, const double v[],
                      const double a[], frame_rates *out)
{
    if (r->turns == BALL) {
        double w[3], wd[3];
        for (int i = 0; i < 3; i++) {
            w[i] = v[of->index[of->own + i]];
            wd[i] = a != NULL ? a[of->index[of->own + i]] : 0;
        }
        mat3_mul_vec(out->R, w, out->w);
        mat3_mul_vec(out->R, wd, out->wd);
        return;
    }
    for (int k = 0; k < r->turns; k++) {
        const int c = of->index[of->own + k];
        double b[3];
        column_of(of, of->own + k, 1, b);
        add_cross(out->w, b, v[c], out->wd);
        for (int i = 0; i < 3; i++) {
            out->w[i] += b[i] * v[c];
            out->wd[i] += a != NULL ? b[i] * a[c] : 0;
        }
    }
}

void released_rates(const model *m, const model_state *s, int vertex, const double v[],
                    const double a[], frame_rates *out)
{
    const mesh_release *r = release_of(m, vertex);
    released_masses of;
    frame_rates at;
    double p[3], end[3], place[3], q[3], sliding[3] = {0, 0, 0};
    released_columns(m, s, vertex, &of);
    forms_rates(m, s, model_vertex(m, vertex)->body, v, a, &at);
    kinematics_offset(m, s, vertex, p);
    kinematics_position(m, s, vertex, end);
    kinematics_position(m, s, model_vertex(m, vertex)->body, place);
    *out = at;
    rotation_matrix(&s->q[4 * vertex], out->R);
    add_turns(r, &of, v, a, out);
    add_cross(at.w, p, 1, out->v);
    add_cross(at.wd, p, 1, out->a);
    add_cross_twice(at.w, p, out->a);
    for (int k = 0; k < r->slides; k++) {
        const int column = of.own + r->turns + k;
        double d[3];
        column_of(&of, column, 0, d);
        for (int i = 0; i < 3; i++) {
            sliding[i] += d[i] * v[of.index[column]];
            out->a[i] += a != NULL ? d[i] * a[of.index[column]] : 0;
        }
    }
    for (int i = 0; i < 3; i++) {
        q[i] = end[i] - place[i] - p[i];
        out->v[i] += sliding[i];
    }
    add_cross(out->w, q, 1, out->v);
    add_cross(out->wd, q, 1, out->a);
    add_cross_twice(out->w, q, out->a);
    add_cross(out->w, sliding, 2, out->a);
}

void released_moving(const double own[6], double mass, const double moment[3], frame_rates *r)
{
    double turned[3];
    mat3_mul_vec(r->R, own + 3, r->w);
    vec3_cross(r->w, moment, turned);
    for (int i = 0; i < 3; i++)
        r->v[i] = own[i] - (mass > 0 ? turned[i] / mass : 0);
}

void released_add_force(const model *m, const model_state *s, int vertex, const double F[6],
                        double out[])
{
    released_masses of;
    released_columns(m, s, vertex, &of);
    for (int k = 0; k < of.count; k++)
        for (int i = 0; i < 6; i++)
            out[of.index[k]] += of.T[i * of.count + k] * F[i];
}

static void turn_columns(const released_masses *of, int first, const double B[9], double out[])
{
    for (int i = 0; i < 6 && first != NONE; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += of->T[i * of->count + first + k] * B[3 * k + j];
            out[i * of->count + first + j] = sum;
        }
}

void released_motion(const released_masses *of, double plain, const double body[9],
                     const double ball[9], double out[6 * KINEMATICS_MOST])
{
    for (int i = 0; i < 6 * of->count; i++)
        out[i] = plain * of->T[i];
    turn_columns(of, of->body, body, out);
    turn_columns(of, of->ball, ball, out);
}

void released_project(const released_masses *of, const double A[36], const double motion[],
                      double out[KINEMATICS_MOST * KINEMATICS_MOST])
{
    const int n = of->count;
    double half[6 * KINEMATICS_MOST];
    memset(half, 0, sizeof half);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++)
            for (int j = 0; j < n; j++)
                half[i * n + j] += A[6 * i + k] * motion[k * n + j];
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 6; k++)
            for (int j = 0; j < n; j++)
                out[i * n + j] += of->T[k * n + i] * half[k * n + j];
}

/* Computes the damping matrix V [strains x strains] of the formulation. Returns 1 unless it is
 * zero. */
static int own_damping(const model *m, int kind, double V[])
{
    const int n = model_strains(m) * model_strains(m);
    memset(V, 0, (size_t)n * sizeof *V);
    if (model_type(m)->damping == NULL)
        return 0;
    model_type(m)->damping(model_kind(m, kind)->data, V);
    for (int k = 0; k < n; k++)
        if (V[k] != 0)
            return 1;
    return 0;
}

int damping_of_elements(const model *m)
{
    const scene *s = model_scene(m);
    double V[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
    for (int i = 0; i < s->members; i++)
        if (s->member[i].damping > 0)
            return 1;
    for (int i = 0; i < model_kinds(m) && model_type(m)->damping != NULL; i++)
        if (own_damping(m, i, V))
            return 1;
    return 0;
}

static int has_dashpots(const scene *s)
{
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_damps(&s->spring[i]))
            return 1;
    return 0;
}

int damping_acts(const model *m)
{
    return has_dashpots(model_scene(m)) || damping_of_elements(m);
}

static size_t of_members(const model *m)
{
    return (size_t)model_elements(m) * (size_t)model_strains(m);
}

typedef struct damped_kinds {
    int *first; /* [kinds] first matrix of a kind, or NONE */
    int *next,
        *element; /* [count] next matrix of the same kind, or NONE; an element with this matrix */
    double *eta;  /* [count] [s] */
    int count;
} damped_kinds;

static status kinds_alloc(const model *m, damped_kinds *k, fault *f)
{
    const size_t elements = (size_t)model_elements(m) + 1, kinds = (size_t)model_kinds(m);
    *k = (damped_kinds){.first = malloc((kinds + 2 * elements) * sizeof(int)),
                        .eta = malloc(elements * sizeof(double))};
    if (k->first == NULL || k->eta == NULL)
        return fault_memory(f, "damping");
    for (size_t i = 0; i < kinds; i++)
        k->first[i] = NONE;
    k->next = k->first + kinds;
    k->element = k->next + elements;
    return STATUS_OK;
}

static int matrix_of(const model *m, int element, double eta, damped_kinds *k)
{
    int *to = &k->first[model_element(m, element)->kind];
    while (*to != NONE && k->eta[*to] != eta)
        to = &k->next[*to];
    if (*to != NONE)
        return *to;
    k->next[k->count] = NONE;
    k->element[k->count] = element;
    k->eta[k->count] = eta;
    *to = k->count;
    return k->count++;
}

/* Returns STATUS_REFUSED unless the damping matrix of the formulation is symmetric and positive
 * semidefinite up to rounding. C: stiffness at rest. */
static status dissipates(const char *name, int n, const double C[], const double V[], fault *f)
{
    static const char shown[] = "('energy' in the output of element-test shows the error)";
    double B[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
    const int wrong = damping_scale(n, C, V, B);
    if (wrong < n * n)
        return fault_set(f, STATUS_REFUSED,
                         "formulation %s: entry %d, %d of its damping matrix is %s; give finite "
                         "numbers %s",
                         name, wrong / n + 1, wrong % n + 1, isnan(V[wrong]) ? "NaN" : "Inf",
                         shown);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            if (!(fabs(B[n * i + j] - B[n * j + i]) <= DAMPING_ROUNDING))
                return fault_set(f, STATUS_REFUSED,
                                 "formulation %s: entry %d, %d of its damping matrix is %.6g, but "
                                 "the transposed entry is %.6g; give a symmetric matrix %s",
                                 name, i + 1, j + 1, V[n * i + j], V[n * j + i], shown);
    for (int i = 0; i < n; i++) {
        if (B[n * i + i] < 0)
            return fault_set(f, STATUS_REFUSED,
                             "formulation %s: entry %d, %d of its damping matrix is %.6g N s/m, so "
                             "motions would gain energy; give a positive semidefinite matrix %s",
                             name, i + 1, i + 1, V[n * i + i], shown);
        B[n * i + i] += DAMPING_ROUNDING;
    }
    if (dense_cholesky(n, B) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "formulation %s: its damping matrix has a negative eigenvalue, so motions "
                         "would gain energy; give a positive semidefinite matrix %s",
                         name, shown);
    return STATUS_OK;
}

/* Computes V, the sum of eta S0 and the damping matrix of the formulation, and the longest
 * relaxation time. */
static status fill_matrix(const model *m, int element, double eta, double V[], double *slowest,
                          fault *f)
{
    const int n = model_strains(m), kind = model_element(m, element)->kind;
    const size_t at = (size_t)element;
    double S[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
    const status outcome = model_type(m)->stress(
        model_kind(m, kind)->data, kinematics_rest(m)->e + at * (size_t)n,
        kinematics_rest(m)->inner + at * (size_t)model_inner(m), &(stress_output){.C = S});
    if (outcome != STATUS_OK)
        return fault_set(f, outcome,
                         "element %d: its state is outside the range that %s can evaluate; use "
                         "smaller steps or more elements",
                         element, model_type(m)->name);
    if (own_damping(m, kind, V))
        TRY(dissipates(model_type(m)->name, n, S, V, f));
    for (int k = 0; k < n * n; k++)
        V[k] += eta * S[k];
    for (int k = 0; k < n * n; k += n + 1)
        if (V[k] > 0)
            *slowest = fmax(*slowest, S[k] > 0 ? V[k] / S[k] : INFINITY);
    return STATUS_OK;
}

static status fill_matrices(const model *m, double more, damped_kinds *k, run_damping *d, fault *f)
{
    const size_t square = (size_t)model_strains(m) * (size_t)model_strains(m);
    TRY(kinds_alloc(m, k, f));
    for (int i = 0; i < model_elements(m); i++) {
        const double eta = model_scene(m)->member[model_element(m, i)->member].damping + more;
        d->which[i] = eta > 0 || model_type(m)->damping != NULL ? matrix_of(m, i, eta, k) : NONE;
    }
    if (k->count > 0 && model_absolute(m))
        return fault_set(f, STATUS_REFUSED,
                         "damping of members requires strains, but %s computes forces with a "
                         "history; damp the masses or springs instead, or use another formulation",
                         model_formulation(m));
    d->matrix = calloc((size_t)k->count * square + 1, sizeof *d->matrix);
    d->slowest = calloc((size_t)k->count + 1, sizeof *d->slowest);
    if (d->matrix == NULL || d->slowest == NULL)
        return fault_memory(f, "damping");
    for (int i = 0; i < k->count; i++)
        TRY(fill_matrix(m, k->element[i], k->eta[i], d->matrix + (size_t)i * square, &d->slowest[i],
                        f));
    return STATUS_OK;
}

static status matrices_alloc(const model *m, double more, run_damping *d, fault *f)
{
    const size_t all = (size_t)model_stresses(m);
    damped_kinds kinds = {0};
    d->which = malloc(((size_t)model_elements(m) + 1) * sizeof *d->which);
    d->none = calloc(2 * all + 1, sizeof *d->none);
    if (d->which == NULL || d->none == NULL)
        return fault_memory(f, "damping");
    d->begin = d->none + all;
    const status outcome = fill_matrices(m, more, &kinds, d, f);
    free(kinds.first);
    free(kinds.eta);
    return outcome;
}

static void matrices_free(run_damping *d)
{
    free(d->which);
    free(d->matrix);
    free(d->slowest);
    free(d->none);
}

status damping_begin(const equations *eq, run_damping *d, fault *f)
{
    memset(d, 0, sizeof *d);
    if (!damping_acts(eq->m))
        return STATUS_OK;
    TRY(matrices_alloc(eq->m, 0, d, f));
    eq->run->damping = d;
    damping_follow(eq, 0, d->none, NULL);
    return STATUS_OK;
}

void damping_end(const equations *eq, run_damping *d)
{
    eq->run->damping = NULL;
    matrices_free(d);
}

void damping_strains(const model *m, const model_state *s, double e[])
{
    memcpy(e, kinematics_strains(s), of_members(m) * sizeof *e);
    dashpots_deformations(m, s, e + of_members(m));
}

void damping_follow(const equations *eq, double g, const double known[], const model_state *from)
{
    run_damping *d = eq->run->damping;
    if (d == NULL)
        return;
    if (from != NULL)
        damping_strains(eq->m, from, d->begin);
    d->g = g;
    d->known = known;
    d->from = from != NULL ? d->begin : d->none;
    d->springs = (spring_rates){g, known + of_members(eq->m), d->from + of_members(eq->m)};
}

status damping_matrix(const equations *eq, const model_state *s, double more, sparse *C, fault *f)
{
    const model *m = eq->m;
    enum { X = MODEL_MAX_COORDINATES, E = ELEMENT_MAX_STRAINS };
    const mesh_pattern *p = assemble_of(eq->run->patterns, C);
    run_damping d = {0};
    sparse_zero(C);
    const int members = more > 0 || damping_of_elements(m);
    const status outcome = members ? matrices_alloc(m, more, &d, f) : STATUS_OK;
    for (int i = 0; outcome == STATUS_OK && members && i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        const double *V = run_damping_of(&d, m, i);
        node_state x[ELEMENT_MAX_NODES];
        double J[E * ELEMENT_MAX_COORDINATES], A[X * X], work[E * X];
        if (V == NULL)
            continue;
        memset(A, 0, (size_t)(el->columns * el->columns) * sizeof *A);
        kinematics_gather(m, s, el, x);
        model_type(m)->strain(model_kind(m, el->kind)->data, x,
                              &(strain_output){.J = J, .history = model_history_of(m, s, i)});
        dense_add_congruence(model_strains(m), model_own_coordinates(m), J, V, A, work);
        eliminate_matrix(m, s, el, NULL, A);
        assemble_matrix(p, i, A, C);
    }
    if (outcome == STATUS_OK)
        dashpots_matrix(m, s, more, C);
    matrices_free(&d);
    return outcome;
}

/* Computes the increments that correspond to the rates v of a state, with rotations about fixed
 * axes. */
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
        return fault_memory(f, "damping");
    in_space(m, s, v, dx);
    for (int i = 0; i < model_elements(m); i++) {
        node_state x[ELEMENT_MAX_NODES];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], local[ELEMENT_MAX_COORDINATES];
        kinematics_gather(m, s, model_element(m, i), x);
        model_type(m)->strain(model_kind_of(m, i)->data, x,
                              &(strain_output){.J = J, .history = model_history_of(m, s, i)});
        kinematics_local(m, s, model_element(m, i), dx, local);
        dense_mul_vec(model_strains(m), model_own_coordinates(m), J, local,
                      rate + (size_t)i * (size_t)model_strains(m));
    }
    dashpots_rates(m, s, dx, rate + of_members(m));
    free(dx);
    return STATUS_OK;
}

size_t dashpots_room(const model *m)
{
    return (size_t)model_all_coordinates(m) + (size_t)(SPRING_STRAINS * model_springs(m)) + 1;
}

static double *rates_of_dashpots(const model *m, const model_state *s, const double v[],
                                 double room[])
{
    double *rate = room + model_all_coordinates(m);
    in_space(m, s, v, room);
    dashpots_rates(m, s, room, rate);
    return rate;
}

double dashpots_subtract(const model *m, const model_state *s, const double v[], double room[],
                         double out[])
{
    if (!has_dashpots(model_scene(m)))
        return 0;
    double *rate = rates_of_dashpots(m, s, v, room);
    for (int k = 0; k < SPRING_STRAINS * model_springs(m); k++)
        rate[k] = -rate[k];
    dashpots_add_forces(m, s, rate, out);
    return dashpots_power(m, rate);
}

double springs_circulating_power(const model *m, const model_state *s, const double v[],
                                 double room[])
{
    const double *rate = NULL;
    double sum = 0;
    for (int i = 0; i < model_scene(m)->springs; i++) {
        double d[SPRING_STRAINS], J[SPRING_STRAINS * ELEMENT_MAX_COORDINATES];
        if (!scene_spring_circulates(&model_scene(m)->spring[i]))
            continue;
        if (rate == NULL)
            rate = rates_of_dashpots(m, s, v, room);
        dashpots_strains(m, s, i, d, J);
        sum += spring_circulated(m, i, d, rate + (ptrdiff_t)SPRING_STRAINS * i);
    }
    return sum;
}

status dashpots_at_node(const model *m, const model_state *s, const double v[], int node,
                        double F[6], fault *f)
{
    if (!has_dashpots(model_scene(m)))
        return STATUS_OK;
    double *room = calloc(dashpots_room(m), sizeof *room);
    if (room == NULL)
        return fault_memory(f, "dashpots");
    dashpots_node_force(m, s, rates_of_dashpots(m, s, v, room), node, F);
    free(room);
    return STATUS_OK;
}

status damping_now(const equations *eq, motion_state *now, fault *f)
{
    const model *m = eq->m;
    if (now->strain == NULL)
        return STATUS_OK;
    TRY(damping_rates(m, now->state, now->v, now->strain, f));
    memset(now->strain2, 0, (size_t)model_stresses(m) * sizeof *now->strain2);
    damping_follow(eq, 0, now->strain, NULL);
    return STATUS_OK;
}

double damping_power(const equations *eq, const double rate[])
{
    const model *m = eq->m;
    const size_t n = (size_t)model_strains(m);
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const double *V = run_damping_of(eq->run->damping, m, i);
        if (V != NULL)
            sum += dense_quadratic(model_strains(m), V, rate + (size_t)i * n);
    }
    return sum + dashpots_power(m, rate + of_members(m));
}

static int turns_of(const model *m, int vertex)
{
    const mesh_vertex *v = model_vertex(m, vertex);
    int count = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ; c++)
        count += v->coordinate[c] != NONE;
    return count;
}

rotation_form forms_of(const model *m, int vertex)
{
    if (model_vertex(m, vertex)->angles > 0)
        return FORM_SEQUENCE;
    return turns_of(m, vertex) == 3 ? FORM_BODY : FORM_AXIS;
}

/* Returns 1 if at most one rotation is not fixed, even if fixed rotations have kept rows. In a
 * plane scene, this is the rotation about its normal. */
static int keeps_axis(const model *m, int vertex)
{
    int moving = 0;
    if (scene_normal(model_scene(m)) != SCENE_NONE)
        return 1;
    for (int k = 0; k < 3; k++)
        moving += model_scene(m)->node[vertex].angle[k] != SCENE_HELD;
    return moving <= 1;
}

/* Returns REFUSED with a message that names the two axes of free rotation and the third axis. */
static status refuse_turns(const model *m, int vertex, fault *f)
{
    static const char axis[] = "xyz";
    int last = 2, first;
    while (last > 0 && model_scene(m)->node[vertex].angle[last] == SCENE_HELD)
        last--;
    first = last > 0 ? last - 1 : 0;
    while (first > 0 && model_scene(m)->node[vertex].angle[first] == SCENE_HELD)
        first--;
    return fault_set(f, STATUS_REFUSED,
                     "%s: a motion requires the orientation of the node, which rotations about "
                     "fixed axes do not determine: a rotation about %c, then about %c, and back "
                     "about both axes results in a rotation about %c; give the rotation as a "
                     "sequence of angles or as a vector, or fix one more rotation",
                     scene_called(model_scene(m), SCENE_NODES, vertex).text, axis[first],
                     axis[last], axis[3 - first - last]);
}

status forms_check(const model *m, fault *f)
{
    for (int i = 0; i < model_first_release(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        if (v->body != i || v->angles > 0)
            continue;
        int driven = 0;
        for (int c = SCENE_RX; c <= SCENE_RZ; c++)
            driven += v->coordinate[c] >= model_unknowns(m);
        const int turns = turns_of(m, i);
        const int loose = turns == 3 && driven > 0 && v->vector_driver[0] == NONE;
        if (turns == 2 || (loose && !keeps_axis(m, i)))
            return refuse_turns(m, i, f);
    }
    return STATUS_OK;
}

/* Rates of angles a_k about axes b_k, where each axis rotates with the previous angles: w = sum b_k
 * a_k', w' = sum b_k a_k'' + sum_(j<k) a_j' a_k' b_j x b_k. */
static void sequence_rates(const model *m, const model_state *s, int vertex, const double v[],
                           const double a[], frame_rates *out)
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3], rate[3] = {0, 0, 0};
    kinematics_axes(m, s, vertex, b);
    for (int k = 0; k < frame->angles; k++) {
        const int c = frame->coordinate[SCENE_RX + k];
        if (c == NONE)
            continue;
        rate[k] = v[c];
        for (int i = 0; i < 3; i++) {
            out->w[i] += b[k][i] * v[c];
            out->wd[i] += a != NULL ? b[k][i] * a[c] : 0;
        }
        for (int j = 0; j < k; j++) {
            double carried[3];
            vec3_cross(b[j], b[k], carried);
            for (int i = 0; i < 3; i++)
                out->wd[i] += rate[j] * rate[k] * carried[i];
        }
    }
}

static void add_swing(const model *m, const model_state *s, int vertex, const double v[],
                      const double a[], frame_rates *out)
{
    const int c = model_vertex(m, vertex)->coordinate[SCENE_RX];
    inertia_swing by;
    inertia_swing_of(m, s, vertex, v, a, &by);
    for (int i = 0; i < 3 && by.led; i++) {
        out->v[i] += by.moved[i] * by.rate;
        out->a[i] += by.inward[i] * by.rate * by.rate;
        out->a[i] += c != NONE && a != NULL ? by.moved[i] * a[c] : 0;
    }
}

void forms_rates(const model *m, const model_state *s, int vertex, const double v[],
                 const double a[], frame_rates *out)
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    memset(out, 0, sizeof *out);
    rotation_matrix(&s->q[4 * vertex], out->R);
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[i];
        out->v[i] = c != NONE ? v[c] : 0;
        out->a[i] = c != NONE && a != NULL ? a[c] : 0;
    }
    kinematics_to_fixed(frame, out->v);
    kinematics_to_fixed(frame, out->a);
    add_swing(m, s, vertex, v, a, out);
    if (frame->angles > 0) {
        sequence_rates(m, s, vertex, v, a, out);
        return;
    }
    double w[3] = {0, 0, 0}, wd[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[SCENE_RX + i];
        w[i] = c != NONE ? v[c] : 0;
        wd[i] = c != NONE && a != NULL ? a[c] : 0;
    }
    mat3_mul_vec(out->R, w, out->w);
    mat3_mul_vec(out->R, wd, out->wd);
}

void forms_add_force(const model *m, const model_state *s, int vertex, const double F[6],
                     double out[])
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, own[3] = {F[0], F[1], F[2]}, moved[3];
    if (frame->angles > 0)
        kinematics_axes(m, s, vertex, b);
    kinematics_to_own(frame, own);
    if (frame->led)
        kinematics_arm(m, s, vertex, moved);
    if (frame->led && frame->coordinate[SCENE_RX] != NONE)
        out[frame->coordinate[SCENE_RX]] += vec3_dot(moved, F);
    for (int c = 0; c < 3; c++)
        if (frame->coordinate[c] != NONE)
            out[frame->coordinate[c]] += own[c];
    for (int k = 0; k < 3; k++)
        if (frame->coordinate[SCENE_RX + k] != NONE)
            out[frame->coordinate[SCENE_RX + k]] += vec3_dot(b[k], F + 3);
}

void inertia_rates(const model *m, const model_state *s, int vertex, const double v[],
                   const double a[], frame_rates *out)
{
    if (model_is_released(m, vertex))
        released_rates(m, s, vertex, v, a, out);
    else
        forms_rates(m, s, vertex, v, a, out);
}

void vertex_rates(const model *m, const model_state *s, int vertex, const double v[],
                  const double a[], frame_rates *out)
{
    const int body = model_body(m, vertex),
              by_itself = vertex == body || model_is_released(m, vertex);
    double rho[3], moved[3], twice[3];
    inertia_rates(m, s, by_itself ? vertex : body, v, a, out);
    if (by_itself)
        return;
    kinematics_offset(m, s, vertex, rho);
    vec3_cross(out->w, rho, moved);
    vec3_cross(out->w, moved, twice);
    for (int i = 0; i < 3; i++) {
        out->v[i] += moved[i];
        out->a[i] += twice[i];
    }
    vec3_cross(out->wd, rho, moved);
    for (int i = 0; i < 3; i++)
        out->a[i] += moved[i];
}
