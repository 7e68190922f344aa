/* Forces A^T sigma_m of elements and springs, and their tangent. The geometric terms use the
 * stresses s + k W d, without the spurious stresses due to the gaps. */
#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/math/vec3.h"

enum { N = ELEMENT_MAX_COORDINATES, M = DEFORMABLE_STRAINS };

/* Computes the terms of sigma_m that do not depend on the gaps: (sigma_n + P'(e))/2 + k W d, and
 * V d/h for damping. */
static void middle_of(const conserving *s, deformable_values *v)
{
    const deformable *of = &v->of;
    double Wd[M];
    dense_mul_vec(of->strains, of->strains, of->W, of->d, Wd);
    for (int k = 0; k < of->strains; k++)
        v->middle[k] = (of->before[k] + of->present[k]) / 2 + s->k * Wd[k];
    if (of->V == NULL)
        return;
    dense_mul_vec(of->strains, of->strains, of->V, of->d, Wd);
    for (int k = 0; k < of->strains; k++)
        v->middle[k] += 1 / s->h * Wd[k];
}

/* Computes the gaps and sigma_m. sigma_m contains the contribution of the gaps unless s->settled is
 * 1, when the gaps are rounding errors. Returns the incompatibility: the largest gap of the
 * strains, divided by the reference length. */
static double gaps_of(const conserving *s, const double J[], deformable_values *v, double sigma[])
{
    const deformable *of = &v->of;
    double d[M], C_e[M], W_d[M], largest = 0;
    dense_mul_vec(of->strains, of->coordinates, J, v->step.y, d);
    for (int k = 0; k < of->strains; k++) {
        of->gap_e[k] = v->D[k] - of->e[k];
        of->gap_d[k] = d[k] - of->d[k];
        largest = fmax(largest, fabs(of->gap_e[k]) / of->length);
    }
    memcpy(sigma, v->middle, (size_t)of->strains * sizeof *sigma);
    if (s->settled)
        return largest;
    dense_mul_vec(of->strains, of->strains, of->C, of->gap_e, C_e);
    dense_mul_vec(of->strains, of->strains, of->W, of->gap_d, W_d);
    for (int k = 0; k < of->strains; k++)
        sigma[k] += C_e[k] / 2 + s->k * W_d[k];
    if (of->V != NULL) {
        dense_mul_vec(of->strains, of->strains, of->V, of->gap_d, W_d);
        for (int k = 0; k < of->strains; k++)
            sigma[k] += 1 / s->h * W_d[k];
    }
    return largest;
}

/* Adds to out[n x n] the geometric stiffness at point g times the derivative of x(s). H is in the
 * exponential chart; for spatial increments, the derivative of a moment m is smaller by m~/2. */
static void add_curved_strains(const cayley_slopes *by, int g, deformable_values *v, double out[])
{
    const deformable *of = &v->of;
    const int n = of->coordinates;
    double f[N] = {0};
    dense_add_transpose_mul(n, of->strains, 1, v->J[g], v->middle, f);
    for (int j = 0; j < of->el->nodes; j++) {
        const int at = NODE_COORDINATES * j + 3;
        double spun[9];
        cayley_skew(f + at, spun);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                v->H[g][(at + i) * n + at + k] -= spun[3 * i + k] / 2;
    }
    cayley_slopes_columns(&v->step, by, &v->point[g], 1.0 / DEFORMABLE_POINTS, n, v->H[g], out);
}

/* Computes the derivatives k_e and k_d of k with respect to the strains and d. Adds k_e . gap_e +
 * k_d . gap_d to s->missing. Sets the column and the row of the update. */
static void add_scalar(conserving *s, const double J[], deformable_values *v)
{
    const deformable *of = &v->of;
    const int n = of->coordinates, strains = of->strains;
    double Wd[M], Cd[M], k_e[M], k_d[M];
    memset(v->column, 0, sizeof v->column);
    memset(v->row, 0, sizeof v->row);
    if (s->k == 0)
        return;
    dense_mul_vec(strains, strains, of->W, of->d, Wd);
    dense_mul_vec(strains, strains, of->C, of->d, Cd);
    for (int r = 0; r < strains; r++) {
        k_e[r] = (of->present[r] - Cd[r] / 2) / s->denominator;
        k_d[r] = (-(of->before[r] + of->present[r]) / 2 - 2 * s->k * Wd[r]) / s->denominator;
        s->missing += k_e[r] * of->gap_e[r] + k_d[r] * of->gap_d[r];
        k_e[r] += k_d[r];
    }
    dense_add_transpose_mul(n, strains, 1, J, Wd, v->column);
    cayley_forces(&v->step, 1, v->column);
    dense_add_transpose_mul(n, strains, 1, of->J, k_e, v->row);
}

