/* Masses of ends that are released from their nodes. With the body's v, w, the node at the offset p
 * from it, the turns t about axes b and the shifts s along d, q = sum d s:
 *   w_end = w + sum b t',  w_end' = w' + sum b t'' + sum t' (rotation before it) x b,
 *   v_end = v + w x p + w_end x q + sum d s',
 *   a_end = a + w' x p + w x (w x p) + w_end' x q + w_end x (w_end x q) + 2 w_end x sum d s' + sum
 * d s''. Three turns are free: their rates are the angular velocity in the end's axes. */
#include "harness/time/released.h"

#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"

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

/* Column of T, its turn or its shift. */
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

/* out[6 x count]: columns `first` to first + 2 become T B */
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
