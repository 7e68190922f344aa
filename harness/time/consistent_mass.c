#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

enum { MOST = ELEMENT_MAX_COORDINATES };

typedef struct moving_element {
    node_state x[ELEMENT_MAX_NODES];
    double rate[MOST], acceleration[MOST];
} moving_element;

static void gather(const model *m, const mesh_element *el, const model_state *s, const double v[],
                   const double a[], double damping, moving_element *out)
{
    kinematics_gather(m, s, el, out->x);
    for (int k = 0; k < el->nodes; k++) {
        double *rate = out->rate + NODE_COORDINATES * k,
               *acceleration = out->acceleration + NODE_COORDINATES * k;
        const int warp = el->warp[k] != NONE ? model_warp(m, el->warp[k]) : NONE;
        frame_rates r;
        vertex_rates(m, s, el->vertex[k], v, a, &r);
        memcpy(rate, r.v, sizeof r.v);
        memcpy(rate + 3, r.w, sizeof r.w);
        memcpy(acceleration, r.a, sizeof r.a);
        memcpy(acceleration + 3, r.wd, sizeof r.wd);
        rate[6] = warp != NONE ? v[warp] : 0;
        acceleration[6] = warp != NONE && a != NULL ? a[warp] : 0;
        for (int i = 0; i < NODE_COORDINATES; i++)
            acceleration[i] += damping * rate[i];
    }
}

static void nothing_known(int count, double *A)
{
    for (int i = 0; i < count && A != NULL; i++)
        A[i] = NAN;
}

static void evaluate(const model *m, int element, const node_state x[], inertia_output *out)
{
    const int n = model_own_coordinates(m);
    if (model_type(m)->inertia(model_kind_of(m, element)->data, x, NULL, out) == STATUS_OK)
        return;
    nothing_known(n, out->taken);
    nothing_known(n * n, out->M);
    nothing_known(n * n, out->C);
    nothing_known(n * n, out->K);
}

static void force_of(const model *m, int element, const model_state *s, const double v[],
                     const double a[], double damping, double F[])
{
    moving_element e;
    gather(m, model_element(m, element), s, v, a, damping, &e);
    evaluate(m, element, e.x,
             &(inertia_output){.rate = e.rate, .acceleration = e.acceleration, .taken = F});
}

void consistent_mass_force(const model *m, int element, const model_state *s, const double v[],
                           const double a[], double F[])
{
    force_of(m, element, s, v, a, 0, F);
}

void consistent_mass_subtract(const model *m, const model_state *s, const double v[],
                              const double a[], double damping, double out[])
{
    for (int i = 0; i < model_elements(m); i++) {
        double F[MODEL_MAX_COORDINATES];
        force_of(m, i, s, v, a, damping, F);
        for (int k = 0; k < model_own_coordinates(m); k++)
            F[k] = -F[k];
        eliminate_forces(m, s, model_element(m, i), F);
        assemble_vector(model_element(m, i), F, out);
    }
}

static void add_through(int columns, int at, const double B[], const double Q[9], double A[])
{
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                A[columns * i + at + 3 + j] += B[columns * i + at + k] * Q[3 * k + j];
}

/* Like add_through, for rates in axes of the node: a rotation d changes them by dw = d x w. */
static void add_turning(int columns, int at, const double B[], const double w[3], double A[])
{
    for (int i = 0; i < columns; i++) {
        double turned[3];
        vec3_cross(w, &B[columns * i + at + 3], turned);
        for (int j = 0; j < 3; j++)
            A[columns * i + at + 3 + j] += turned[j];
    }
}

/* out = x~ A */
static void cross_all(const double x[3], const double A[9], double out[9])
{
    for (int j = 0; j < 3; j++) {
        const double column[3] = {A[j], A[3 + j], A[6 + j]};
        double moved[3];
        vec3_cross(x, column, moved);
        for (int i = 0; i < 3; i++)
            out[3 * i + j] = moved[i];
    }
}

/* Transforms the rates of a node at rho from the body that moves it: v = v_b + w x rho, a = a_b +
 * w' x rho + w x (w x rho). */
