#include "harness/model/model_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

const char turns_lost[] = "after a full turn about a changing axis the rotation vector has no "
                          "defined direction; use smaller steps, or request 'orientation'";

static int reads_turn(const scene_quantity *q)
{
    return q->what.kind == SCENE_RELATIVE && scene_relative_of(q)->component >= SCENE_RX;
}

static int first_between(const model *m)
{
    return m->scene->nodes + m->mesh.springs;
}

static int find_between(const model *m, int from, int node)
{
    for (int i = first_between(m); i < m->mesh.turns; i++)
        if (m->turn[i].from == from && m->turn[i].node == node)
            return i;
    return NONE;
}

status turns_build(model *m, fault *f)
{
    const scene *s = m->scene;
    m->turn = malloc(((size_t)first_between(m) + (size_t)s->quantities + 1) * sizeof *m->turn);
    if (m->turn == NULL)
        return fault_memory(f, "rotations");
    m->mesh.turns = 0;
    for (int i = 0; i < s->nodes; i++)
        m->turn[m->mesh.turns++] = (mesh_turn){NONE, i};
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_element *el = &m->mesh.discrete[i].el;
        m->turn[m->mesh.turns++] =
            (mesh_turn){el->nodes == 1 ? NONE : el->vertex[0], el->vertex[el->nodes - 1]};
    }
    for (int i = 0; i < s->quantities; i++) {
        if (!reads_turn(&s->quantity[i]))
            continue;
        const scene_relative *r = scene_relative_of(&s->quantity[i]);
        if (find_between(m, r->from, r->node) == NONE)
            m->turn[m->mesh.turns++] = (mesh_turn){r->from, r->node};
    }
    return STATUS_OK;
}

/* Returns 1 if a rotation vector keeps the direction of `before`. more: the part of the rotation
 * beyond full revolutions. */
static int keeps_direction(const double more[3], const double before[3], double length)
{
    const double near = 1e-3, round_off = 1e-8;
    double aside[3];
    vec3_cross(before, more, aside);
    return vec3_norm(more) < near && vec3_norm(aside) < round_off * length;
}

/* Returns the rotation vector [rad] closest to `before` among all vectors of q and of -q. */
static void turns_continue(const double q[4], const double before[3], double out[3])
{
    const double sine = vec3_norm(q + 1), length = vec3_norm(before);
    double along[3] = {0};
    rotation_log(q, out);
    if (q[0] > 0 && length < PI / 2)
        return;
    if (length > PI && keeps_direction(out, before, length)) {
        const int odd = q[0] < 0;
        const double turns = 2 * round((length / (2 * PI) - odd) / 2) + odd;
        for (int i = 0; i < 3; i++)
            out[i] += 2 * PI * turns * before[i] / length;
        return;
    }
    if (sine == 0)
        return;
    const double angle = 2 * atan2(sine, q[0]);
    for (int i = 0; i < 3; i++)
        along[i] = q[i + 1] / sine;
    const double turns = 2 * round((vec3_dot(before, along) - angle) / (4 * PI)) + (q[0] < 0);
    if (turns != 0)
        for (int i = 0; i < 3; i++)
            out[i] += 2 * PI * turns * along[i];
}

static void between_frames(const model_state *s, const mesh_turn *t, double q[4])
{
    double back[4];
    if (t->from == NONE) {
        memcpy(q, &s->q[4 * t->node], 4 * sizeof *q);
        return;
    }
    rotation_conjugate(&s->q[4 * t->from], back);
    rotation_compose(back, &s->q[4 * t->node], q);
}

/* Sets the rotation vector of a node whose rotation is a sequence of angles of which only one is
 * not zero. This angle may change by any amount in a step. Returns 0 for other nodes. */
static int by_angle(const model *m, const model_state *s, int node, double out[3])
{
    const mesh_vertex *v = &m->mesh.vertex[node];
    int turned = NONE;
    for (int k = 0; k < v->angles; k++)
        if (s->angle[3 * node + k] != 0) {
            if (turned != NONE)
                return 0;
            turned = k;
        }
    if (turned == NONE)
        return 0;
    for (int i = 0; i < 3; i++)
        out[i] = v->axis[turned][i] * s->angle[3 * node + turned];
    return 1;
}

