#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"

enum { FIRST_TURN = 6, BALL = 3 };

int frame_motion_is_plain(const model *m, int vertex)
{
    const mesh_vertex *v = model_vertex(m, vertex);
    return v->body == vertex && v->angles == 0 && !v->turned;
}

typedef struct place_chain {
    const model *m;
    const model_state *from, *now;
    int vertex;
    const mesh_release *release; /* NULL: none */
    const double *F;
    double about[9];
    double a[3][3],
        da[3][3 * FRAME_MOTION_MOST];       /* columns of `about` that are mean axes of angles */
    double c[3], dc[3 * FRAME_MOTION_MOST]; /* c after all rotations */
    double x[3][3], dx[3][3 * FRAME_MOTION_MOST];
    double rho[3], drho[3 * FRAME_MOTION_MOST],
        moved[3 * FRAME_MOTION_MOST];               /* rho_m; derivative of rho_1 */
    double sigma[3], dsigma[3 * FRAME_MOTION_MOST]; /* (a s)_m, the mean of the shift */
} place_chain;

static void product(int columns, double times, const double A[9], const double B[], double out[])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < columns; k++)
            out[i * columns + k] = times * (A[3 * i] * B[k] + A[3 * i + 1] * B[columns + k] +
                                            A[3 * i + 2] * B[2 * columns + k]);
}

static void sweep(const place_chain *by, int columns, double times, const double v[3], double out[])
{
    double T[9], V[9], B[9];
    cayley_tangent(by->c, T);
    cayley_skew(v, V);
    mat3_mul(V, T, B);
    product(columns, -times, B, by->dc, out);
}

static void beside(place_chain *by, int columns)
{
    double after[3];
    kinematics_offset(by->m, by->from, by->vertex, by->rho);
    kinematics_offset(by->m, by->now, by->vertex, after);
    for (int i = 0; i < 3; i++)
        by->rho[i] = (by->rho[i] + after[i]) / 2;
    sweep(by, columns, 1, after, by->moved);
    sweep(by, columns, 0.5, after, by->drho);
}

static void turn(const double b[3], double angle, int column, double x[3], double dx[], int columns,
                 place_chain *by)
{
    const double tau = 2 * tan(angle / 2), along = vec3_dot(by->c, b), part = 1 - tau * along / 4,
                 stretch = 1 + tau * tau / 4;
    double crossed[3], skew[9], N[9];
    vec3_cross(by->c, b, crossed);
    cayley_skew(b, skew);
    for (int i = 0; i < 3; i++) {
        x[i] = (b[i] + crossed[i] / 2 + along * by->c[i] / 4) / part;
        for (int j = 0; j < 3; j++)
            N[3 * i + j] = -skew[3 * i + j] / 2 + (by->c[i] * b[j] + (i == j ? along : 0)) / 4 +
                           x[i] * tau * b[j] / 4;
    }
    product(columns, 1 / part, N, by->dc, dx);
    for (int i = 0; i < 3; i++)
        dx[i * columns + column] += x[i] * along / 4 / part * stretch;
    for (int i = 0; i < 3; i++) {
        by->c[i] += tau * x[i];
        for (int k = 0; k < columns; k++)
            by->dc[i * columns + k] += tau * dx[i * columns + k];
        by->dc[i * columns + column] += x[i] * stretch;
    }
}

static void begin(const double step[], place_chain *by, frame_motion *p)
{
    const int at = model_vertex(by->m, by->vertex)->body;
    const mesh_vertex *body = model_vertex(by->m, at);
    double b[3][3];
    for (int i = 0; i < 6; i++)
        p->measure[i] = body->coordinate[i] != NONE ? step[body->coordinate[i]] : 0;
    if (body->angles > 0)
        kinematics_axes(by->m, by->from, at, b);
    for (int k = 0; k < body->angles; k++) {
        const double angle = p->measure[SCENE_RX + k];
        turn(b[k], angle, SCENE_RX + k, by->a[k], by->da[k], p->columns, by);
        p->measure[SCENE_RX + k] = 2 * tan(angle / 2);
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            by->about[3 * i + k] = body->angles == 0 ? i == k : k < body->angles ? by->a[k][i] : 0;
            if (body->angles > 0)
                continue;
            by->c[i] += (i == k) * p->measure[SCENE_RX + k];
            by->dc[i * p->columns + SCENE_RX + k] = i == k;
        }
}

