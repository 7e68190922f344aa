#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

static void three(const mesh_vertex *v, const double of[], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = of[v->coordinate[SCENE_RX + i]];
}

/* Moves a vertex by inc. Its orientation becomes R_n exp(inc). */
static void apply_vertex(const model *m, const model_state *from, int index, const double inc[],
                         model_state *to)
{
    const mesh_vertex *v = model_vertex(m, index);
    double d[6], q[4];
    for (int c = 0; c < 6; c++)
        d[c] = v->coordinate[c] == NONE ? 0 : inc[v->coordinate[c]];
    kinematics_to_fixed(v, d);
    for (int c = 0; c < 3; c++) {
        to->u[3 * index + c] = from->u[3 * index + c] + d[c];
        to->angle[3 * index + c] = from->angle[3 * index + c] + d[3 + c];
    }
    if (v->angles > 0)
        return;
    rotation_exp(d + 3, q);
    rotation_compose(&from->q[4 * index], q, &to->q[4 * index]);
    rotation_normalise(&to->q[4 * index]);
}

static void turn_ball(const model *m, const model_state *from, int index, const double inc[],
                      model_state *to)
{
    double t[3], q[4];
    three(model_vertex(m, index), inc, t);
    rotation_exp(t, q);
    rotation_compose(&from->q[4 * index], q, &to->q[4 * index]);
    rotation_normalise(&to->q[4 * index]);
}

void increment_apply(const model *m, const model_state *from, const double inc[], double time,
                     model_state *to)
{
    for (int i = 0; i < model_first_release(m); i++)
        if (model_vertex(m, i)->body == i)
            apply_vertex(m, from, i, inc, to);
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int r = i - model_first_release(m);
        memcpy(&to->q[4 * i], &from->q[4 * i], 4 * sizeof *to->q);
        memcpy(&to->angle[3 * i], &from->angle[3 * i], 3 * sizeof *to->angle);
        memcpy(&to->shift[3 * r], &from->shift[3 * r], 3 * sizeof *to->shift);
        release_advance(m, to, i, inc);
        if (release_of(m, i)->turns == 3)
            turn_ball(m, from, i, inc, to);
    }
    for (int i = 0; i < model_warps(m); i++)
        to->warp[i] = from->warp[i] + inc[model_warp(m, i)];
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) != NONE)
            to->driver[d] = from->driver[d] + inc[model_driver_coordinate(m, d)];
    memcpy(to->turn, from->turn, 3 * (size_t)model_turns(m) * sizeof *to->turn);
    kinematics_follow(m, to);
    to->path = time;
}

static void add_turn(const model_state *now, int index, const mesh_vertex *v, const double dx[],
                     double inc[])
{
    double R[9], spatial[3], moved[3], at[3];
    three(v, dx, spatial);
    three(v, inc, at);
    rotation_matrix(&now->q[4 * index], R);
    mat3_transpose_mul_vec(R, spatial, moved);
    rotation_rates_add(at, moved);
    for (int k = 0; k < 3; k++)
        inc[v->coordinate[SCENE_RX + k]] = at[k];
}

static void add_plainly(const model *m, int vertex, int first, int end, const double dx[],
                        double inc[])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    for (int c = first; c < end; c++)
        if (v->coordinate[c] != NONE && v->coordinate[c] < model_unknowns(m) &&
            model_owns(m, vertex, c))
            inc[v->coordinate[c]] += dx[v->coordinate[c]];
}

void increment_add(const model *m, const model_state *now, const double dx[], double inc[])
{
    for (int i = 0; i < model_vertices(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        const mesh_release *r = release_of(m, i);
        if (r == NULL && v->body != i)
            continue;
        add_plainly(m, i, SCENE_UX, SCENE_RX, dx, inc);
        const int whole =
            forms_of(m, i) == FORM_BODY && v->coordinate[SCENE_RX] < model_unknowns(m);
        if (whole && model_owns(m, i, SCENE_RX))
            add_turn(now, i, v, dx, inc);
        else if (!whole)
            add_plainly(m, i, SCENE_RX, SCENE_RZ + 1, dx, inc);
    }
    for (int i = 0; i < model_warps(m); i++)
        inc[model_warp(m, i)] += dx[model_warp(m, i)];
}

status drive_check(const model *m, fault *f)
{
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_scene(m)->driver[d].value == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "the value of motion %s is unknown; a transient analysis requires the "
                             "values of all motions",
                             model_scene(m)->driver[d].name);
    return STATUS_OK;
}

/* Computes the rates of a rotation given by its vector t(time): W = Jr t', W' = Jr t'' + d(Jr
 * t')/dt t'. */