void turns_follow(const model *m, model_state *s)
{
    const int nodes = m->scene->nodes;
    for (int i = 0; i < m->mesh.turns; i++) {
        double q[4], *turn = &s->turn[3 * i];
        const double before[3] = {turn[0], turn[1], turn[2]};
        if (i < nodes && (m->mesh.vertex[i].body != i || by_angle(m, s, i, turn)))
            continue;
        between_frames(s, &m->turn[i], q);
        turns_continue(q, before, turn);
    }
    for (int i = 0; i < nodes; i++)
        if (m->mesh.vertex[i].body != i)
            memcpy(&s->turn[3 * i], &s->turn[3 * m->mesh.vertex[i].body], 3 * sizeof *s->turn);
}

const double *turns_of_node(const model_state *s, int node)
{
    return &s->turn[3 * node];
}

const double *turns_of_spring(const model *m, const model_state *s, int spring)
{
    return &s->turn[3 * (m->scene->nodes + spring)];
}

const double *turns_between(const model *m, const model_state *s, int from, int node)
{
    const int i = find_between(m, from, node);
    return i == NONE ? NULL : &s->turn[3 * i];
}

int turns_between_count(const model *m)
{
    return m->mesh.turns - first_between(m);
}

void turns_put_between(const model *m, const model_state *s, double out[])
{
    for (int i = first_between(m); i < m->mesh.turns; i++, out += 5) {
        out[0] = m->turn[i].from;
        out[1] = m->turn[i].node;
        memcpy(out + 2, &s->turn[3 * i], 3 * sizeof *out);
    }
}

static void begin_between(const model *m, model_state *s, int i)
{
    const mesh_turn *t = &m->turn[i];
    double q[4], before[3];
    for (int k = 0; k < 3; k++)
        before[k] = s->turn[3 * t->node + k] - s->turn[3 * t->from + k];
    between_frames(s, t, q);
    turns_continue(q, before, &s->turn[3 * i]);
}

void turns_take_between(const model *m, int count, const double in[], model_state *s)
{
    for (int i = first_between(m); i < m->mesh.turns; i++)
        begin_between(m, s, i);
    for (int k = 0; k < count; k++, in += 5) {
        const int i = find_between(m, (int)in[0], (int)in[1]);
        if (i != NONE)
            memcpy(&s->turn[3 * i], in + 2, 3 * sizeof *in);
    }
}

int turns_full(double size, double near)
{
    return size > PI && fabs(remainder(size, 2 * PI)) < near;
}

int turns_swung(const double from[3], const double to[3])
{
    const double a = vec3_norm(from), b = vec3_norm(to);
    const double most = turns_full(b, 1e-6) ? 0.9999 : 0.5; /* smallest cosine of their angle */
    return !(fmax(a, b) < PI || fmin(a, b) < 1 || vec3_dot(from, to) > most * a * b);
}

void turns_lose(const model *m, const model_state *from, model_state *s)
{
    for (int i = 0; i < m->mesh.turns; i++)
        if (turns_swung(&from->turn[3 * i], &s->turn[3 * i]))
            for (int k = 0; k < 3; k++)
                s->turn[3 * i + k] = NAN;
}

/* Increments in the axes of p: delta = R_p^T (dr_q - dr_p), alpha = R_p^T dphi_p, beta = R_p^T
 * dphi_q, w = R_p^T (r_q - r_p). Translations: exp(-alpha~) (w + delta). Theta = R_p^T R_q has the
 * rotation vector theta, and becomes exp(-alpha~) exp(beta~) Theta. To second order, this is
 * exp(gamma~) Theta with gamma = beta - alpha - alpha x beta/2. log(exp(gamma~) Theta) has the
 * first derivative B = 1 - theta~/2 + c theta~^2, where c(x) = (1 - theta/2 cot(theta/2))/x and x =
 * theta^2, and the second derivative (dB[B gamma]) gamma. */

enum { N = NODE_COORDINATES, SIX = SPRING_STRAINS };