static void carry(int n, int at, const moving_element *e, const double rho[3], const double M[],
                  double C[], double K[])
{
    const double *w = e->rate + at + 3, *wd = e->acceleration + at + 3;
    const double place[9] = {0,      rho[2], -rho[1], -rho[2], 0,
                             rho[0], rho[1], -rho[0], 0}; /* -rho~ */
    double w_rho[3], velocity[9], turned[9], gained[9], by_w[9];
    vec3_cross(w, rho, w_rho);
    const double apart[9] = {0,        w_rho[2], -w_rho[1], -w_rho[2], 0,
                             w_rho[0], w_rho[1], -w_rho[0], 0}; /* d x (w x rho) */
    cross_all(w, place, velocity);
    cross_all(w, velocity, turned);
    cross_all(wd, place, gained);
    for (int i = 0; i < 9; i++) {
        gained[i] += turned[i];
        by_w[i] = apart[i] + velocity[i];
    }
    add_through(n, at, C, velocity, K);
    add_through(n, at, M, gained, K);
    add_through(n, at, M, by_w, C);
}

static void to_bodies(const model *m, const mesh_element *el, const model_state *s,
                      const moving_element *e, double F[], consistent_mass_parts *p)
{
    const int n = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < el->nodes; k++) {
        const int vertex = el->vertex[k], at = NODE_COORDINATES * k;
        double rho[3];
        if (model_vertex(m, vertex)->body != vertex && vertex < model_first_release(m)) {
            kinematics_offset(m, s, vertex, rho);
            carry(n, at, e, rho, p->acceleration, p->velocity, p->place);
            offset_matrix(n, at, rho, NULL, p->acceleration);
            offset_matrix(n, at, rho, NULL, p->velocity);
            offset_matrix(n, at, rho, F + at, p->place);
        }
        add_turning(n, at, p->velocity, e->rate + at + 3, p->place);
        add_turning(n, at, p->acceleration, e->acceleration + at + 3, p->place);
    }
}

static void set_turns(const model *m, const mesh_element *el, const model_state *s,
                      consistent_mass_parts *p)
{
    for (int k = 0; k < el->nodes; k++)
        inertia_turns(m, s, model_vertex(m, el->vertex[k])->body, p->turn[k], p->rate[k]);
}

static void begin_parts(const model *m, const mesh_element *el, const model_state *s,
                        consistent_mass_parts *out)
{
    out->el = el;
    out->state = s;
    out->columns = el->columns;
    out->wide = 0;
    for (int k = 0; k < el->nodes; k++)
        out->wide |= model_is_released(m, el->vertex[k]) ||
                     model_vertex(m, model_vertex(m, el->vertex[k])->body)->turned ||
                     model_vertex(m, model_vertex(m, el->vertex[k])->body)->led;
}

void consistent_mass_element(const model *m, int element, const model_state *s, const double v[],
                             const double a[], double damping, consistent_mass_parts *out)
{
    const mesh_element *el = model_element(m, element);
    const int all = NODE_COORDINATES * el->nodes;
    moving_element e;
    double F[MOST];
    gather(m, el, s, v, a, damping, &e);
    begin_parts(m, el, s, out);
    evaluate(m, element, e.x,
             &(inertia_output){.M = out->acceleration,
                               .rate = e.rate,
                               .acceleration = e.acceleration,
                               .taken = F,
                               .C = out->velocity,
                               .K = out->place});
    for (int i = 0; i < all; i++)
        e.acceleration[i] -= damping * e.rate[i];
    for (int i = 0; i < all * all && damping != 0; i++)
        out->velocity[i] += damping * out->acceleration[i];
    to_bodies(m, el, s, &e, F, out);
    set_turns(m, el, s, out);
    for (int k = 0; k < el->nodes; k++) {
        memcpy(out->force[k], F + NODE_COORDINATES * k, sizeof out->force[k]);
        inertia_swing_of(m, s, model_vertex(m, el->vertex[k])->body, v, a, &out->swing[k]);
    }
}

static const double spread_one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void swing_column(const model *m, const consistent_mass_parts *p, int node, double plain,
                         double T[])
{
    const int body = model_vertex(m, p->el->vertex[node])->body, at = NODE_COORDINATES * node;
    double moved[3];
    if (!model_vertex(m, body)->led)
        return;
    kinematics_arm(m, p->state, body, moved);
    for (int i = 0; i < 3; i++)
        T[p->columns * (at + i) + at + 3] += plain * moved[i];
}

/* Computes T[7 nodes x columns], the derivative of the motion of the nodes with respect to the
 * coordinates of the element; moves NULL: with respect to spatial increments. */