static void to_coordinates(const conserving *s, const motion_state *from, const model_state *now,
                           const double F[], deformable_values *v)
{
    const mesh_element *el = v->of.el;
    const model *m = s->of.c->model;
    int own = NODE_COORDINATES * el->nodes;
    if (el->plain)
        return;
    if (el->columns > own)
        dense_widen(mesh_own_coordinates(el), el->columns, v->K);
    for (int j = 0; j < el->nodes; j++) {
        const int at = NODE_COORDINATES * j;
        frame_motion p;
        if (frame_motion_is_plain(m, el->vertex[j]))
            continue;
        frame_motion_of(s, from->state, now, el->vertex[j], F + at, &p);
        frame_motion_forces(&p, at, own, v->force);
        frame_motion_forces(&p, at, own, v->column);
        frame_motion_row(&p, at, own, v->row);
        frame_motion_matrix(&p, el->columns, at, own, v->K);
        own += p.columns - 6;
    }
}

static double equations_of(conserving *s, const motion_state *from, const model_state *now,
                           deformable_values *v)
{
    const deformable *of = &v->of;
    const int n = of->coordinates, strains = of->strains;
    double J[M * N], sigma[M], tangent[M * M], inside[M * N], f[N] = {0}, F[N];
    cayley_slopes by;
    for (int k = 0; k < strains * n; k++)
        J[k] = (v->J[0][k] + v->J[1][k]) / DEFORMABLE_POINTS;
    const double incompatibility = gaps_of(s, J, v, sigma);
    for (int k = 0; k < strains * strains; k++)
        tangent[k] = of->C[k] / 2 + s->k * of->W[k] + (of->V != NULL ? 1 / s->h * of->V[k] : 0);
    memset(v->K, 0, (size_t)(n * n) * sizeof *v->K);
    dense_add_between(strains, n, J, tangent, of->J, v->K, inside);
    cayley_slopes_of(&v->step, &by);
    for (int g = 0; g < DEFORMABLE_POINTS; g++)
        add_curved_strains(&by, g, v, v->K);
    cayley_forces(&v->step, n, v->K);
    dense_add_transpose_mul(n, strains, 1, J, v->middle, f);
    cayley_slopes_forces(&v->step, &by, f, v->K);
    memcpy(F, f, sizeof F);
    cayley_forces(&v->step, 1, F);
    memset(v->force, 0, sizeof v->force);
    dense_add_transpose_mul(n, strains, 1, J, sigma, v->force);
    cayley_forces(&v->step, 1, v->force);
    add_scalar(s, J, v);
    to_coordinates(s, from, now, F, v);
    return incompatibility;
}

static void add(conserving *s, deformable_values *v)
{
    const mesh_element *el = v->of.el;
    if (v->of.spring != NULL)
        assemble_discrete(el, v->K, &s->S);
    else
        assemble_matrix(assemble_of(s->of.c->run->patterns, &s->S), v->of.index, v->K, &s->S);
    for (int k = 0; k < el->columns; k++)
        v->force[k] = -v->force[k];
    assemble_vector(el, v->force, s->residual);
    assemble_vector(el, v->column, s->column);
    assemble_vector(el, v->row, s->row);
}

void conserving_forces(conserving *s, const motion_state *from, model_state *now,
                       double *incompatibility)
{
    const int all = deformable_count(s);
    s->missing = 0;
    for (int first = 0; first < all;) {
        const int count = deformable_together(s, first);
        for (int k = 0; k < count; k++) {
            s->deformable_values[k].of = deformable_at(s, from, now, first + k);
            middle_of(s, &s->deformable_values[k]);
        }
        deformable_evaluate(s, from, now, count, s->deformable_values);
        for (int k = 0; k < count; k++) {
            *incompatibility =
                fmax(*incompatibility, equations_of(s, from, now, &s->deformable_values[k]));
            add(s, &s->deformable_values[k]);
        }
        first += count;
    }
}

typedef struct loaded {
    conserving *s;
    const model_state *from, *now;
    double *out; /* [free + driven] */
} loaded;

/* Computes the mean (v_n + v)/2 and its derivative with respect to c of the step, -1/2 v~ T_c.
 * back: v_n = back v. */
static void mean_of(const double back[9], const double T[9], const double v[3], double mean[3],
                    double change[9])
{
    double before[3], skew[9];
    mat3_mul_vec(back, v, before);
    cayley_skew(v, skew);
    mat3_mul(skew, T, change);
    for (int i = 0; i < 9; i++)
        change[i] *= -0.5;
    for (int i = 0; i < 3; i++)
        mean[i] = (before[i] + v[i]) / 2;
}