void spring_law(const scene_spring *p, const double e[6], double sigma[6], double S[36])
{
    dense_mul_vec(SIX, SIX, p->stiffness, e, sigma);
    if (S != NULL)
        memcpy(S, p->stiffness, SIX * SIX * sizeof *S);
    for (int k = 0; k < SIX; k++) {
        double slope;
        sigma[k] += scene_table_at(&p->table[k], e[k], &slope);
        if (S != NULL)
            S[7 * k] += slope;
    }
}

double spring_energy(const scene_spring *p, const double e[6])
{
    double sum = dense_quadratic(SIX, p->stiffness, e) / 2;
    for (int k = 0; k < SIX; k++)
        sum += scene_table_work(&p->table[k], 0, e[k]);
    return sum;
}

void spring_mean(const scene_spring *p, const double from[6], const double e[6], double sigma[6],
                 double S[36])
{
    double middle[SIX];
    for (int k = 0; k < SIX; k++)
        middle[k] = (from[k] + e[k]) / 2;
    dense_mul_vec(SIX, SIX, p->stiffness, middle, sigma);
    for (int k = 0; k < SIX * SIX; k++)
        S[k] = p->stiffness[k] / 2;
    for (int k = 0; k < SIX; k++) {
        const scene_table *t = &p->table[k];
        const double d = e[k] - from[k];
        double before, behind;
        const double first = scene_table_at(t, from[k], &before),
                     last = scene_table_at(t, e[k], &behind);
        double mean = (first + last) / 2, slope = behind / 2;
        if (t->at.stations > 2 && d != 0) {
            mean = scene_table_work(t, from[k], e[k]) / d;
            slope = before == behind ? slope : (last - mean) / d;
        }
        sigma[k] += mean;
        S[7 * k] += slope;
    }
}

void spring_at_rest(const scene_spring *p, double S[36])
{
    static const double none[SIX];
    double sigma[SIX];
    spring_law(p, none, sigma, S);
}