static void drive_vector(const equations *eq, const model_state *from, int index, double time,
                         double inc[], double v[], double a[])
{
    const model *m = eq->m;
    const mesh_vertex *frame = model_vertex(m, index);
    double t[3], rate[3], second[3], Jr[9], D[9], W[3], Wd[3], more[3], q[4], to[4], back[4];
    for (int k = 0; k < 3; k++) {
        double at[3];
        loads_driver_rates(eq, &model_scene(m)->driver[frame->vector_driver[k]], time, at);
        t[k] = at[0];
        rate[k] = at[1];
        second[k] = at[2];
    }
    rotation_rates_jacobian(t, Jr);
    rotation_rates_derivative(t, rate, D);
    mat3_mul_vec(Jr, rate, W);
    mat3_mul_vec(Jr, second, Wd);
    mat3_mul_vec(D, rate, more);
    rotation_exp(t, to);
    rotation_conjugate(&from->q[4 * index], back);
    rotation_compose(back, to, q);
    rotation_log(q, t);
    for (int k = 0; k < 3; k++) {
        const int c = frame->coordinate[SCENE_RX + k];
        if (inc != NULL)
            inc[c] = t[k];
        if (v != NULL)
            v[c] = W[k];
        if (a != NULL)
            a[c] = Wd[k] + more[k];
    }
}

void drive_at(const equations *eq, const model_state *from, double time, double inc[], double v[],
              double a[])
{
    const model *m = eq->m;
    for (int c = model_unknowns(m); c < model_all_coordinates(m); c++) {
        if (inc != NULL)
            inc[c] = 0;
        if (v != NULL)
            v[c] = 0;
        if (a != NULL)
            a[c] = 0;
    }
    for (int d = 0; d < model_scene(m)->drivers; d++) {
        const int c = model_driver_coordinate(m, d);
        double at[3];
        if (c < model_unknowns(m))
            continue;
        loads_driver_rates(eq, &model_scene(m)->driver[d], time, at);
        if (inc != NULL)
            inc[c] = at[0] - from->driver[d];
        if (v != NULL)
            v[c] = at[1];
        if (a != NULL)
            a[c] = at[2];
    }
    for (int i = 0; i < model_scene(m)->nodes; i++)
        if (model_vertex(m, i)->vector_driver[0] != NONE && model_vertex(m, i)->body == i)
            drive_vector(eq, from, i, time, inc, v, a);
}

/* Below this angle [rad], the coefficients are computed by series that are accurate to rounding
 * error. */
static const double small = 0.05;

/* Computes (1 - cos x)/x^2 and (x - sin x)/x^3, and their derivatives divided by x. */
static void coefficients(double x, double *b, double *c, double *db, double *dc)
{
    const double s = x * x;
    if (x < small) {
        *b = 1 / 2.0 - s / 24 * (1 - s / 30 * (1 - s / 56));
        *c = 1 / 6.0 - s / 120 * (1 - s / 42 * (1 - s / 72));
        *db = -1 / 12.0 + s / 180 * (1 - s * 3 / 112 * (1 - s * 4 / 270));
        *dc = -1 / 60.0 + s / 1260 * (1 - s / 48 * (1 - s * 4 / 330));
        return;
    }
    const double half = sin(x / 2);
    *b = 2 * half * half / s;
    *c = (x - sin(x)) / (s * x);
    *db = (sin(x) / x - 2 * *b) / s;
    *dc = (*b - 3 * *c) / s;
}

/* Computes out = p 1 + q t~ + r t~ t~. */
static void polynomial(const double t[3], double p, double q, double r, double out[9])
{
    const double square = vec3_dot(t, t);
    const double skew[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = (i == j ? p - r * square : 0) + q * skew[3 * i + j] + r * t[i] * t[j];
}

void rotation_rates_jacobian(const double t[3], double Jr[9])
{
    double b, c, db, dc;
    coefficients(vec3_norm(t), &b, &c, &db, &dc);
    polynomial(t, 1, -b, c, Jr);
}

void rotation_rates_inverse(const double t[3], double inverse[9])
{
    const double x = vec3_norm(t), s = x * x;
    const double r =
        x < small ? 1 / 12.0 + s / 720 * (1 + s / 42 * (1 + s / 40)) : (1 - x / 2 / tan(x / 2)) / s;
    polynomial(t, 1, 0.5, r, inverse);
}

/* Jr y = y - b t x y + c t x (t x y) */
void rotation_rates_derivative(const double t[3], const double y[3], double D[9])
{
    double b, c, db, dc, ty[3], tty[3];
    coefficients(vec3_norm(t), &b, &c, &db, &dc);
    vec3_cross(t, y, ty);
    vec3_cross(t, ty, tty);
    const double along = vec3_dot(t, y);
    const double skew[9] = {0, -y[2], y[1], y[2], 0, -y[0], -y[1], y[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            D[3 * i + j] = b * skew[3 * i + j] + (dc * tty[i] - db * ty[i]) * t[j] +
                           c * ((i == j ? along : 0) + t[i] * y[j] - 2 * y[i] * t[j]);
}

void rotation_rates_add(double t[3], const double d[3])
{
    double p[4], q[4];
    rotation_exp(t, p);
    rotation_exp(d, q);
    rotation_compose(p, q, p);
    rotation_normalise(p);
    rotation_log(p, t);
}