static void turns(const double step[], place_chain *by, frame_motion *p)
{
    const mesh_release *r = by->release;
    const int *own = model_vertex(by->m, by->vertex)->coordinate + SCENE_RX;
    double b[3][3];
    if (r->turns == BALL) {
        memset(by->dc, 0, sizeof by->dc);
        for (int i = 0; i < 3; i++) {
            by->c[i] = p->measure[FIRST_TURN + i] = step[own[i]];
            by->dc[i * p->columns + FIRST_TURN + i] = 1;
        }
        return;
    }
    release_turn_axes(by->m, by->from, by->vertex, b);
    for (int k = 0; k < r->turns; k++) {
        p->measure[FIRST_TURN + k] = 2 * tan(step[own[k]] / 2);
        turn(b[k], step[own[k]], FIRST_TURN + k, by->x[k], by->dx[k], p->columns, by);
    }
}

/* Computes the direction of a slide, (before + after)/2 - c x (after - before)/4, and its
 * derivative. before, after: direction of its axis at the start and at the end of the step. */
static void direction(const double before[3], const double after[3], const place_chain *by,
                      int columns, double along[3], double change[])
{
    double apart[3], crossed[3], skew[9], turned[9], swept[3 * FRAME_MOTION_MOST],
        more[3 * FRAME_MOTION_MOST];
    for (int i = 0; i < 3; i++)
        apart[i] = after[i] - before[i];
    vec3_cross(by->c, apart, crossed);
    for (int i = 0; i < 3; i++)
        along[i] = (before[i] + after[i]) / 2 - crossed[i] / 4;
    sweep(by, columns, 1, after, swept);
    cayley_skew(apart, skew);
    product(columns, 0.25, skew, by->dc, change);
    cayley_skew(by->c, turned);
    product(columns, -0.25, turned, swept, more);
    for (int i = 0; i < 3 * columns; i++)
        change[i] += swept[i] / 2 + more[i];
}

static void slides(const double step[], place_chain *by, frame_motion *p)
{
    const mesh_release *r = by->release;
    const int *own = model_vertex(by->m, by->vertex)->coordinate, n = p->columns;
    double before[3][3], after[3][3], first[3], last[3], change[3 * FRAME_MOTION_MOST];
    release_slide_axes(by->m, by->from, by->vertex, before, first);
    release_slide_axes(by->m, by->now, by->vertex, after, last);
    for (int i = 0; i < 3; i++)
        by->sigma[i] = (first[i] + last[i]) / 2;
    sweep(by, n, 0.5, last, by->dsigma);
    sweep(by, n, 1, last, p->moved);
    for (int k = 0; k < r->slides; k++) {
        const int column = FIRST_TURN + r->turns + k;
        double along[3];
        direction(before[k], after[k], by, n, along, change);
        p->measure[column] = step[own[k]];
        for (int i = 0; i < 3; i++) {
            p->work[i * n + column] = along[i];
            p->moved[i * n + column] = after[k][i];
            by->dsigma[i * n + column] += after[k][i] / 2;
            for (int c = 0; c < n; c++)
                p->curved[column * n + c] += by->F[i] * change[i * n + c];
        }
    }
}

/* Adds forces at a lever to three columns of `work`, starting with `column`. Columns of A: rotation
 * of the lever per unit of a coordinate. moments 1: also adds moments. */
static void work_on(const double lever[3], const double A[9], int moments, int column, int columns,
                    frame_motion *p)
{
    double skew[9], levered[9];
    cayley_skew(lever, skew);
    mat3_mul(skew, A, levered);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            p->work[i * columns + column + k] -= levered[3 * i + k];
            p->work[(3 + i) * columns + column + k] += moments ? A[3 * i + k] : 0;
        }
}

static void add_curved(const double A[9], const double B[], int row, int columns, frame_motion *p)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < columns; k++)
            p->curved[(row + i) * columns + k] +=
                A[i] * B[k] + A[3 + i] * B[columns + k] + A[6 + i] * B[2 * columns + k];
}