/* Subtracts A from K[6 x 6] at (row, columns of c). */
static void subtract_block(const double A[9], int row, double K[36])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[6 * (row + i) + 3 + j] -= A[3 * i + j];
}

/* Subtracts the derivative of arm x force from K at (moment, columns of c). by_arm, by_force [3 x
 * 3]: derivatives of arm and force with respect to c. */
static void subtract_lever(const double arm[3], const double by_arm[9], const double force[3],
                           const double by_force[9], double K[36])
{
    double skew[9], first[9], then[9];
    cayley_skew(force, skew);
    mat3_mul(skew, by_arm, first);
    cayley_skew(arm, skew);
    mat3_mul(skew, by_force, then);
    for (int i = 0; i < 9; i++)
        then[i] -= first[i];
    subtract_block(then, 3, K);
}

/* Computes the force and moment F[6] of a load at the middle of the step, and K[6 x 6] = -dF/d(dr,
 * c) of the vertex. */
static void loads_middle_of(const loaded *of, const applied *what, const double c[3], double F[6],
                            double K[36])
{
    double R0[9], R1[9], back[9], T[9], arm[3], levered[3], by_force[9] = {0}, by[9];
    const size_t q = 4 * (size_t)what->vertex;
    memcpy(F, what->F, 6 * sizeof *F);
    cayley_tangent(c, T);
    rotation_matrix(of->from->q + q, R0);
    rotation_matrix(of->now->q + q, R1);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            back[3 * i + j] = vec3_dot(&R0[3 * i], &R1[3 * j]);
    if (what->follower) {
        mean_of(back, T, what->F + 3, F + 3, by);
        subtract_block(by, 3, K);
        mean_of(back, T, what->F, F, by_force);
        subtract_block(by_force, 0, K);
    }
    if (!what->offset)
        return;
    mean_of(back, T, what->arm, arm, by);
    subtract_lever(arm, by, F, by_force, K);
    vec3_cross(arm, F, levered);
    for (int i = 0; i < 3; i++)
        F[3 + i] += levered[i];
}

static void take(void *context, const applied *what)
{
    const loaded *of = context;
    conserving *s = of->s;
    double dr[3], c[3], F[6], K[36] = {0};
    frame_motion_step(s, of->from, of->now, what->vertex, dr, c);
    loads_middle_of(of, what, c, F, K);
    frame_motion_add(s, of->from, of->now, what->vertex, F, K, of->out);
}

void conserving_loads(conserving *s, const motion_state *from, const model_state *now, double h,
                      double out[])
{
    const model *m = s->of.c->model;
    loaded of = {s, from->state, now, out};
    for (int i = 0; i < model_scene(m)->loads; i++)
        applied_each(m, now, &model_scene(m)->load[i],
                     applied_factor(&s->of.c->eq, &model_scene(m)->load[i], from->time + h / 2),
                     take, &of);
}

static void own_increments(const conserving *s, const motion_state *from, const model_state *now,
                           const mesh_element *el, double local[])
{
    const model *m = s->of.c->model;
    int own = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < own; k++)
        local[k] = el->index[k] == NONE ? 0 : s->dx[el->index[k]];
    for (int j = 0; j < el->nodes && !el->plain; j++) {
        double moved[FRAME_MOTION_MOST], *at = local + NODE_COORDINATES * j;
        frame_motion p;
        if (frame_motion_is_plain(m, el->vertex[j]))
            continue;
        frame_motion_of(s, from->state, now, el->vertex[j], NULL, &p);
        for (int k = 0; k < p.columns; k++) {
            const int index = el->index[k < 6 ? NODE_COORDINATES * j + k : own++];
            moved[k] = index == NONE ? 0 : s->dx[index];
        }
        dense_mul_vec(6, p.columns, p.moved, moved, at);
    }
}