static void wide_motion(const model *m, const consistent_mass_parts *p,
                        const consistent_mass_motion moves[],
                        double T[MOST * MODEL_MAX_COORDINATES])
{
    const mesh_element *el = p->el;
    memset(T, 0, (size_t)(NODE_COORDINATES * el->nodes * p->columns) * sizeof *T);
    for (int k = 0; k < el->nodes; k++) {
        const int at = NODE_COORDINATES * k;
        const double plain = moves != NULL ? moves[k].plain : 1,
                     *turn = moves != NULL ? moves[k].turn : p->turn[k];
        T[p->columns * (at + 6) + at + 6] = plain;
        if (el->vertex[k] < model_first_release(m)) {
            const mesh_vertex *body = model_vertex(m, model_vertex(m, el->vertex[k])->body);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    const double along = body->turned ? body->along[3 * i + j] : i == j;
                    T[p->columns * (at + i) + at + j] = plain * along;
                    T[p->columns * (at + 3 + i) + at + 3 + j] = turn[3 * i + j];
                }
            swing_column(m, p, k, plain, T);
            continue;
        }
        released_masses of;
        double motion[6 * KINEMATICS_MOST];
        released_columns(m, p->state, el->vertex[k], &of);
        released_motion(&of, plain, moves != NULL ? turn : spread_one,
                        moves != NULL ? moves[k].ball : spread_one, motion);
        for (int c = 0; c < of.count; c++) {
            int to = 0;
            while (to + 1 < p->columns && el->index[to] != of.index[c])
                to++;
            for (int i = 0; i < 6; i++)
                T[p->columns * (at + i) + to] = motion[i * of.count + c];
        }
    }
}

static void wide_times(const model *m, const consistent_mass_parts *p, const double A[],
                       const consistent_mass_motion moves[], double out[])
{
    const int n = NODE_COORDINATES * p->el->nodes;
    double rows[MOST * MODEL_MAX_COORDINATES], motion[MOST * MODEL_MAX_COORDINATES],
        half[MOST * MODEL_MAX_COORDINATES];
    wide_motion(m, p, NULL, rows);
    wide_motion(m, p, moves, motion);
    dense_mul(n, n, p->columns, A, motion, half);
    dense_add_transpose_mul(p->columns, n, p->columns, rows, half, out);
}

void consistent_mass_times(const model *m, const consistent_mass_parts *p, const double A[],
                           const consistent_mass_motion motion[], double out[])
{
    const int columns = p->columns;
    if (p->wide) {
        wide_times(m, p, A, motion, out);
        return;
    }
    for (int i = 0; i < columns; i++)
        for (int at = 0; at < columns; at += NODE_COORDINATES) {
            const consistent_mass_motion *by = &motion[at / NODE_COORDINATES];
            const double *row = &A[columns * i + at];
            double *to = &out[columns * i + at];
            for (int j = 0; j < 3; j++) {
                to[j] += by->plain * row[j];
                for (int k = 0; k < 3; k++)
                    to[3 + j] += row[3 + k] * by->turn[3 * k + j];
            }
            to[6] += by->plain * row[6];
        }
}

void consistent_mass_swing(const model *m, const consistent_mass_parts *p, double rate,
                           double place, double K[])
{
    const int n = NODE_COORDINATES * p->el->nodes;
    double rows[MOST * MODEL_MAX_COORDINATES], column[MOST], out[MODEL_MAX_COORDINATES];
    int known = 0;
    for (int k = 0; k < p->el->nodes; k++) {
        const int at = NODE_COORDINATES * k;
        if (!p->swing[k].led || p->el->vertex[k] >= model_first_release(m))
            continue;
        if (!known++)
            wide_motion(m, p, NULL, rows);
        memset(column, 0, sizeof column);
        memset(out, 0, sizeof out);
        inertia_swing_column(&p->swing[k], n, at, p->acceleration, p->velocity, rate, place,
                             column);
        dense_add_transpose_mul(p->columns, n, 1, rows, column, out);
        for (int i = 0; i < p->columns; i++)
            K[p->columns * i + at + 3] += out[i];
        K[(p->columns + 1) * (at + 3)] += place * vec3_dot(p->swing[k].inward, p->force[k]);
    }
}

void consistent_mass_rows(const consistent_mass_parts *p, double K[])
{
    const int n = p->columns;
    for (int at = 3; at < n && !p->wide; at += NODE_COORDINATES)
        for (int j = 0; j < n; j++) {
            const double column[3] = {K[n * at + j], K[n * (at + 1) + j], K[n * (at + 2) + j]};
            double turned[3];
            mat3_transpose_mul_vec(p->turn[at / NODE_COORDINATES], column, turned);
            for (int i = 0; i < 3; i++)
                K[n * (at + i) + j] = turned[i];
        }
}

static const double at_rest[MOST];

