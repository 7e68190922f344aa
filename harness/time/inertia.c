#include "harness/time/time_impl.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

typedef struct spatial {
    double c[3], J[9];
} spatial;

static void turn_tensor(const double R[9], const double J0[9], double J[9])
{
    double half[9];
    mat3_mul(R, J0, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[3 * i + j] = vec3_dot(&half[3 * i], &R[3 * j]);
}

static void at_frame(const frame_mass *one, const double R[9], spatial *out)
{
    mat3_mul_vec(R, one->moment, out->c);
    turn_tensor(R, one->inertia, out->J);
}

void inertia_force_at(const frame_mass *one, const frame_rates *r, double F[6])
{
    spatial s;
    double alpha_c[3], w_c[3], w_w_c[3], c_a[3], J_alpha[3], J_w[3], w_J_w[3];
    at_frame(one, r->R, &s);
    vec3_cross(r->wd, s.c, alpha_c);
    vec3_cross(r->w, s.c, w_c);
    vec3_cross(r->w, w_c, w_w_c);
    vec3_cross(s.c, r->a, c_a);
    mat3_mul_vec(s.J, r->wd, J_alpha);
    mat3_mul_vec(s.J, r->w, J_w);
    vec3_cross(r->w, J_w, w_J_w);
    for (int i = 0; i < 3; i++) {
        F[i] = one->mass * r->a[i] + alpha_c[i] + w_w_c[i];
        F[3 + i] = c_a[i] + J_alpha[i] + w_J_w[i];
    }
}

/* Computes the rates of a frame. The acceleration includes mass-proportional damping: M (a +
 * damping v). */
static void damped_rates(const model *m, const frame_masses *all, int index, const model_state *s,
                         const double v[], const double a[], frame_rates *r)
{
    inertia_rates(m, s, all->mass[index].frame, v, a, r);
    for (int i = 0; i < 3; i++) {
        r->a[i] += all->damping * r->v[i];
        r->wd[i] += all->damping * r->w[i];
    }
}

void inertia_force(const model *m, const frame_mass *one, const model_state *s, const double v[],
                   const double a[], double F[6])
{
    frame_rates r;
    inertia_rates(m, s, one->frame, v, a, &r);
    inertia_force_at(one, &r, F);
}

void inertia_subtract(const model *m, const frame_masses *all, const model_state *s,
                      const double v[], const double a[], double out[])
{
    if (all->spread)
        consistent_mass_subtract(m, s, v, a, all->damping, out);
    for (int k = 0; k < all->masses; k++) {
        double F[6];
        frame_rates r;
        damped_rates(m, all, k, s, v, a, &r);
        inertia_force_at(&all->mass[k], &r, F);
        for (int i = 0; i < 6; i++)
            F[i] = -F[i];
        if (all->mass[k].frame >= model_first_release(m))
            released_add_force(m, s, all->mass[k].frame, F, out);
        else
            forms_add_force(m, s, all->mass[k].frame, F, out);
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        out[c] -= all->warping[c] * ((a != NULL ? a[c] : 0) + all->damping * v[c]);
    }
}

static void skew(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

/* Computes three derivatives [6 x 6] of the force and moment on a frame: with respect to its
 * position and rotation, to its velocity and to its acceleration. The first uses spatial increments
 * in the exponential chart, at fixed rates in the frame's axes. */
static void parts_of(const frame_mass *one, const frame_rates *r, const double F[6],
                     inertia_parts *out)
{
    spatial s;
    double C[9], W[9], Jw[3], H[9], WJ[9], w_c[3], WC[9], CW[9], AC[9], A[9], c_a[3], rest[3],
        force[3], R[9], T[9], M[9];
    at_frame(one, r->R, &s);
    memset(out, 0, sizeof *out);
    skew(s.c, C);
    skew(r->w, W);
    skew(r->a, A);
    mat3_mul_vec(s.J, r->w, Jw);
    skew(Jw, H);
    mat3_mul(W, s.J, WJ);
    vec3_cross(r->w, s.c, w_c);
    skew(w_c, WC);
    mat3_mul(W, C, CW);
    mat3_mul(A, C, AC); /* derivative of c x a, where a does not rotate: d(c x a) = a~ c~ dphi */
    vec3_cross(s.c, r->a, c_a);
    for (int i = 0; i < 3; i++) {
        rest[i] = F[3 + i] - c_a[i];
        force[i] = F[i] - one->mass * r->a[i];
    }
    skew(rest, R);
    skew(force, T);
    skew(F + 3, M);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int k = 3 * i + j, turn = 6 * i + 3 + j, both = 6 * (3 + i) + 3 + j;
            out->acceleration[6 * i + j] = i == j ? one->mass : 0;
            out->acceleration[turn] = -C[k];
            out->acceleration[6 * (3 + i) + j] = C[k];
            out->acceleration[both] = s.J[k];
            out->velocity[turn] = -WC[k] - CW[k];
            out->velocity[both] = WJ[k] - H[k];
            out->place[turn] = -T[k];
            out->place[both] = AC[k] - R[k] + M[k] / 2;
        }
}

static void inertia_identity(double A[9])
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(A, one, sizeof one);
}