static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void turning_rows(const place_chain *by, const double moment[3], const double dmoment[],
                         frame_motion *p)
{
    const int n = p->columns;
    for (int k = 0; k < by->release->turns; k++) {
        const int column = FIRST_TURN + k;
        double swept[3];
        vec3_cross(by->x[k], by->sigma, swept);
        for (int i = 0; i < 3; i++) {
            p->work[i * n + column] = swept[i];
            p->work[(3 + i) * n + column] = by->x[k][i];
            for (int c = 0; c < n; c++)
                p->curved[column * n + c] +=
                    by->x[k][i] * dmoment[i * n + c] + moment[i] * by->dx[k][i * n + c];
        }
    }
}

static void angle_rows(const place_chain *by, const double moment[3], frame_motion *p)
{
    const int n = p->columns,
              angles = model_vertex(by->m, model_vertex(by->m, by->vertex)->body)->angles;
    for (int k = 0; k < angles; k++)
        for (int i = 0; i < 3; i++)
            for (int c = 0; c < n; c++)
                p->curved[(SCENE_RX + k) * n + c] += moment[i] * by->da[k][i * n + c];
}

static void swing(const place_chain *by, int at, frame_motion *p)
{
    const int n = p->columns;
    double before[3], after[3], inward[3];
    kinematics_arm(by->m, by->from, at, before);
    kinematics_arm(by->m, by->now, at, after);
    vec3_cross(model_vertex(by->m, at)->axis[0], after, inward);
    for (int i = 0; i < 3; i++) {
        p->work[i * n + SCENE_RX] += (before[i] + after[i]) / 2;
        p->moved[i * n + SCENE_RX] += after[i];
    }
    p->curved[SCENE_RX * n + SCENE_RX] += vec3_dot(by->F, inward) / 2;
}

static void finish(const place_chain *by, frame_motion *p)
{
    const int n = p->columns, ball = by->release != NULL && by->release->turns == BALL;
    const int at = model_vertex(by->m, by->vertex)->body;
    const mesh_vertex *body = model_vertex(by->m, at);
    double force[9], more[3 * FRAME_MOTION_MOST], dmoment[3 * FRAME_MOTION_MOST], moment[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const double along = body->turned ? body->along[3 * i + k] : i == k;
            p->work[i * n + k] = along;
            p->moved[i * n + k] += along;
        }
    for (int i = 0; i < 3 * n; i++) {
        p->moved[i] += by->moved[i];
        p->moved[3 * n + i] = by->dc[i];
    }
    vec3_cross(by->sigma, by->F, moment);
    for (int i = 0; i < 3; i++)
        moment[i] += by->F[3 + i];
    cayley_skew(by->F, force);
    product(n, -1, force, by->dsigma, dmoment);
    product(n, -1, force, by->drho, more);
    work_on(by->rho, by->about, 0, 3, n, p);
    add_curved(by->about, more, 3, n, p);
    work_on(by->sigma, ball ? one : by->about, 1, ball ? FIRST_TURN : 3, n, p);
    add_curved(ball ? one : by->about, dmoment, ball ? FIRST_TURN : 3, n, p);
    if (by->release != NULL && !ball)
        turning_rows(by, moment, dmoment, p);
    double lever[3];
    vec3_cross(by->rho, by->F, lever);
    for (int i = 0; i < 3; i++)
        lever[i] += ball ? 0 : moment[i];
    angle_rows(by, lever, p);
    if (body->led)
        swing(by, at, p);
}

void frame_motion_of(const conserving *s, const model_state *from, const model_state *now,
                     int vertex, const double F[6], frame_motion *p)
{
    static const double none[6] = {0};
    const model *m = s->of.c->model;
    place_chain by = {.m = m,
                      .from = from,
                      .now = now,
                      .vertex = vertex,
                      .release = release_of(m, vertex),
                      .F = F != NULL ? F : none};
    memset(p, 0, sizeof *p);
    p->columns = FIRST_TURN + (by.release != NULL ? by.release->turns + by.release->slides : 0);
    begin(s->step, &by, p);
    beside(&by, p->columns);
    if (by.release != NULL) {
        turns(s->step, &by, p);
        slides(s->step, &by, p);
    }
    finish(&by, p);
}