void consistent_mass_masses(const model *m, int element, const model_state *s,
                            consistent_mass_parts *out)
{
    const mesh_element *el = model_element(m, element);
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, s, el, x);
    begin_parts(m, el, s, out);
    evaluate(m, element, x, &(inertia_output){.M = out->acceleration, .rate = at_rest});
    for (int k = 0; k < el->nodes; k++)
        if (model_vertex(m, el->vertex[k])->body != el->vertex[k] &&
            el->vertex[k] < model_first_release(m)) {
            double rho[3];
            kinematics_offset(m, s, el->vertex[k], rho);
            offset_matrix(model_own_coordinates(m), NODE_COORDINATES * k, rho, NULL,
                          out->acceleration);
        }
    set_turns(m, el, s, out);
}

void consistent_mass_place(const model *m, const consistent_mass_parts *p,
                           consistent_mass_motion place[])
{
    for (int k = 0; k < p->el->nodes; k++) {
        const int plain = p->el->vertex[k] < model_first_release(m);
        place[k].plain = 1;
        memcpy(place[k].turn, plain ? p->turn[k] : spread_one, sizeof place[k].turn);
        memcpy(place[k].ball, spread_one, sizeof place[k].ball);
    }
}

static void motions_of(const model *m, const mesh_element *el, const inertia_relation *with,
                       const consistent_mass_parts *p, consistent_mass_motion rates[])
{
    for (int k = 0; k < el->nodes; k++) {
        double N[9];
        const int body = model_vertex(m, el->vertex[k])->body;
        rates[k].plain = 1;
        if (el->vertex[k] >= model_first_release(m)) {
            inertia_turn(m, body, p->state, with->inc, rates[k].turn);
            inertia_turn(m, el->vertex[k], p->state, with->inc, rates[k].ball);
            continue;
        }
        inertia_chart(m, body, with->inc, p->rate[k], N);
        mat3_mul(p->rate[k], N, rates[k].turn);
    }
}

void consistent_mass_add_tangent(const equations *eq, const model_state *s, const double v[],
                                 const double a[], double damping, const inertia_relation *with,
                                 sparse *S)
{
    const model *m = eq->m;
    const mesh_pattern *pattern = assemble_of(eq->run->patterns, S);
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        consistent_mass_parts p;
        consistent_mass_motion place[ELEMENT_MAX_NODES], rates[ELEMENT_MAX_NODES];
        double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        memset(K, 0, (size_t)(el->columns * el->columns) * sizeof *K);
        consistent_mass_element(m, i, s, v, a, damping, &p);
        consistent_mass_swing(m, &p, with->g, 1, K);
        const int all = model_own_coordinates(m) * model_own_coordinates(m);
        for (int k = 0; k < all; k++)
            p.acceleration[k] = with->b * p.acceleration[k] + with->g * p.velocity[k];
        consistent_mass_place(m, &p, place);
        motions_of(m, el, with, &p, rates);
        consistent_mass_times(m, &p, p.acceleration, rates, K);
        consistent_mass_times(m, &p, p.place, place, K);
        consistent_mass_rows(&p, K);
        assemble_matrix(pattern, i, K, S);
    }
}

static void move_node(node_state *x, int coordinate, double h)
{
    double turn[3] = {0, 0, 0}, q[4], R[9], turned[9];
    if (coordinate < 3) {
        x->r[coordinate] += h;
        x->u[coordinate] += h;
    } else if (coordinate < 6) {
        turn[coordinate - 3] = h;
        rotation_exp(turn, q);
        rotation_matrix(q, R);
        mat3_mul(R, x->R, turned);
        memcpy(x->R, turned, sizeof turned);
    } else
        x->a += h;
}

/* Computes D[n x n], the derivative of the forces at fixed rates in fixed axes, minus the
 * derivative that the element computes. It uses finite differences of sixth order in the
 * exponential chart. */