double conserving_update(conserving *s, const motion_state *from, model_state *now)
{
    const model *m = s->of.c->model;
    double largest = 0;
    s->change = 0;
    for (int i = 0; i < deformable_count(s); i++) {
        const deformable of = deformable_at(s, from, now, i);
        double local[ELEMENT_MAX_COORDINATES], more[DEFORMABLE_STRAINS], de[DEFORMABLE_STRAINS],
            dsigma[DEFORMABLE_STRAINS];
        own_increments(s, from, now, of.el, local);
        dense_mul_vec(of.strains, of.coordinates, of.J, local, more);
        for (int k = 0; k < of.strains; k++) {
            de[k] = of.gap_e[k] + more[k];
            of.e[k] += de[k];
            of.d[k] += of.gap_d[k] + more[k];
        }
        dense_mul_vec(of.strains, of.strains, of.C, de, dsigma);
        for (int k = 0; k < of.strains; k++) {
            const double next = of.present[k] + dsigma[k];
            s->change = fmax(s->change, fabs(next - of.sigma[k]));
            of.sigma[k] = next;
        }
        if (of.spring == NULL && model_type(m)->update != NULL)
            largest = larger(
                largest, model_type(m)->update(model_kind(m, of.el->kind)->data, de, of.memory,
                                               &now->inner[(size_t)i * (size_t)model_inner(m)]));
    }
    return largest;
}

static double worked_on(const conserving *s, const double force[])
{
    const model *m = s->of.c->model;
    double sum = 0;
    for (int c = 0; c < s->all; c++)
        sum += force[c] * s->step[c];
    for (int i = 0; i < model_vertices(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        const mesh_release *r = release_of(m, i);
        const int turns = r == NULL ? (v->body == i ? v->angles : 0) : r->turns < 3 ? r->turns : 0;
        for (int k = 0; k < turns; k++) {
            const int c = v->coordinate[SCENE_RX + k];
            if (c != NONE && model_owns(m, i, SCENE_RX))
                sum += force[c] * (2 * tan(s->step[c] / 2) - s->step[c]);
        }
    }
    return sum;
}

static int moves_by_drivers(const conserving *s)
{
    for (int c = s->free; c < s->all; c++)
        if (s->step[c] != 0)
            return 1;
    return 0;
}

/* Returns the energy [J] that the damping stresses dissipate in the step: the sum of d . V d/h.
 */
static double dissipated(const conserving *s, const motion_state *from, model_state *now)
{
    double sum = 0;
    for (int i = 0; i < deformable_count(s) && s->of.c->run->damping != NULL; i++) {
        const deformable of = deformable_at(s, from, now, i);
        if (of.V != NULL)
            sum += 1 / s->h * dense_quadratic(of.strains, of.V, of.d);
    }
    return sum;
}

status conserving_work(conserving *s, const motion_state *from, motion_state *to, double h,
                       fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    const int behind = 3; /* first iteration in which conserving_stresses uses k */
    double ignored = 0;
    memset(s->residual, 0, bytes);
    conserving_loads(s, from, to->state, h, s->residual);
    to->work = from->work;
    if (moves_by_drivers(s)) {
        double *held = s->dx;
        memcpy(held, s->residual, bytes);
        TRY(conserving_stresses(s, from, to->state, behind, f));
        s->settled = 1;
        conserving_forces(s, from, to->state, &ignored);
        s->settled = 0;
        conserving_inertia(s, from, to->state, h);
        for (int c = s->free; c < s->all; c++)
            held[c] -= s->residual[c];
        to->work += worked_on(s, held);
    } else {
        to->work += worked_on(s, s->residual);
    }
    to->dissipated = from->dissipated + dissipated(s, from, to->state);
    return STATUS_OK;
}

/* Computes the strain rates r1 and their derivatives s1 at the end of a step from r0 and s0 at its
 * start and from the mean rate m: r1 = (3 m - r0)/2 + h s0/4, s1 = (m - r0)/h + s0/2. The result is
 * of second order, even if there is no inertia. */
void conserving_damped(const conserving *s, const motion_state *from, double h, motion_state *to)
{
    const model *m = s->of.c->model;
    const int elements = model_elements(m);
    for (int i = 0; i < deformable_count(s) && s->of.c->run->damping != NULL; i++) {
        const deformable of = deformable_at(s, from, to->state, i);
        const int first = i < elements
                              ? i * model_strains(m)
                              : elements * model_strains(m) + (i - elements) * SPRING_STRAINS;
        double *r = to->strain + first, *rate2 = to->strain2 + first, more[DEFORMABLE_STRAINS];
        for (int k = 0; k < of.strains; k++) {
            const double mean = of.d[k] / h, r0 = from->strain[first + k],
                         s0 = from->strain2[first + k];
            r[k] = (3 * mean - r0) / 2 + h * s0 / 4;
            rate2[k] = (mean - r0) / h + s0 / 2;
        }
        if (of.V == NULL || of.spring != NULL)
            continue;
        dense_mul_vec(of.strains, of.strains, of.V, r, more);
        for (int k = 0; k < of.strains; k++)
            of.sigma[k] += more[k];
    }
}