void inertia_frame(const model *m, const frame_masses *all, int index, const model_state *s,
                   const double v[], const double a[], inertia_parts *out)
{
    const frame_mass *one = &all->mass[index];
    frame_rates r;
    double F[6];
    damped_rates(m, all, index, s, v, a, &r);
    inertia_force_at(one, &r, F);
    parts_of(one, &r, F, out);
    for (int i = 0; i < 36; i++)
        out->velocity[i] += all->damping * out->acceleration[i];
    inertia_turns(m, s, one->frame, out->turn, out->rate);
    memcpy(out->force, F, sizeof out->force);
    inertia_swing_of(m, s, one->frame, v, a, &out->swing);
}

/* Computes out[6 x 6] = A diag(translation 1, B). */
void inertia_times(const double A[36], const double translation, const double B[9], double out[36])
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += A[6 * i + 3 + k] * B[3 * k + j];
            out[6 * i + j] = translation * A[6 * i + j];
            out[6 * i + 3 + j] = sum;
        }
}

/* K <- diag(1, turn^T) K */
static void rows(const double turn[9], double K[36])
{
    for (int j = 0; j < 6; j++) {
        const double at[3] = {K[18 + j], K[24 + j], K[30 + j]};
        for (int i = 0; i < 3; i++)
            K[6 * (3 + i) + j] = turn[i] * at[0] + turn[3 + i] * at[1] + turn[6 + i] * at[2];
    }
}

void inertia_finish(const model *m, const frame_masses *all, int index, const inertia_parts *p,
                    double rate, double place, double K[36])
{
    double column[6] = {0};
    inertia_swing_column(&p->swing, 6, 0, p->acceleration, p->velocity, rate, place, column);
    for (int i = 0; i < 6 && p->swing.led; i++)
        K[6 * i + 3] += vec3_dot(&K[6 * i], p->swing.moved) + column[i];
    rows(p->turn, K);
    inertia_swing_row(&p->swing, 6, 0, p->force, place, K);
    kinematics_turn_matrix(model_vertex(m, all->mass[index].frame), 6, 0, K);
}

static void released_tangent(const model *m, int vertex, const model_state *s,
                             const inertia_parts *p, const inertia_relation *with, sparse *S)
{
    const int body = model_vertex(m, vertex)->body;
    released_masses of;
    double of_body[9], of_ball[9], one[9], motion[6 * KINEMATICS_MOST], rates[36],
        K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
    released_columns(m, s, vertex, &of);
    inertia_identity(one);
    inertia_turn(m, body, s, with->inc, of_body);
    inertia_turn(m, vertex, s, with->inc, of_ball);
    for (int i = 0; i < 36; i++)
        rates[i] = with->b * p->acceleration[i] + with->g * p->velocity[i];
    released_motion(&of, 1, of_body, of_ball, motion);
    released_project(&of, rates, motion, K);
    released_motion(&of, 1, one, one, motion);
    released_project(&of, p->place, motion, K);
    assemble_add_block(S, of.count, of.index, of.count, of.index, K);
}