void frame_motion_step(const conserving *s, const model_state *from, const model_state *now,
                       int vertex, double dr[3], double c[3])
{
    const model *m = s->of.c->model;
    const int *at = model_vertex(m, vertex)->coordinate;
    frame_motion p;
    double all[6];
    if (frame_motion_is_plain(m, vertex)) {
        for (int i = 0; i < 3; i++) {
            dr[i] = at[i] != NONE ? s->step[at[i]] : 0;
            c[i] = at[SCENE_RX + i] != NONE ? s->step[at[SCENE_RX + i]] : 0;
        }
        return;
    }
    frame_motion_of(s, from, now, vertex, NULL, &p);
    dense_mul_vec(6, p.columns, p.work, p.measure, all);
    memcpy(dr, all, 3 * sizeof *dr);
    memcpy(c, all + 3, 3 * sizeof *c);
}

enum { SIX = 6 };

static int index_of(int column, int at, int own)
{
    return column < SIX ? at + column : own + column - SIX;
}

static void transposed(const frame_motion *p, const double A[], const double of[SIX], double out[])
{
    memset(out, 0, (size_t)p->columns * sizeof *out);
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < p->columns; k++)
            out[k] += A[i * p->columns + k] * of[i];
}

static void along(const frame_motion *p, const double A[], int at, int own, int stride, double v[])
{
    double of[SIX], out[FRAME_MOTION_MOST];
    for (int i = 0; i < SIX; i++)
        of[i] = v[(at + i) * stride];
    transposed(p, A, of, out);
    for (int k = 0; k < p->columns; k++)
        v[index_of(k, at, own) * stride] = out[k];
}

void frame_motion_forces(const frame_motion *p, int at, int own, double forces[])
{
    along(p, p->work, at, own, 1, forces);
}

void frame_motion_row(const frame_motion *p, int at, int own, double row[])
{
    along(p, p->moved, at, own, 1, row);
}

void frame_motion_matrix(const frame_motion *p, int n, int at, int own, double K[])
{
    for (int r = 0; r < n; r++)
        along(p, p->moved, at, own, 1, K + r * n);
    for (int c = 0; c < n; c++)
        along(p, p->work, at, own, n, K + c);
    for (int i = 0; i < p->columns; i++)
        for (int k = 0; k < p->columns; k++)
            K[index_of(i, at, own) * n + index_of(k, at, own)] += p->curved[i * p->columns + k];
}

static int index_place(const model *m, int vertex, int index[FRAME_MOTION_MOST])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const mesh_release *r = release_of(m, vertex);
    int n = SIX;
    for (int i = 0; i < SIX; i++)
        index[i] = model_vertex(m, v->body)->coordinate[i];
    for (int k = 0; r != NULL && k < r->turns; k++)
        index[n++] = v->coordinate[SCENE_RX + k];
    for (int k = 0; r != NULL && k < r->slides; k++)
        index[n++] = v->coordinate[k];
    return n;
}

void frame_motion_add(conserving *s, const model_state *from, const model_state *now, int vertex,
                      const double F[6], const double K[36], double out[])
{
    const model *m = s->of.c->model;
    double forces[FRAME_MOTION_MOST], all[FRAME_MOTION_MOST * FRAME_MOTION_MOST] = {0};
    int index[FRAME_MOTION_MOST];
    const int n = index_place(m, vertex, index);
    memcpy(forces, F, SIX * sizeof *forces);
    for (int i = 0; i < SIX * SIX; i++)
        all[i / SIX * n + i % SIX] = K[i];
    if (!frame_motion_is_plain(m, vertex)) {
        frame_motion p;
        frame_motion_of(s, from, now, vertex, F, &p);
        for (int i = 0; i < n * n; i++)
            p.curved[i] = -p.curved[i];
        frame_motion_forces(&p, 0, SIX, forces);
        frame_motion_matrix(&p, n, 0, SIX, all);
    }
    for (int i = 0; i < n; i++) {
        if (index[i] == NONE)
            continue;
        out[index[i]] += forces[i];
        for (int j = 0; j < n; j++)
            if (all[i * n + j] != 0)
                assemble_subtract(&s->S, index[i], index[j], -all[i * n + j]);
    }
}