static void cross_matrix(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

/* Computes c and dc/dx. If the closed form would lose digits by cancellation, uses the sums of
 * |B_2k| x^(k-1)/(2k)!, where B_2k are the Bernoulli numbers. */
static void coefficient(double x, double *c, double *slope)
{
    static const double series[] = {1.0 / 12,          1.0 / 720,
                                    1.0 / 30240,       1.0 / 1209600,
                                    1.0 / 47900160,    691.0 / 1307674368000,
                                    1.0 / 74724249600, 3617.0 / 10670622842880000};
    enum { TERMS = sizeof series / sizeof series[0] };
    *c = *slope = 0;
    if (x < 0.5) {
        for (int k = TERMS - 1; k >= 0; k--) {
            *slope = *slope * x + *c;
            *c = *c * x + series[k];
        }
        return;
    }
    const double most = 2000, half = sqrt(x) / 2;
    const double cot = fmax(-most, fmin(most, cos(half) / sin(half)));
    const double g = half * cot, g_x = (cot - half * (1 + cot * cot)) / (8 * half);
    *c = (1 - g) / x;
    *slope = (-g_x - *c) / x;
}

static void rotation_part(const double R[9], const double near[3], const double s[3],
                          double theta[3], double B[9], double second[9])
{
    double q[4], T[9], TT[9], c, slope;
    rotation_from_matrix(R, q);
    if (near != NULL) {
        double there[4];
        rotation_exp(near, there);
        if (q[0] * there[0] + vec3_dot(q + 1, there + 1) < 0)
            for (int i = 0; i < 4; i++)
                q[i] = -q[i];
        turns_continue(q, near, theta);
    } else {
        rotation_log(q, theta);
    }
    cross_matrix(theta, T);
    mat3_mul(T, T, TT);
    coefficient(vec3_dot(theta, theta), &c, &slope);
    for (int i = 0; i < 9; i++)
        B[i] = (i % 4 == 0) - T[i] / 2 + c * TT[i];
    if (s == NULL)
        return;
    double S[9], ST[9], st[3], X[9], TTs[3], W[9], BW[9];
    cross_matrix(s, S);
    mat3_mul(S, T, ST);
    vec3_cross(s, theta, st);
    cross_matrix(st, X);
    mat3_mul_vec(TT, s, TTs);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            W[3 * i + j] = S[3 * i + j] / 2 - c * (ST[3 * i + j] + X[3 * i + j]) +
                           2 * slope * theta[i] * TTs[j];
    mat3_transpose_mul(B, W, BW);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            second[3 * i + j] = (BW[3 * i + j] + BW[3 * j + i]) / 2;
}

/* Adds sign P X P^T to A[n x n] at (row, column). X[3 x 3] is given in the axes P. */
static void add_block(int n, int row, int column, double sign, const double P[9], const double X[9],
                      double A[])
{
    double half[9];
    mat3_mul(P, X, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[n * (row + i) + column + j] += sign * vec3_dot(&half[3 * i], &P[3 * j]);
}

static void add_columns(int n, int row, int column, double sign, const double P[9],
                        const double X[9], double J[])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[n * (row + i) + column + j] += sign * vec3_dot(&X[3 * i], &P[3 * j]);
}

static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void first_derivatives(int nodes, const double P[9], const double w[3], const double B[9],
                              double J[])
{
    const int n = N * nodes, q = n - N;
    double W[9];
    memset(J, 0, (size_t)(SIX * n) * sizeof *J);
    add_columns(n, 0, q, 1, P, one, J);
    add_columns(n, 3, q + 3, 1, P, B, J);
    if (nodes == 1)
        return;
    cross_matrix(w, W);
    add_columns(n, 0, 0, -1, P, one, J);
    add_columns(n, 0, 3, 1, P, W, J);
    add_columns(n, 3, 3, -1, P, B, J);
}

static void second_derivatives(int nodes, const double P[9], const double w[3], const double B[9],
                               const double s[6], const double second[9], double H[])
{
    const int n = N * nodes, q = n - N;
    double S[9], back[9], D[9], t[3], half[9], back_half[9];
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    add_block(n, q + 3, q + 3, 1, P, second, H);
    if (nodes == 1)
        return;
    cross_matrix(s, S);
    mat3_transpose_mul_vec(B, s + 3, t);
    cross_matrix(t, half);
    const double dot = vec3_dot(s, w);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            D[3 * i + j] = (s[i] * w[j] + w[i] * s[j]) / 2 - (i == j ? dot : 0);
            half[3 * i + j] /= 2;
        }
    for (int i = 0; i < 9; i++) {
        back[i] = -S[i];
        back_half[i] = -half[i];
    }
    add_block(n, 3, 3, 1, P, D, H);
    add_block(n, 3, q, 1, P, S, H);
    add_block(n, q, 3, 1, P, back, H);
    add_block(n, 3, 0, -1, P, S, H);
    add_block(n, 0, 3, -1, P, back, H);
    add_block(n, 3, 3, 1, P, second, H);
    add_block(n, 3, q + 3, -1, P, second, H);
    add_block(n, q + 3, 3, -1, P, second, H);
    add_block(n, 3, q + 3, 1, P, half, H);
    add_block(n, q + 3, 3, 1, P, back_half, H);
}

void spring_strain(int nodes, const node_state x[], const double near[3], strain_output *out)
{
    const node_state *q = &x[nodes - 1];
    double P[9], relative[9], apart[3], moved[3], w[3], theta[3], B[9], second[9];
    memcpy(P, nodes == 1 ? one : x[0].R, sizeof P);
    mat3_transpose_mul(P, q->R, relative);
    for (int i = 0; i < 3; i++) {
        moved[i] = q->u[i] - (nodes == 1 ? 0 : x[0].u[i]);
        apart[i] = nodes == 1 ? 0 : (q->r[i] - q->u[i]) - (x[0].r[i] - x[0].u[i]);
    }
    rotation_part(relative, near, out->s != NULL ? out->s + 3 : NULL, theta, B, second);
    double turned[3], carried[3];
    mat3_transpose_mul_vec(P, apart, turned);
    mat3_transpose_mul_vec(P, moved, carried);
    for (int i = 0; i < 3; i++)
        w[i] = turned[i] + carried[i];
    if (out->e != NULL)
        for (int i = 0; i < 3; i++) {
            out->e[i] = carried[i] + (turned[i] - apart[i]);
            out->e[3 + i] = theta[i];
        }
    if (out->J != NULL)
        first_derivatives(nodes, P, w, B, out->J);
    if (out->H != NULL && out->s != NULL)
        second_derivatives(nodes, P, w, B, out->s, second, out->H);
}