static void omitted(const model *m, int element, moving_element *e, double D[])
{
    static const double weight[] = {0.75, -0.15, 1 / 60.0};
    const int n = model_own_coordinates(m);
    const double length = model_kind_of(m, element)->length;
    double F[MOST], own[MOST * MOST];
    evaluate(
        m, element, e->x,
        &(inertia_output){.rate = e->rate, .acceleration = e->acceleration, .taken = F, .K = own});
    for (int i = 0; i < n * n; i++)
        D[i] = -own[i];
    for (int at = 3; at < n; at += NODE_COORDINATES) {
        const double M[3] = {F[at] / 2, F[at + 1] / 2, F[at + 2] / 2},
                     half[9] = {0, -M[2], M[1], M[2], 0, -M[0], -M[1], M[0], 0};
        for (int i = 0; i < 9; i++)
            D[n * (at + i / 3) + at + i % 3] += half[i];
    }
    for (int c = 0; c < n; c++) {
        node_state *moved = &e->x[c / NODE_COORDINATES];
        const node_state before = *moved;
        const int k = c % NODE_COORDINATES;
        const double h = 0.02 * (k < 3 ? length : k < 6 ? 1 : 1 / length);
        for (int step = -3; step <= 3; step++) {
            if (step == 0)
                continue;
            move_node(moved, k, step * h);
            evaluate(
                m, element, e->x,
                &(inertia_output){.rate = e->rate, .acceleration = e->acceleration, .taken = F});
            *moved = before;
            const double by = weight[abs(step) - 1] / (step > 0 ? h : -h);
            for (int i = 0; i < n; i++)
                D[n * i + c] += by * F[i];
        }
    }
}

void consistent_mass_add_omitted(const equations *eq, const model_state *s, const double v[],
                                 const double a[], double damping, sparse *S)
{
    const model *m = eq->m;
    const mesh_pattern *pattern = assemble_of(eq->run->patterns, S);
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        moving_element e;
        consistent_mass_parts p;
        consistent_mass_motion place[ELEMENT_MAX_NODES];
        double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        memset(K, 0, (size_t)(el->columns * el->columns) * sizeof *K);
        gather(m, el, s, v, a, damping, &e);
        begin_parts(m, el, s, &p);
        omitted(m, i, &e, p.place);
        for (int k = 0; k < el->nodes; k++)
            if (model_vertex(m, el->vertex[k])->body != el->vertex[k] &&
                el->vertex[k] < model_first_release(m)) {
                double rho[3];
                kinematics_offset(m, s, el->vertex[k], rho);
                offset_matrix(model_own_coordinates(m), NODE_COORDINATES * k, rho, NULL, p.place);
            }
        set_turns(m, el, s, &p);
        consistent_mass_place(m, &p, place);
        consistent_mass_times(m, &p, p.place, place, K);
        consistent_mass_rows(&p, K);
        assemble_matrix(pattern, i, K, S);
    }
}

void consistent_mass_add_balance(const model *m, const model_state *s, const double v[],
                                 double *kinetic, double momentum[3], double angular[3])
{
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        moving_element e;
        double M[MOST * MOST], p[MOST];
        gather(m, el, s, v, NULL, 0, &e);
        evaluate(m, i, e.x, &(inertia_output){.M = M, .rate = e.rate});
        dense_mul_vec(model_own_coordinates(m), model_own_coordinates(m), M, e.rate, p);
        *kinetic += dense_dot(model_own_coordinates(m), e.rate, p) / 2;
        for (int k = 0; k < el->nodes; k++) {
            const double *own = p + NODE_COORDINATES * k;
            double moment[3];
            vec3_cross(e.x[k].r, own, moment);
            for (int c = 0; c < 3; c++) {
                momentum[c] += own[c];
                angular[c] += moment[c] + own[3 + c];
            }
        }
    }
}

static void unit_matrix(double A[9])
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(A, one, sizeof one);
}

void inertia_turn(const model *m, int vertex, const model_state *s, const double inc[], double E[9])
{
    double R[9], N[9];
    rotation_matrix(&s->q[4 * vertex], R);
    inertia_chart(m, vertex, inc, R, N);
    mat3_mul(R, N, E);
}

void inertia_chart(const model *m, int vertex, const double inc[], const double R[9], double N[9])
{
    double at[3], inverse[9];
    unit_matrix(N);
    if (forms_of(m, vertex) != FORM_BODY)
        return;
    for (int i = 0; i < 3; i++)
        at[i] = inc[model_vertex(m, vertex)->coordinate[SCENE_RX + i]];
    rotation_rates_inverse(at, inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            N[3 * i + j] = vec3_dot(&inverse[3 * i], &R[3 * j]);
}

void inertia_turns(const model *m, const model_state *s, int vertex, double turn[9], double rate[9])
{
    const mesh_vertex *frame = model_vertex(m, vertex);
    double b[3][3];
    unit_matrix(turn);
    rotation_matrix(&s->q[4 * vertex], rate);
    if (frame->angles == 0)
        return;
    kinematics_axes(m, s, vertex, b);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turn[3 * i + k] = rate[3 * i + k] = k < frame->angles ? b[k][i] : 0;
}