void inertia_add_tangent(const equations *eq, const frame_masses *all, const model_state *s,
                         const double v[], const double a[], const inertia_relation *with,
                         sparse *S)
{
    const model *m = eq->m;
    if (all->spread)
        consistent_mass_add_tangent(eq, s, v, a, all->damping, with, S);
    for (int k = 0; k < all->masses; k++) {
        const int vertex = all->mass[k].frame;
        const int *at = model_vertex(m, vertex)->coordinate;
        inertia_parts p;
        double N[9], E[9], rates[36], K[36], more[36];
        inertia_frame(m, all, k, s, v, a, &p);
        if (vertex >= model_first_release(m)) {
            released_tangent(m, vertex, s, &p, with, S);
            continue;
        }
        inertia_chart(m, vertex, with->inc, p.rate, N);
        mat3_mul(p.rate, N, E);
        for (int i = 0; i < 36; i++)
            rates[i] = with->b * p.acceleration[i] + with->g * p.velocity[i];
        inertia_times(rates, 1, E, K);
        inertia_times(p.place, 1, p.turn, more);
        for (int i = 0; i < 36; i++)
            K[i] += more[i];
        inertia_finish(m, all, k, &p, with->g, 1, K);
        assemble_add_block(S, 6, at, 6, at, K);
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        assemble_subtract(S, c, c, -(with->b + with->g * all->damping) * all->warping[c]);
    }
}

void inertia_of(const model *m, const frame_masses *all, const model_state *s, const double v[],
                const double ends[], inertia_balance *out)
{
    memset(out, 0, sizeof *out);
    if (all->spread)
        consistent_mass_add_balance(m, s, v, &out->kinetic, out->momentum, out->angular);
    for (int k = 0; k < all->masses; k++) {
        const frame_mass *one = &all->mass[k];
        frame_rates r;
        spatial at;
        double w_c[3], p[3], Jw[3], c_v[3], position[3], r_p[3];
        inertia_rates(m, s, one->frame, v, NULL, &r);
        at_frame(one, r.R, &at);
        if (ends != NULL && one->frame >= model_first_release(m))
            released_moving(ends + 6 * (one->frame - model_first_release(m)), one->mass, at.c, &r);
        kinematics_position(m, s, one->frame, position);
        vec3_cross(r.w, at.c, w_c);
        mat3_mul_vec(at.J, r.w, Jw);
        vec3_cross(at.c, r.v, c_v);
        for (int i = 0; i < 3; i++)
            p[i] = one->mass * r.v[i] + w_c[i];
        vec3_cross(position, p, r_p);
        out->kinetic +=
            (one->mass * vec3_dot(r.v, r.v) + vec3_dot(r.w, Jw)) / 2 + vec3_dot(r.v, w_c);
        for (int i = 0; i < 3; i++) {
            out->momentum[i] += p[i];
            out->angular[i] += r_p[i] + Jw[i] + c_v[i];
        }
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        out->kinetic += all->warping[c] * v[c] * v[c] / 2;
    }
}

double inertia_damping_power(const model *m, const frame_masses *all, const model_state *s,
                             const double v[])
{
    inertia_balance moving;
    if (all->damping == 0)
        return 0;
    inertia_of(m, all, s, v, NULL, &moving);
    return 2 * all->damping * moving.kinetic;
}

static status stored(const equations *eq, const model_state *s, double time, double *out, fault *f)
{
    const model *m = eq->m;
    double none[1] = {0};
    *out = model_absolute(m) ? NAN : 0;
    for (int i = 0; i < model_elements(m) && !model_absolute(m); i++) {
        double energy = 0;
        const double *inner =
            model_inner(m) > 0 ? s->inner + (size_t)i * (size_t)model_inner(m) : none;
        const status outcome = model_type(m)->stress(free_strain_data(eq, i, time),
                                                     s->e + (size_t)i * (size_t)model_strains(m),
                                                     inner, &(stress_output){.energy = &energy});
        if (outcome != STATUS_OK)
            return fault_set(f, outcome,
                             "element %d: its state is outside the range that %s can evaluate; use "
                             "smaller steps or more elements",
                             i, model_type(m)->name);
        *out += energy;
    }
    *out += discrete_stored(m, s);
    return STATUS_OK;
}

status balance_of(const equations *eq, const frame_masses *masses, const motion_state *at,
                  double out[SCENE_BALANCES], fault *f)
{
    const model *m = eq->m;
    inertia_balance moving;
    inertia_of(m, masses, at->state, at->v, at->ends_known ? at->ends : NULL, &moving);
    TRY(stored(eq, at->state, at->time, &out[SCENE_STRAIN], f));
    out[SCENE_KINETIC] = moving.kinetic;
    out[SCENE_ENERGY] = out[SCENE_KINETIC] + out[SCENE_STRAIN];
    out[SCENE_WORK] = at->work;
    out[SCENE_DISSIPATED] = at->dissipated;
    out[SCENE_DRIFT] = out[SCENE_ENERGY] + at->dissipated - at->work;
    for (int i = 0; i < 3; i++) {
        out[SCENE_PX + i] = moving.momentum[i];
        out[SCENE_LX + i] = moving.angular[i];
    }
    return STATUS_OK;
}

/* relative rounding error of coordinates that are solutions of equations */
static const double coordinate_rounding = 32 * DBL_EPSILON;

/* Returns the strain energy [J] that rounding errors of its coordinates cause in an element. */
static double rounding_of(const model *m, const mesh_element *el, int index)
{
    enum { E = ELEMENT_MAX_STRAINS };
    const size_t first = (size_t)index * (size_t)model_strains(m);
    const double size = model_length(m),
                 part[NODE_COORDINATES] = {size, size, size, 1, 1, 1, 1 / size};
    double J[E * ELEMENT_MAX_COORDINATES], C[E * E], sum = 0;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), el, x);
    model_type(m)->strain(
        model_kind(m, el->kind)->data, x,
        &(strain_output){.J = J, .history = model_history_of(m, kinematics_rest(m), index)});
    if (model_type(m)->stress(
            model_kind(m, el->kind)->data, kinematics_rest(m)->e + first,
            kinematics_rest(m)->inner + (size_t)index * (size_t)model_inner(m),
            &(stress_output){.C = C, .history = model_history_of(m, kinematics_rest(m), index)}) !=
        STATUS_OK)
        return 0;
    for (int i = 0; i < model_strains(m); i++) {
        double off = 0;
        for (int k = 0; k < model_own_coordinates(m); k++)
            off += fabs(J[i * model_own_coordinates(m) + k]) *
                   (k < NODE_COORDINATES * el->nodes ? part[k % NODE_COORDINATES] : 1) *
                   coordinate_rounding;
        sum += C[i * model_strains(m) + i] * off * off / 2;
    }
    return sum;
}

double balance_rounding(const model *m)
{
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++)
        sum += rounding_of(m, model_element(m, i), i);
    for (int i = model_discretes(m) - model_springs(m); i < model_discretes(m); i++) {
        double S[SPRING_STRAINS * SPRING_STRAINS];
        spring_at_rest(model_discrete(m, i)->spring, S);
        for (int k = 0; k < 6; k++) {
            const double off = coordinate_rounding * (k < 3 ? model_length(m) : 1);
            sum += S[7 * k] * off * off / 2;
        }
    }
    return sum;
}
